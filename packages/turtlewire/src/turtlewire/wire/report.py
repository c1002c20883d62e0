"""Warnings of the wire: one line on stderr, each printed once."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from collections.abc import Callable

    from .base import MessageInfo

__all__ = ["call_guarded", "warn", "warn_once"]

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
    """Write ``text`` as a ROS 2 warning, on one line even if a peer's name has line feeds."""
    seconds, nanoseconds = divmod(time.time_ns(), 1_000_000_000)
    sys.stderr.write(f"[WARN] [{seconds}.{nanoseconds:09d}] [turtlewire.wire]: {printable(text)}\n")
    sys.stderr.flush()


def call_guarded(
    on_message: Callable[[bytes, MessageInfo], None], message: tuple[bytes, MessageInfo], topic: str
) -> None:
    """Call ``on_message`` on a thread that serves other subscriptions, too.

    An exception is reported once per topic and goes no further, because it would end the thread.
    """
    try:
        on_message(*message)
    except Exception as error:  # noqa: BLE001 - the thread must continue
        warn_once(
            f"on_message {topic}", f"a message on {topic} was lost, its callback raised {error!r}"
        )
