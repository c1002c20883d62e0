"""A signal may interrupt the main thread at any moment of a wait, and leaves nothing locked.

An exception at the wrong moment once left the lock of a `threading.Event`: the thread that reads
signals blocked in it, and the program that was to end joined that thread.
"""

from __future__ import annotations

import random
import signal
import sys
import threading

import pytest

from rclpy._execution.running_callbacks import RunningCallbacks
from turtlewire.wake_up import WakeUp
from turtlewire.wire.queue_wait_set import QueueWaitSet

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no interval timers")

ROUNDS = 400
LONGEST_S = 0.0003


class Interrupted(Exception):
    """What the signal raises."""


@pytest.fixture
def interrupt():
    """Calls a function that does not return, again and again, until a signal ends it."""

    def raise_it(*_):
        raise Interrupted

    moment = random.Random(1)

    def run_until_interrupted(function):
        # again after a while, should one come where Python drops exceptions
        signal.setitimer(signal.ITIMER_REAL, moment.uniform(1e-5, LONGEST_S), 5)
        function()

    def call(function):
        for _ in range(ROUNDS):
            with pytest.raises(Interrupted):
                run_until_interrupted(function)
            signal.setitimer(signal.ITIMER_REAL, 0)
            yield

    before = signal.signal(signal.SIGALRM, raise_it)
    yield call
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def assert_ends(function):
    """The function ends in another thread."""
    thread = threading.Thread(target=function, daemon=True)
    thread.start()
    thread.join(60)
    assert not thread.is_alive()


def test_a_wait_for_the_graph(context, interrupt):
    for _ in interrupt(lambda: context.wait_for_graph(lambda: False, None)):
        assert_ends(context.wake_waits)
        assert_ends(context.wire.graph.notify_changed)


def test_listening_to_the_graph(context, interrupt):
    graph = context.wire.graph

    def listen():
        while True:
            graph.add_listener(list)()

    for _ in interrupt(listen):
        assert_ends(lambda: graph.wait_for(lambda: False, 0))


def test_running_callbacks(interrupt):
    running = RunningCallbacks()

    def run():
        while True:
            with running:
                pass

    for _ in interrupt(run):
        assert_ends(lambda: running.wait_for_others(0))


def test_waking_a_wait_set_of_queues(interrupt):
    wait_set = QueueWaitSet(threading.RLock(), list)

    def wake():
        while True:
            wait_set.wake()

    for _ in interrupt(wake):
        assert_ends(lambda: wait_set.wait(0))


def test_a_wake_up(interrupt):
    wake_up = WakeUp()

    def wait():
        while True:
            wake_up.set()
            wake_up.wait()

    for _ in interrupt(wait):
        assert_ends(wake_up.set)
        assert wake_up.wait(60)


def test_a_wake_up_is_cleared_by_the_wait():
    wake_up = WakeUp()
    assert not wake_up.wait(0)
    wake_up.set()
    wake_up.set()
    assert wake_up.wait()
    assert not wake_up.wait(-1)
