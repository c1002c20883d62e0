"""Runs a test program."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.actions import EmitEvent, ExecuteProcess, TimerAction
from launch.event_handlers import OnProcessStart
from launch.events import matches_action
from launch.events.process import ShutdownProcess

if TYPE_CHECKING:
    from launch import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity


class Test(ExecuteProcess):
    """Runs a test program, for a limited time.

    Args:
        timeout: Seconds after which the program is stopped; None for no limit.
        **kwargs: See :class:`launch.actions.ExecuteProcess`.
    """

    __test__ = False  # pytest does not collect it

    def __init__(self, *, timeout: float | None = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._timeout = timeout

    @property
    def timeout(self) -> float | None:
        """Seconds after which the program is stopped, or None."""
        return self._timeout

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the program, and the time with it."""
        if self._timeout is not None:
            stop = EmitEvent(event=ShutdownProcess(process_matcher=matches_action(self)))
            timer = TimerAction(period=float(self._timeout), actions=[stop])
            context.register_event_handler(OnProcessStart(target_action=self, on_start=timer))
        return super().execute(context)
