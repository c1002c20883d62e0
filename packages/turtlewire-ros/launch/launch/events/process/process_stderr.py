"""A process has written to stderr."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStderr(ProcessIO):
    """A process has written to stderr.

    Args:
        text: The bytes.
        **kwargs: See :class:`RunningProcessEvent`.
    """

    name = "launch.events.process.ProcessStderr"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=2, **kwargs)
