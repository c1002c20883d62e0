"""Predicates over the processes of a launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.events.process.process_matchers import (
    matches_executable,
    matches_name,
    matches_pid,
)

if TYPE_CHECKING:
    from launch._kernel.protocols import ProcessRunner

__all__ = ["matches_action", "matches_executable", "matches_name", "matches_pid"]


def matches_action(target_action: ProcessRunner) -> Callable[[ProcessRunner], bool]:
    """Matches the process that this action runs."""
    return lambda action: action is target_action
