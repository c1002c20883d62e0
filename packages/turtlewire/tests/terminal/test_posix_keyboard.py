"""Keys of a pseudo terminal: byte by byte, within a time, and after the end."""

import os
import subprocess
import sys
import threading

import pytest

if sys.platform == "win32":
    pytest.skip("Windows has no pseudo terminals of this kind", allow_module_level=True)

import pty

from turtlewire.terminal.posix_keyboard import PosixKeyboard

ENOUGH_S = 60.0


@pytest.fixture
def terminal():
    ours, theirs = pty.openpty()
    yield ours, theirs
    for fd in (ours, theirs):
        os.close(fd)


def test_bytes_come_one_by_one_or_all_that_were_typed(terminal):
    ours, theirs = terminal
    with PosixKeyboard(theirs) as keyboard:
        os.write(ours, b"ab\x1b[A")
        assert keyboard.read() == b"a"
        typed = b""
        while len(typed) < 4:
            typed += keyboard.read_within(ENOUGH_S)
        assert typed == b"b\x1b[A"


def test_nothing_typed_within_the_time_is_none(terminal):
    with PosixKeyboard(terminal[1]) as keyboard:
        assert keyboard.read_within(0.0) is None


def test_a_process_that_goes_on_draws_again_but_waits_on_for_a_byte(terminal):
    ours, theirs = terminal
    with PosixKeyboard(theirs) as keyboard:
        keyboard._resume()  # what SIGCONT does
        assert keyboard.read_within(ENOUGH_S) is None
        keyboard._resume()
        os.write(ours, b"x")
        assert keyboard.read() == b"x"


def test_stop_ends_this_read_and_all_later_ones(terminal):
    ours, theirs = terminal
    with PosixKeyboard(theirs) as keyboard:
        keyboard._resume()
        thread = threading.Thread(target=keyboard.stop)
        thread.start()
        assert keyboard.read() == b""
        thread.join()
        os.write(ours, b"x")
        assert keyboard.read() == b""
        assert keyboard.read_within(ENOUGH_S) == b""


def test_no_terminal_is_an_error(tmp_path):
    with open(tmp_path / "file", "w") as file, pytest.raises(OSError):
        PosixKeyboard(file.fileno())


READS_WHILE_A_SIGNAL_COMES = """
import ctypes, functools, signal
from turtlewire.terminal.posix_keyboard import PosixKeyboard

class LateSignal:
    # Called by select() in C: no handler in Python runs before the wait.
    fileno = staticmethod(functools.partial(getattr(ctypes.CDLL(None), "raise"), signal.SIGQUIT))

keyboard = PosixKeyboard(0)
signal.signal(signal.SIGQUIT, lambda *_: keyboard.stop())
keyboard._fd = LateSignal()
assert keyboard.read() == b""
assert signal.set_wakeup_fd(-1) == -1
"""


def test_a_signal_just_before_the_wait_ends_it(terminal):
    reader = [sys.executable, "-c", READS_WHILE_A_SIGNAL_COMES]
    subprocess.run(reader, stdin=terminal[1], check=True, timeout=ENOUGH_S)


def test_a_read_on_another_thread_leaves_signals_alone(terminal):
    ours, theirs = terminal
    typed = []
    with PosixKeyboard(theirs) as keyboard:
        thread = threading.Thread(target=lambda: typed.append(keyboard.read()))
        thread.start()
        os.write(ours, b"x")
        thread.join()
    assert typed == [b"x"]
