"""A request to send input to a process."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.events.process.process_targeted_event import ProcessTargetedEvent

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch._kernel.protocols import ProcessRunner

__all__ = ["ProcessStdin"]


class ProcessStdin(ProcessTargetedEvent):
    """A request to send input to a process.

    It takes effect if the process reads from a pipe. With ``emulate_tty`` it reads from the
    terminal of the launch, if there is one.

    Args:
        text: The bytes.
        process_matcher: Which processes: a predicate over their actions.
    """

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, process_matcher: Callable[[ProcessRunner], bool]) -> None:
        super().__init__(process_matcher=process_matcher)
        self._text = text

    @property
    def text(self) -> bytes:
        """The bytes."""
        return self._text
