"""What the wire has to say to a person: one line on stderr, and each thing once."""

from __future__ import annotations

import sys
import time

__all__ = ["warn_once"]

_said: set[str] = set()


def warn_once(key: str, text: str) -> None:
    """Write ``text`` as a ROS 2 warning, unless something was said under ``key`` before in this process."""
    if key in _said:
        return
    _said.add(key)
    seconds, nanoseconds = divmod(time.time_ns(), 1_000_000_000)
    sys.stderr.write(f"[WARN] [{seconds}.{nanoseconds:09d}] [turtlewire.wire]: {text}\n")
    sys.stderr.flush()
