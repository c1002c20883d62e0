"""Delays actions."""

from __future__ import annotations

import contextlib
import weakref
from collections.abc import Callable, Iterable
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
from launch.substitution import described
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
        # An action of an event handler is visited at each event.
        self._timers: dict[asyncio.Future[None], Callable[[], object]] = {}
        self._own_events: weakref.WeakSet[TimerEvent] = weakref.WeakSet()
        self._canceled = False
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
        return f"TimerAction(period={described(self._period)}, actions=<actions>)"

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions, after the time."""
        return [(f"after {described(self._period)} sec", self._actions)]

    def execute(self, context: LaunchContext) -> None:
        assert context.asyncio_loop is not None
        if self._canceled or context.is_shutdown:
            return
        event, completed = TimerEvent(timer_action=self), context.asyncio_loop.create_future()
        self._own_events.add(event)

        def is_due(each: Event) -> bool:
            # Programs may emit a timer's event themselves, before its time.
            is_ours = isinstance(each, TimerEvent) and each.timer_action is self
            return each is event or (is_ours and each not in self._own_events)

        def expire() -> None:
            if not completed.done():
                # Before the future is done, so that the launch does not end between the two.
                context.emit_event_sync(event)
                completed.set_result(None)

        # Before the rest, because it raises if the period is not a number.
        self._timers[completed] = self._start_time(context, context.asyncio_loop, expire)
        self._completed = completed
        due = EventHandler(matcher=is_due, entities=self._later(context), handle_once=True)
        end = OnShutdown(on_shutdown=self._on_shutdown)
        for handler in (due, end):
            context.register_event_handler(handler)

        def forget(_: object) -> None:
            del self._timers[completed]
            context.unregister_event_handler(end)
            if self._canceled:
                with contextlib.suppress(ValueError):  # a program's event has used the handler
                    context.unregister_event_handler(due)

        completed.add_done_callback(forget)

    def _later(
        self, context: LaunchContext
    ) -> Callable[[Event, LaunchContext], list[LaunchDescriptionEntity]]:
        """Return a function that returns the actions, which then find the values of now.

        In a group with its own scope they find what the group had set, as without the timer.
        """
        values = context.get_locals_as_dict()
        # The group will have ended by then.
        scope = _beginning_of_scope(context) if context.configuration_scopes.depth else []

        def actions(_event: Event, later: LaunchContext) -> list[LaunchDescriptionEntity]:
            if self._canceled:  # after its event was emitted
                return []
            entities = self.handle(later)
            later.extend_locals(values)
            end = [PopEnvironment(), PopLaunchConfigurations()] if scope else []
            return [*scope, *entities, *end]

        return actions

    def seconds(self, context: LaunchContext) -> float:
        """Return the period."""
        return float(perform_substitutions(context, self._period))

    def _start_time(
        self, context: LaunchContext, loop: asyncio.AbstractEventLoop, expire: Callable[[], None]
    ) -> Callable[[], object]:
        """Call ``expire`` after the period; return a function that prevents this."""
        return loop.call_later(self.seconds(context), expire).cancel

    def cancel(self) -> None:
        """Drop the actions, unless they were visited already."""
        self._canceled = True
        for completed, cancel in self._timers.items():
            cancel()
            if not completed.done():
                completed.set_result(None)

    def handle(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions; called when the period has passed."""
        del context
        return self._actions

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Done when the period has passed or the timer is cancelled."""
        return self._completed

    def _on_shutdown(self, _event: Event, context: LaunchContext) -> None:
        is_running = any(not completed.done() for completed in self._timers)
        if is_running and self._ends_at_shutdown(context):
            self._logger.debug("canceling %s because of shutdown", self)
            self.cancel()

    def _ends_at_shutdown(self, context: LaunchContext) -> bool:
        return evaluate_condition_expression(context, self._cancel_on_shutdown)


def _beginning_of_scope(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    """Return actions that begin a scope with the values that the context has now."""
    configurations = dict(context.launch_configurations)
    environment = dict(context.environment)

    def restore(later: LaunchContext) -> None:
        later.configuration_scopes.replace(configurations)
        later.environment_scopes.replace(environment)

    return [PushLaunchConfigurations(), PushEnvironment(), OpaqueFunction(function=restore)]
