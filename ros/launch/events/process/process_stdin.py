"""A process is to be sent input."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.events.process.process_targeted_event import ProcessTargetedEvent

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch._kernel.protocols import ProcessRunner

__all__ = ["ProcessStdin"]


class ProcessStdin(ProcessTargetedEvent):
    """A process is to be sent input. Reaches it when its input is a pipe, that is, when the launch has no terminal.

    Args:
        text: The bytes.
        process_matcher: Which processes.
    """

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, process_matcher: Callable[[ProcessRunner], bool]) -> None:
        super().__init__(process_matcher=process_matcher)
        self._text = text

    @property
    def text(self) -> bytes:
        """The bytes."""
        return self._text
