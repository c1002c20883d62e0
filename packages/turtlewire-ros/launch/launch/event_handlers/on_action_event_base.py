"""Handles events of one kind that belong to an action."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.action import Action, ProcessAction
from launch.event_handler import BaseEventHandler, entity_list

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType

# Names of classes in ROS 2's texts.
_ROS_NAMES: dict[type[Action], str] = {ProcessAction: "ExecuteLocal"}


class OnActionEventBase(BaseEventHandler):
    """Handles events of one kind that belong to an action.

    Args:
        action_matcher: The action, a predicate over actions, or None for all.
        on_event: What to visit then, or a function of event and context that returns it.
        target_event_cls: The kind of events.
        target_action_cls: What the action must be an instance of.
        **kwargs: See :class:`BaseEventHandler`.
    """

    def __init__(
        self,
        *,
        action_matcher: Callable[[Action], bool] | Action | None,
        on_event: SomeEntitiesType | Callable[[Any, LaunchContext], SomeEntitiesType | None],
        target_event_cls: type[Event],
        target_action_cls: type[Action],
        **kwargs: Any,
    ) -> None:
        if not (
            callable(action_matcher)
            or isinstance(action_matcher, target_action_cls)
            or action_matcher is None
        ):
            name = _ROS_NAMES.get(target_action_cls, target_action_cls.__name__)
            raise ValueError(
                f"action_matcher must be a '{name}' instance or a callable, not {action_matcher!r}"
            )
        self._action_matcher = action_matcher
        self._target_event_cls = target_event_cls
        self._function = on_event if callable(on_event) else None
        self._entities = [] if callable(on_event) else entity_list(on_event)
        super().__init__(matcher=self._is_for_me, **kwargs)

    def _is_for_me(self, event: Event) -> bool:
        if not isinstance(event, self._target_event_cls):
            return False
        action: Action = event.action  # type: ignore[attr-defined]
        if callable(self._action_matcher):
            return self._action_matcher(action)
        return self._action_matcher is None or action is self._action_matcher

    @property
    def handler_description(self) -> str:
        """The function, or that actions are returned."""
        return "<actions>" if self._function is None else str(self._function)

    @property
    def matcher_description(self) -> str:
        """Short description of the events."""
        text = f"event == {self._target_event_cls.__name__}"
        if self._action_matcher is None:
            return text
        return f"{text} and event.action == {self._action_matcher!r}"

    def describe(self) -> tuple[str, list[Any]]:
        return super().describe()[0], list(self._entities)

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        super().handle(event, context)
        return self._entities if self._function is None else self._function(event, context)
