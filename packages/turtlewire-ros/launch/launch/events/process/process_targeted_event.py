"""A request to processes of the launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch._kernel.protocols import ProcessRunner


class ProcessTargetedEvent(Event):
    """A request to each process whose action fulfils a predicate.

    Args:
        process_matcher: The predicate, for example ``matches_action(node)``.
    """

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[ProcessRunner], bool]) -> None:
        self._process_matcher = process_matcher

    @property
    def process_matcher(self) -> Callable[[ProcessRunner], bool]:
        """The predicate."""
        return self._process_matcher
