"""Handles what a process writes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.action import Action, ProcessAction
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process import ProcessIO

if TYPE_CHECKING:
    from launch.some_entities_type import SomeEntitiesType


class OnProcessIO(OnActionEventBase):
    """Handles what a process writes.

    Args:
        target_action: The action, a predicate over actions, or None for all.
        on_stdin: Called with the event, for input; may return entities.
        on_stdout: Likewise for stdout.
        on_stderr: Likewise for stderr.
        **kwargs: See :class:`BaseEventHandler`.
    """

    def __init__(
        self,
        *,
        target_action: Callable[[Action], bool] | Action | None = None,
        on_stdin: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stdout: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stderr: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        **kwargs: Any,
    ) -> None:
        def on_event(event: ProcessIO, _context: object) -> SomeEntitiesType | None:
            function = (
                on_stdout if event.from_stdout else on_stderr if event.from_stderr else on_stdin
            )
            return None if function is None else function(event)

        super().__init__(
            action_matcher=target_action,
            on_event=on_event,
            target_event_cls=ProcessIO,
            target_action_cls=ProcessAction,
            **kwargs,
        )
