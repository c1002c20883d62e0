"""What this platform can do: the one place that asks for it."""

from __future__ import annotations

import sys

__all__ = ["in_browser"]


def in_browser() -> bool:
    """Whether Python runs in a browser tab (Pyodide).

    There is one thread, no socket, no process to start and no compiled core; signals do not come.
    """
    platform: str = sys.platform  # as a variable: type checkers take the constant for Linux
    return platform == "emscripten"
