"""Warnings of the wire: one line on stderr, each printed once."""

from __future__ import annotations

import sys
import time
from contextlib import suppress

from turtlewire.terminal.printable import printable

#: Keys contain names, and peers may invent new ones without end. After this many the set is
#: cleared, and a warning can be repeated.
_MOST_KEYS = 1000
_said: set[str] = set()


def warn_once(key: str, text: str) -> None:
    """Write ``text`` as a ROS 2 warning, once for each ``key``; see ``_MOST_KEYS``."""
    if key not in _said:
        if len(_said) >= _MOST_KEYS:
            _said.clear()
        _said.add(key)
        warn(text)


def warn(text: str) -> None:
    """Write ``text`` as a ROS 2 warning, on one line even if a peer's name has line feeds.

    Never raises: it is called on threads that must go on.
    """
    seconds, nanoseconds = divmod(time.time_ns(), 1_000_000_000)
    line = f"[WARN] [{seconds}.{nanoseconds:09d}] [turtlewire.wire]: {printable(text)}\n"
    with suppress(OSError, ValueError, AttributeError):  # stderr may be closed, or None
        sys.stderr.write(line)
        sys.stderr.flush()
