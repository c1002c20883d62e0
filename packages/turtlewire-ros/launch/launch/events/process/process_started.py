"""A process runs."""

from __future__ import annotations

from typing import Any

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessStarted(RunningProcessEvent):
    """A process runs.

    Args:
        **kwargs: See :class:`RunningProcessEvent`.
    """

    name = "launch.events.process.ProcessStarted"

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
