"""Keys of a terminal, one at a time and without echo."""

from __future__ import annotations

import contextlib
import os
import re
import signal
import sys
import threading
from collections import deque
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Keyboard", "open_keyboard"]

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
#: What :meth:`Keyboard.read` returns after Ctrl-Z and ``fg``: the screen must be drawn again.
_CONTINUE = "continue"


class Keyboard:
    """No keys: for a program whose input is no terminal of its own."""

    def read(self, seconds: float) -> str:
        """Return the name of the next key, or an empty string after a number of seconds."""
        threading.Event().wait(seconds)  # nothing sets it: a signal or the time ends the wait
        return ""


class _TerminalKeyboard(Keyboard):
    """Reads from a terminal that gives each key as it is pressed."""

    def __init__(self, fd: int) -> None:
        self._fd = fd
        self._wake_read, self._wake_write = os.pipe()
        self._typed: deque[str] = deque()

    def read(self, seconds: float) -> str:
        import select

        if self._typed:
            return self._typed.popleft()
        ready, _, _ = select.select([self._fd, self._wake_read], [], [], seconds)
        if self._wake_read in ready:
            os.read(self._wake_read, 1)
            return _CONTINUE
        if self._fd not in ready:
            return ""
        typed = os.read(self._fd, 64)
        if not typed:  # the terminal is gone
            raise KeyboardInterrupt
        keys = _KEY.findall(typed.decode(errors="replace"))
        self._typed.extend(_NAMES.get(key, key) for key in keys)
        return self._typed.popleft() if self._typed else ""

    def wake(self) -> None:
        """End the present or the next read with ``continue``."""
        os.write(self._wake_write, b"\0")

    def close(self) -> None:
        """Close the pipe that wakes reads."""
        os.close(self._wake_read)
        os.close(self._wake_write)


@contextlib.contextmanager
def open_keyboard(*, wanted: bool) -> Iterator[Keyboard]:
    """The keys of standard input, if that is a terminal in whose foreground this process is.

    The terminal is put back at the end, also when SIGTERM or SIGHUP ends the process, and set up
    again after Ctrl-Z and ``fg``.

    Args:
        wanted: False gives a keyboard without keys.
    """
    if sys.platform == "win32" or not wanted or not _in_foreground():
        yield Keyboard()
        return
    import termios

    fd = sys.stdin.fileno()
    cooked = termios.tcgetattr(fd)
    keyboard = _TerminalKeyboard(fd)

    def set_up(*_: Any) -> None:
        _give_each_key(fd)
        keyboard.wake()

    handlers = {signal.SIGCONT: set_up, signal.SIGTERM: _leave, signal.SIGHUP: _leave}
    former = {signum: signal.signal(signum, handler) for signum, handler in handlers.items()}
    try:
        _give_each_key(fd)
        yield keyboard
    finally:
        for signum, handler in former.items():
            signal.signal(signum, handler)
        with contextlib.suppress(termios.error):  # the terminal is gone: nothing to put back
            termios.tcsetattr(fd, termios.TCSANOW, cooked)
        keyboard.close()


def _in_foreground() -> bool:
    """Return True if keys can be read; a process in the background would be stopped for trying."""
    if sys.platform == "win32" or sys.stdin is None or not sys.stdin.isatty():
        return False
    return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()


def _give_each_key(fd: int) -> None:
    if sys.platform == "win32":
        return
    import termios

    raw = termios.tcgetattr(fd)
    raw[3] &= ~(termios.ICANON | termios.ECHO)
    raw[6][termios.VMIN], raw[6][termios.VTIME] = 1, 0
    termios.tcsetattr(fd, termios.TCSANOW, raw)


def _leave(signum: int, _frame: Any) -> None:
    raise SystemExit(128 + signum)
