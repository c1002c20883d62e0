"""Signals that are acted on while the main thread waits."""

import signal
import sys
import threading

import pytest

from turtlewire.terminal.signal_watch import watched

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="SIGUSR1 is a signal of POSIX")
LIMIT_S = 120


@pytest.fixture(autouse=True)
def _handlers():
    former = {
        number: signal.signal(number, lambda *_: None)
        for number in (signal.SIGUSR1, signal.SIGUSR2)
    }
    yield
    for number, handler in former.items():
        signal.signal(number, handler)


def wakeup_fd():
    number = signal.set_wakeup_fd(-1)
    signal.set_wakeup_fd(number)
    return number


def test_signal_on_another_thread_ends_the_main_wait():
    acted = threading.Event()
    release = threading.Event()
    other = threading.Thread(target=release.wait)
    other.start()
    with watched([signal.SIGUSR1], acted.set):
        signal.pthread_kill(other.ident, signal.SIGUSR1)
        assert acted.wait(LIMIT_S)
    release.set()
    other.join()


def test_only_the_signals_that_were_named_act():
    seen, second = [], threading.Event()

    def act():
        seen.append("one")
        if len(seen) == 2:
            second.set()

    with watched([signal.SIGUSR1], act):
        for number in (signal.SIGUSR1, signal.SIGUSR2, signal.SIGUSR1):
            signal.raise_signal(number)
        assert second.wait(LIMIT_S)
    assert seen == ["one", "one"]


def test_afterwards_all_is_as_before():
    before, threads = wakeup_fd(), {*threading.enumerate()}
    with watched([signal.SIGUSR1], lambda: None):
        assert wakeup_fd() != before
        assert {*threading.enumerate()} - threads
    assert wakeup_fd() == before
    assert not {*threading.enumerate()} - threads


def test_in_another_thread_nothing_is_watched():
    before, inside = wakeup_fd(), []

    def work():
        with watched([signal.SIGUSR1], lambda: None):
            inside.extend(threading.enumerate())

    known = {*threading.enumerate()}
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert {*inside} - known == {thread}
    assert wakeup_fd() == before
