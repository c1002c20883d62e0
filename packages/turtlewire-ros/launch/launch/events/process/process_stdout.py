"""A process has written to stdout."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStdout(ProcessIO):
    """A process has written to stdout.

    Args:
        text: The bytes.
        **kwargs: See :class:`RunningProcessEvent`.
    """

    name = "launch.events.process.ProcessStdout"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=1, **kwargs)
