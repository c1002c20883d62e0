"""The progress line of a recording, a playback or a conversion."""

import fcntl
import io
import os
import pty
import struct
import sys
import termios
import threading
from types import SimpleNamespace

import pytest

from rosbag2_transport import play, rewrite
from rosbag2_transport.progress import ProgressLine, time_text
from turtlewire.bag.playback import PlayClock
from turtlewire.bag.times import size_text

SECOND = 1_000_000_000


def test_it_is_drawn_on_a_terminal_and_never_wraps(monkeypatch):
    outer, inner = pty.openpty()
    fcntl.ioctl(inner, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 20, 0, 0))
    drawn = threading.Event()

    def text():
        drawn.set()
        return "abcdefghijklmnopqrstuvwxyz"

    with open(inner, "w") as terminal:
        monkeypatch.setattr(sys, "stderr", terminal)
        with ProgressLine(text):
            assert drawn.wait(60)
        monkeypatch.undo()
        shown = b""
        while not shown.endswith(b"\r\x1b[K\r"):  # removed at the end
            shown += os.read(outer, 1000)
    os.close(outer)
    assert shown.startswith(b"\rabcdefghijklmnopqrs\x1b[K\r")


def test_the_rate_is_that_of_the_option(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    with ProgressLine(lambda: "text", 0) as line:
        assert not line._thread.is_alive()
    assert sys.stderr.getvalue() == ""
    periods = {rate: ProgressLine(str, rate)._seconds for rate in (None, 1, 4, 1000, -1)}
    assert periods == {None: 0.5, 1: 1, 4: 0.25, 1000: 1 / 30, -1: 1 / 30}


def test_nothing_is_drawn_elsewhere(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with ProgressLine(lambda: "text"):
        pass
    assert sys.stderr.getvalue() == ""


@pytest.mark.parametrize(
    ("rate", "is_paused", "expected"),
    [
        (1.0, True, "playing: 0:30.0 of 1:30.0, paused"),
        (2.0, True, "playing at 2x: 0:30.0 of 1:30.0, paused"),
        (1e-9, False, "playing at 1e-09x: 0:30.0 of 1:30.0, 16666666:40:00.0 left"),
    ],
)
def test_a_playback_tells_what_is_left(rate, is_paused, expected):
    clock = PlayClock(130 * SECOND, rate, is_paused=is_paused, monotonic_ns=lambda: 0)
    player = SimpleNamespace(
        changed=threading.Lock(), clock=clock, start_ns=100 * SECOND, end_ns=190 * SECOND
    )
    assert play._progress(player) == expected


def test_a_conversion_tells_what_is_left():
    assert rewrite._progress(0, 100, 0.0) == "converting"
    assert rewrite._progress(25, 100, 20.0) == "converting:  25%, 1:00.0 left"
    assert rewrite._progress(101, 100, 20.0) == "converting: 100%, 0:00.0 left"


def test_times_and_sizes():
    assert [time_text(s) for s in (-1.0, 59.94, 61.0, 3661.5)] == [
        "0:00.0",
        "0:59.9",
        "1:01.0",
        "1:01:01.5",
    ]
    assert [size_text(n) for n in (0, 1023, 1536, 5 << 40)] == [
        "0 B",
        "1023 B",
        "1.5 KiB",
        "5.0 TiB",
    ]


def test_a_size_changes_its_unit_at_a_power_of_1024():
    sizes = (1023, 1024, 1024**2 - 1, 1024**2)
    assert [size_text(size) for size in sizes] == ["1023 B", "1.0 KiB", "1024.0 KiB", "1.0 MiB"]
