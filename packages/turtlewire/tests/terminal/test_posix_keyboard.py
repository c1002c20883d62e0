"""Keys of a pseudo terminal: byte by byte, within a time, and after the end."""

import os
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
