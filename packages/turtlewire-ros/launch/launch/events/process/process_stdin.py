"""Input for a process."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStdin(ProcessIO):
    """Input that is sent to a process by emitting this event.

    It takes effect if the process reads from a pipe. With ``emulate_tty`` it reads from the
    terminal of the launch, if there is one.

    Args:
        text: The bytes.
        **kwargs: See :class:`RunningProcessEvent`; ``action`` is the process that gets them.
            `ExecuteLocal.process_details` has the others.
    """

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=0, **kwargs)
