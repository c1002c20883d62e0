"""A process has written something."""

from __future__ import annotations

from typing import Any

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessIO(RunningProcessEvent):
    """Bytes that a process reads or writes.

    Args:
        text: The bytes.
        fd: 0, 1 or 2.
        **kwargs: See :class:`RunningProcessEvent`.
    """

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._text = text
        self._from = {0: "stdin", 1: "stdout", 2: "stderr"}[fd]

    @property
    def text(self) -> bytes:
        """The bytes."""
        return self._text

    @property
    def from_stdin(self) -> bool:
        """True if they were read from the launch's input for the process."""
        return self._from == "stdin"

    @property
    def from_stdout(self) -> bool:
        """True if the process wrote them to stdout."""
        return self._from == "stdout"

    @property
    def from_stderr(self) -> bool:
        """True if the process wrote them to stderr."""
        return self._from == "stderr"
