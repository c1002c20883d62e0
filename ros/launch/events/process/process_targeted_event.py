"""A request to processes of the launch."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch._kernel.protocols import ProcessRunner

__all__ = ["ProcessTargetedEvent", "matches_executable", "matches_name", "matches_pid"]


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


def matches_pid(pid: int) -> Callable[[ProcessRunner], bool]:
    """Matches the process with this id."""
    return lambda action: (
        action.process_details is not None and action.process_details["pid"] == pid
    )


def matches_name(name: str) -> Callable[[ProcessRunner], bool]:
    """Matches the process with this unique name."""
    return lambda action: (
        action.process_details is not None and action.process_details["name"] == name
    )


def matches_executable(exec_name: str) -> Callable[[ProcessRunner], bool]:
    """Matches processes that run the executable with this file name."""
    return lambda action: (
        action.process_details is not None
        and os.path.basename(action.process_details["cmd"][0]) == exec_name
    )
