"""Runs a test program of GoogleTest."""

from __future__ import annotations

from typing import Any

from launch_testing.actions.test import Test


class GTest(Test):
    """Runs a test program of GoogleTest.

    Args:
        path: Path of the program.
        **kwargs: See :class:`Test`.
    """

    def __init__(self, *, path: str, **kwargs: Any) -> None:
        super().__init__(cmd=[path], **kwargs)
        self._path = path

    @property
    def path(self) -> str:
        """Path of the program."""
        return self._path
