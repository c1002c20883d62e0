"""Predicates over the processes of a launch."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch._kernel.protocols import ProcessRunner


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


def matches_executable(executable: str) -> Callable[[ProcessRunner], bool]:
    """Matches processes that run the executable with this file name."""
    return lambda action: (
        action.process_details is not None
        and os.path.basename(action.process_details["cmd"][0]) == executable
    )
