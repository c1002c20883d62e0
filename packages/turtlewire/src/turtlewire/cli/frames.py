"""`turtlewire frames`: the tree of frames with the age, the rate and the publisher of each link."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from turtlewire import wire
from turtlewire.cli.frame_picture import take_picture
from turtlewire.doctor.network import other_domains_hint
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.listener import TransformListener
from turtlewire.tf.restarts import RestartWatch
from turtlewire.tf.tf_topics import as_options, of_first_robot, other_tf_topics
from turtlewire.wire.environment import domain_id

if TYPE_CHECKING:
    from turtlewire.cli.frame_picture import Picture
    from turtlewire.terminal.keyboard import Keyboard
    from turtlewire.tf.tf_topics import TfTopics
    from turtlewire.wire.base import Graph

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


_CLEAR_SCREEN = "\033[H\033[2J"
_QUIT = "q"
_ASCII = str.maketrans("├└─│", "|`-|")


def show_frames(
    top: str | None, topics: TfTopics, *, once: bool, as_json: bool, period_s: float
) -> int:
    """Listen, and print the tree after every period until interrupted.

    In a terminal, each tree replaces the one before, and keys scroll a tree that is too long.

    Args:
        top: Show only this frame and those below it; None shows all.
        topics: Where the transforms are published.
        once: Print it once.
        as_json: Print each tree as a JSON object in one line.
        period_s: Time between two trees, and before the first.

    Returns:
        The exit status: 1 if there were no frames to print once.
    """
    live = sys.stdout.isatty() and not as_json and not once
    buffer = Buffer()
    restarts = RestartWatch(buffer)
    window, hinted = Window(), False
    with (
        contextlib.closing(wire.open_context()) as context,
        TransformListener(
            buffer, context=context, topic=topics.moving, static_topic=topics.static
        ) as listener,
        open_scroll_keys(wanted=live) as keys,
    ):
        while True:
            if _browse(keys, window, period_s) == _QUIT:
                return 0
            restarts.look()
            picture = take_picture(buffer, time.time_ns(), top, listener.departed_frames(), topics)
            if not (buffer.frames() or as_json or hinted):
                picture = _with_hint(picture, context.graph, topics)
                hinted = not live
            if live:
                window.show(picture)
            else:
                _print(picture.as_json() if as_json else "\n".join(_lines(picture)))
            if once:
                return 0 if picture.rows else 1


def _with_hint(picture: Picture, graph: Graph, topics: TfTopics) -> Picture:
    """Say where transforms are published, or else which other domains have nodes."""
    if others := other_tf_topics(graph, topics):
        options = as_options(of_first_robot(others))
        hint = f"Published are {', '.join(others)}: turtlewire frames {options}"
    else:
        hint = other_domains_hint(domain_id())
    return picture._replace(missing=f"{picture.missing}\n{hint}".rstrip())


def _browse(keys: ScrollKeys, window: Window, seconds: float) -> str:
    """Scroll as the keys say until the time is up or the user quits; the last key."""
    end = time.monotonic() + seconds
    key = ""
    while key != _QUIT and (rest := end - time.monotonic()) > 0.0:
        key = keys.read(rest)
        if key:
            window.press(key)
    return key


class Window:
    """The part of a picture that the terminal has room for."""

    def __init__(self) -> None:
        self._picture: Picture | None = None
        self._first = 0

    def show(self, picture: Picture) -> None:
        """Draw a new picture at the same place."""
        self._picture = picture
        self._draw()

    def press(self, key: str) -> None:
        """Scroll by a key's name; most keys do nothing."""
        if self._picture is None:
            return
        page = max(1, self._room() - 1)
        steps = {"up": -1, "down": 1, "page up": -page, "page down": page, "continue": 0}
        if key in {"home", "end"}:
            self._first = 0 if key == "home" else len(self._picture.rows)
        elif key in steps:
            self._first += steps[key]
        else:
            return
        self._draw()

    def _room(self) -> int:
        """Lines of the terminal between the header and the last line."""
        return max(1, shutil.get_terminal_size().lines - 3)

    def _draw(self) -> None:
        assert self._picture is not None
        header, *lines = _lines(self._picture, shutil.get_terminal_size().columns)
        room = self._room()
        self._first = max(0, min(self._first, len(lines) - room))
        shown = lines[self._first : self._first + room]
        text = [header, *shown]
        if len(lines) > room:
            last = self._first + len(shown)
            text.append(f"{self._first + 1}-{last} of {len(lines)}: arrow keys scroll, q quits")
        _print(_CLEAR_SCREEN + "\n".join(text))


def _lines(picture: Picture, columns: int | None = None) -> list[str]:
    coloured = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    return picture.as_text(coloured=coloured, columns=columns)


def _print(text: str) -> None:
    """Print to a terminal or file of any encoding."""
    encoding = sys.stdout.encoding or "utf-8"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        text = text.translate(_ASCII).encode(encoding, "backslashreplace").decode(encoding)
    print(text, flush=True)
