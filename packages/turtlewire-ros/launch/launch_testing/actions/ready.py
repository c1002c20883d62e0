"""Starts the tests."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch import LaunchContext


class ReadyToTest(Action):
    """Lets the tests begin as soon as it is visited; each description of a test needs one."""

    def __init__(self) -> None:
        super().__init__()
        self._callbacks: list[Callable[[], object]] = []

    def add_callback(self, callback: Callable[[], object]) -> None:
        """Add a function that is called at its visit."""
        self._callbacks.append(callback)

    def execute(self, context: LaunchContext) -> None:
        """Call the functions."""
        del context
        for callback in self._callbacks:
            callback()
