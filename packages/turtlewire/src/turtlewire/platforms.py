"""The capabilities of this platform, and the core that the environment requests."""

from __future__ import annotations

import functools
import os
import sys

_UNKNOWN = "turtlewire: TURTLEWIRE_CORE is {!r}; it can be 'native' or 'python'. It is ignored."


def in_browser() -> bool:
    """Return True if Python runs in a browser tab (Pyodide).

    There is one thread, no socket, no process to start and no compiled core; signals do not come.
    """
    platform: str = sys.platform  # as a variable: type checkers take the constant for Linux
    return platform == "emscripten"


@functools.cache
def asked_core() -> str:
    """Return the core that ``TURTLEWIRE_CORE`` asks for: ``native``, ``python`` or empty.

    The first call decides; it ignores any other value with one line on stderr.
    """
    asked = os.environ.get("TURTLEWIRE_CORE", "")
    if asked in {"", "native", "python"}:
        return asked
    print(_UNKNOWN.format(asked), file=sys.stderr)  # noqa: T201
    return ""
