"""A signal may interrupt the main thread at any moment of a wait, and leaves nothing locked.

An exception at the wrong moment once left the lock of a `threading.Event`: the thread that reads
signals blocked in it, and the program that was to end joined that thread.
"""

import gc
import random
import signal
import sys
import threading

import pytest

from rclpy._execution.running_callbacks import RunningCallbacks
from turtlewire.tf import plain
from turtlewire.wake_up import WakeUp
from turtlewire.wire.queue_wait_set import QueueWaitSet
from turtlewire.wire.reader_thread import ReaderThread

pytestmark = [
    pytest.mark.skipif(sys.platform == "win32", reason="Windows has no interval timers"),
    pytest.mark.skipif(
        sys.version_info[:2] == (3, 14),
        reason="Python 3.14 keeps the lock of `with lock` when a signal's handler raises there",
    ),
]

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
    gc.disable()  # Python only prints what is raised in callbacks of the collector
    yield call
    signal.setitimer(signal.ITIMER_REAL, 0)
    gc.enable()
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


def test_the_reader_thread(interrupt):
    reader, read = ReaderThread(), threading.Event()
    reader.submit(list)  # starts the thread

    def submit():
        while True:
            reader.submit(list)

    for _ in interrupt(submit):
        assert_ends(lambda: reader.submit(read.set))
        assert read.wait(60)
        read.clear()
    assert_ends(reader.close)


def test_a_lookup_of_the_plain_core(interrupt):
    buffer = plain.Buffer()

    def look_up():
        buffer.lookup_transform("world", "turtle1", timeout_ns=60_000_000_000)

    for _ in interrupt(look_up):
        assert_ends(buffer._wake)
    assert not buffer._waits


def test_the_sleep_of_a_rate(node, interrupt):
    rate = node.create_rate(0.001)
    tick = rate._timer.callback

    def sleep():
        while True:
            rate.sleep()

    for _ in interrupt(sleep):
        assert_ends(tick)
    # An interrupted sleep does not count as one that still goes on: the next one uses up its tick.
    tick()
    rate.sleep()
    assert not rate._has_ticked


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
