"""The keys that scroll a picture in the terminal, by name."""

from __future__ import annotations

import contextlib
import os
import re
import signal
import sys
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtlewire.terminal.keyboard import Keyboard

__all__ = ["ScrollKeys", "open_scroll_keys"]

#: What terminals send for the keys that scroll; letters are those of less and vi.
_NAMES = {
    "\033[A": "up",
    "\033OA": "up",
    "k": "up",
    "\033[B": "down",
    "\033OB": "down",
    "j": "down",
    "\r": "down",
    "\n": "down",
    "\033[5~": "page up",
    "b": "page up",
    "\033[6~": "page down",
    " ": "page down",
    "\033[H": "home",
    "\033[1~": "home",
    "g": "home",
    "\033[F": "end",
    "\033[4~": "end",
    "G": "end",
}
_KEY = re.compile(r"\033(?:\[[0-9;]*[A-Za-z~]|O[A-Z])|.", re.DOTALL)
#: What :meth:`ScrollKeys.read` returns after Ctrl-Z and ``fg``: the screen must be drawn again.
_CONTINUE = "continue"


class ScrollKeys:
    """The base without keys, for a program whose input is not its terminal."""

    def read(self, seconds: float) -> str:
        """Return the name of the next key, or an empty string after a number of seconds."""
        threading.Event().wait(seconds)  # never set: a signal or the timeout ends the wait
        return ""


class _TerminalKeys(ScrollKeys):
    """Names the keys of a terminal."""

    def __init__(self, keyboard: Keyboard) -> None:
        self._keyboard = keyboard
        self._typed: deque[str] = deque()

    def read(self, seconds: float) -> str:
        if self._typed:
            return self._typed.popleft()
        end = time.monotonic() + seconds
        typed = self._keyboard.read_within(seconds)
        if typed is None:
            return _CONTINUE if time.monotonic() < end else ""
        if not typed:  # the terminal is gone
            raise KeyboardInterrupt
        keys = _KEY.findall(typed.decode(errors="replace"))
        self._typed.extend(_NAMES.get(key, key) for key in keys)
        return self._typed.popleft() if self._typed else ""


@contextlib.contextmanager
def open_scroll_keys(*, wanted: bool) -> Iterator[ScrollKeys]:
    """The keys of standard input, if that is a terminal in whose foreground this process is.

    The terminal is put back at the end, also when SIGTERM or SIGHUP ends the process, and set up
    again after Ctrl-Z and ``fg``.

    Args:
        wanted: False gives no keys.
    """
    if sys.platform == "win32" or not wanted or not _in_foreground():
        yield ScrollKeys()
        return
    from turtlewire.terminal.keyboard import Keyboard

    ending = (signal.SIGTERM, signal.SIGHUP)
    former = {signum: signal.signal(signum, _leave) for signum in ending}
    try:
        with Keyboard(sys.stdin.fileno()) as keyboard:
            yield _TerminalKeys(keyboard)
    finally:
        for signum, handler in former.items():
            signal.signal(signum, handler)


def _in_foreground() -> bool:
    """Return True if keys can be read; a process in the background would be stopped for trying."""
    if sys.platform == "win32" or sys.stdin is None or not sys.stdin.isatty():
        return False
    return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()


def _leave(signum: int, _frame: Any) -> None:
    raise SystemExit(128 + signum)
