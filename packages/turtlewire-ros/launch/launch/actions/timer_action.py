"""Delays actions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.actions.pop_environment import PopEnvironment
from launch.actions.pop_launch_configurations import PopLaunchConfigurations
from launch.actions.push_environment import PushEnvironment
from launch.actions.push_launch_configurations import PushLaunchConfigurations
from launch.conditions import evaluate_condition_expression
from launch.event_handler import EventHandler, entity_list
from launch.event_handlers import OnShutdown
from launch.events import TimerEvent
from launch.frontend.expose import expose_action
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    import asyncio

    from launch.event import Event
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["SomeSubstitutionsType_types_tuple", "TimerAction"]


@expose_action("timer")
class TimerAction(Action):
    """Visits actions after a time, unless it is cancelled before.

    Args:
        period: Seconds: a number, or a text that is one.
        actions: The actions.
        cancel_on_shutdown: Whether the end of the launch cancels it: true or false, or text
            with one of these words.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        kinds = (int, float, *SomeSubstitutionsType_types_tuple)
        ensure_argument_type(period, kinds, "period", "TimerAction")
        self._period = normalize_to_list_of_substitutions(
            str(period) if isinstance(period, (int, float)) else period
        )
        self._actions = entity_list(actions)
        text = (
            str(cancel_on_shutdown) if isinstance(cancel_on_shutdown, bool) else cancel_on_shutdown
        )
        self._cancel_on_shutdown = normalize_to_list_of_substitutions(text)
        self._completed: asyncio.Future[None] | None = None
        self._timer: Any = None
        self._canceled = False
        self._locals: dict[str, Any] = {}
        self._scope: list[LaunchDescriptionEntity] | None = None
        self._logger = logging.get_logger("launch.timer_action")

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[TimerAction], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["period"] = parser.parse_if_substitutions(
            entity.get_attr("period", data_type=float, can_be_str=True)
        )
        kwargs["actions"] = [parser.parse_action(child) for child in entity.children]
        return cls, kwargs

    @property
    def period(self) -> list[Substitution]:
        """Seconds, as text."""
        return self._period

    @property
    def actions(self) -> list[LaunchDescriptionEntity]:
        """The actions."""
        return self._actions

    def describe(self) -> str:
        period = " + ".join(part.describe() for part in self._period)
        return f"TimerAction(period={period}, actions=<actions>)"

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions, after the time."""
        period = " + ".join(part.describe() for part in self._period)
        return [(f"after {period} sec", self._actions)]

    def execute(self, context: LaunchContext) -> None:
        assert context.asyncio_loop is not None
        if self._canceled or context.is_shutdown:
            return
        loop = context.asyncio_loop
        self._locals = context.get_locals_as_dict()
        if context.configuration_scopes.depth:  # the group will have ended by then
            self._scope = _beginning_of_scope(context)
        self._completed = loop.create_future()
        handler = EventHandler(matcher=self._is_mine, entities=lambda _, inner: self.handle(inner))
        context.register_event_handler(handler)
        context.register_event_handler(OnShutdown(on_shutdown=self._on_shutdown))
        self._timer = self._start_time(context, loop)

    def seconds(self, context: LaunchContext) -> float:
        """Return the period."""
        return float(perform_substitutions(context, self._period))

    def _start_time(self, context: LaunchContext, loop: asyncio.AbstractEventLoop) -> Any:
        """Start the timer; the returned object has a method ``cancel``."""
        return loop.call_later(self.seconds(context), self._expire, context)

    def cancel(self) -> None:
        """Drop the actions, unless they were visited already."""
        self._canceled = True
        if self._timer is not None:
            self._timer.cancel()
        if self._completed is not None and not self._completed.done():
            self._completed.set_result(None)

    def handle(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions; called when the period has passed.

        In a group with its own scope they find what the group had set, as without the timer.
        """
        context.extend_locals(self._locals)
        if self._scope is None:
            return self._actions
        return [*self._scope, *self._actions, PopEnvironment(), PopLaunchConfigurations()]

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Done when the period has passed or the timer is cancelled."""
        return self._completed

    def _is_mine(self, event: Event) -> bool:
        return isinstance(event, TimerEvent) and event.timer_action is self

    def _expire(self, context: LaunchContext) -> None:
        if self._completed is not None and not self._completed.done():
            # Before the future is done, so that the launch does not end between the two.
            context.emit_event_sync(TimerEvent(timer_action=self))
            self._completed.set_result(None)

    def _on_shutdown(self, _event: Event, context: LaunchContext) -> None:
        if (
            self._completed is not None
            and not self._completed.done()
            and evaluate_condition_expression(context, self._cancel_on_shutdown)
        ):
            self._logger.debug("canceling %s because of shutdown", self)
            self.cancel()


def _beginning_of_scope(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    """Return actions that begin a scope with the values that the context has now."""
    configurations = dict(context.launch_configurations)
    environment = dict(context.environment)

    def restore(later: LaunchContext) -> None:
        later.configuration_scopes.replace(configurations)
        later.environment_scopes.replace(environment)

    return [PushLaunchConfigurations(), PushEnvironment(), OpaqueFunction(function=restore)]
