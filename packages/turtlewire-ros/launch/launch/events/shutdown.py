"""A request to end the launch."""

from __future__ import annotations

from launch.event import Event


class Shutdown(Event):
    """A request to end the launch.

    Args:
        reason: Why.
        due_to_sigint: Whether Ctrl-C is the cause.
    """

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self._reason = reason
        self._due_to_sigint = due_to_sigint

    @property
    def reason(self) -> str:
        """The reason for the shutdown."""
        return self._reason

    @property
    def due_to_sigint(self) -> bool:
        """True if Ctrl-C is the cause."""
        return self._due_to_sigint
