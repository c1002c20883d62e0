"""Handles the end of a process."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.action import Action, ProcessAction
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process import ProcessExited

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnProcessExit(OnActionEventBase):
    """Handles the end of a process.

    Args:
        target_action: The action, a predicate over actions, or None for all.
        on_exit: What to visit then, or a function of event and context that returns it.
        **kwargs: See :class:`BaseEventHandler`.
    """

    def __init__(
        self,
        *,
        target_action: Callable[[Action], bool] | Action | None = None,
        on_exit: SomeEntitiesType
        | Callable[[ProcessExited, LaunchContext], SomeEntitiesType | None],
        **kwargs: Any,
    ) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ProcessAction,
            **kwargs,
        )
