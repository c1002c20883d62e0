"""A process has ended."""

from __future__ import annotations

from typing import Any

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessExited(RunningProcessEvent):
    """A process has ended.

    Args:
        returncode: Its exit status, negative for the signal that ended it.
        **kwargs: See :class:`RunningProcessEvent`.
    """

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._returncode = returncode

    @property
    def returncode(self) -> int:
        """The exit status of the process, negative for the signal that ended it."""
        return self._returncode
