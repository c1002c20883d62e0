"""Runs tests of pytest in a separate process."""

from __future__ import annotations

import sys
from typing import Any

from launch_testing.actions.test import Test


class PyTest(Test):
    """Runs tests of pytest in a separate process.

    Args:
        path: Path of the file or folder.
        **kwargs: See :class:`Test`.
    """

    def __init__(self, *, path: str, **kwargs: Any) -> None:
        super().__init__(cmd=[sys.executable, "-m", "pytest", path], **kwargs)
        self._path = path

    @property
    def path(self) -> str:
        """Path of the file or folder."""
        return self._path
