"""Timers and rates. Their clock is moved by hand where it matters."""

import threading
import time

import pytest

from rclpy._execution.timer_queue import TimerQueue
from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType, ROSClock
from rclpy.exceptions import InvalidHandle, ROSInterruptException
from rclpy.executors import ExternalShutdownException
from rclpy.time import Time
from rclpy.timer import Timer
from turtlewire.wire.queue_wait_set import QueueWaitSet

MS = 1_000_000


@pytest.fixture
def clock():
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    move(clock, 1000)
    return clock


def move(clock, milliseconds):
    clock.set_ros_time_override(Time(nanoseconds=milliseconds * MS, clock_type=ClockType.ROS_TIME))


def drain(executor):
    for _ in range(10):
        executor.spin_once(timeout_sec=0)


@pytest.mark.parametrize(
    ("moves", "calls", "until_next"),
    [
        pytest.param([1099, 1100], [1100], 100, id="the first call comes after one period"),
        pytest.param(
            [1100, 1475, 1499, 1500, 1600],
            [1100, 1475, 1500, 1600],
            100,
            id="missed periods are skipped and the rhythm is kept",
        ),
        pytest.param([1299], [1299], 1, id="a period that ends soon is not missed"),
        pytest.param([1299, 1300], [1299, 1300], 100, id="it ends in a call of its own"),
        pytest.param([1300], [1300, 1300], 100, id="nor is one that ends now"),
        pytest.param([1130, 1199, 1200], [1130, 1200], 100, id="a late call moves no other"),
        pytest.param([1100, 500, 599, 600], [1100, 600], 100, id="back behind the last call"),
        pytest.param([1130, 1150, 1130], [1130], 70, id="back to the last call"),
        pytest.param([1130, 1150, 1129], [1130], 100, id="back just behind the last call"),
    ],
)
def test_calls_while_the_clock_moves(node, executor, clock, moves, calls, until_next):
    """Only a jump to before the last call starts a whole period."""
    made = []
    timer = node.create_timer(0.1, lambda: made.append(clock.now().nanoseconds // MS), clock=clock)
    for now in moves:
        move(clock, now)
        drain(executor)
    assert made == calls
    assert timer.time_until_next_call() == until_next * MS


def test_rest_of_the_period_survives_a_clock_change(node, clock):
    timer = node.create_timer(10.0, None, clock=clock)
    move(clock, 4000)
    clock._set_ros_time_is_active(False)
    assert 6_900 * MS < timer.time_until_next_call() <= 7_000 * MS


def test_a_cancelled_timer_makes_no_calls_until_it_is_reset(node, executor, clock):
    calls = []
    timer = node.create_timer(0.1, lambda: calls.append(clock.now().nanoseconds // MS), clock=clock)
    timer.cancel()
    assert timer.is_canceled()
    assert timer.time_until_next_call() is None
    move(clock, 1500)
    drain(executor)
    assert calls == []
    timer.reset()
    assert not timer.is_canceled()
    move(clock, 1600)
    drain(executor)
    assert calls == [1600]


def test_a_timer_that_does_not_start_by_itself_waits_for_reset(node, executor, clock):
    calls = []
    timer = node.create_timer(0.1, lambda: calls.append(1), clock=clock, autostart=False)
    move(clock, 1500)
    drain(executor)
    assert timer.is_canceled()
    assert calls == []


def test_times_are_nanoseconds(node, clock):
    timer = node.create_timer(0.25, None, clock=clock)
    move(clock, 1100)
    assert timer.timer_period_ns == 250 * MS
    assert timer.time_since_last_call() == 100 * MS
    assert timer.time_until_next_call() == 150 * MS
    assert not timer.is_ready()
    timer.timer_period_ns = 500 * MS
    assert timer.time_until_next_call() == 150 * MS
    assert timer.clock is clock


def test_a_destroyed_timer_raises(node):
    timer = node.create_timer(1.0, None)
    assert list(node.timers) == [timer]
    assert node.destroy_timer(timer)
    assert not node.destroy_timer(timer)
    assert list(node.timers) == []
    with pytest.raises(InvalidHandle):
        timer.is_ready()


def test_a_period_must_not_be_negative(node):
    with pytest.raises(RCLError, match="failed to create timer: timer period must be non-negative"):
        node.create_timer(-1.0, None)


@pytest.mark.parametrize(
    "clock_type", [ClockType.STEADY_TIME, ClockType.SYSTEM_TIME, ClockType.ROS_TIME]
)
def test_a_timer_on_a_real_clock_ends_the_wait_of_the_executor(node, executor, clock_type):
    called = []
    start = time.monotonic()
    node.create_timer(
        0.02, lambda: called.append(time.monotonic()), clock=Clock(clock_type=clock_type)
    )
    while len(called) < 3:
        executor.spin_once(timeout_sec=60)
    assert called[-1] - start >= 0.055
    assert called[-1] - start < 30


def test_the_executor_waits_no_longer_than_to_the_next_call(node, executor, monkeypatch):
    waits = []
    wait = QueueWaitSet.wait
    monkeypatch.setattr(
        QueueWaitSet,
        "wait",
        lambda waiting, timeout_ns=None: waits.append(timeout_ns) or wait(waiting, timeout_ns),
    )
    called = []
    timer = node.create_timer(0.02, lambda: called.append(1))
    while not called:
        left = timer.time_until_next_call()
        executor.spin_once(timeout_sec=60)
        assert waits.pop() <= max(left, 0)


def test_a_timer_made_while_the_executor_waits_is_served(node, executor, spinning):
    called = threading.Event()
    spinning(executor)
    node.create_timer(0.01, called.set)
    assert called.wait(60)


def spin_until_shutdown(executor):
    with pytest.raises(ExternalShutdownException):
        executor.spin()


def test_a_rate_keeps_its_frequency_and_ends_with_the_context(later, context, node, executor):
    start = time.monotonic()
    rate = node.create_rate(100)
    spinning = threading.Thread(target=spin_until_shutdown, args=(executor,))
    spinning.start()
    for _ in range(5):
        rate.sleep()
    assert time.monotonic() - start >= 0.035
    assert node.destroy_rate(rate)
    slow = node.create_rate(0.001)
    later(context.shutdown)
    with pytest.raises(ROSInterruptException):
        slow.sleep()
    spinning.join(60)
    assert not spinning.is_alive()


def test_one_thread_may_spin_once_and_then_sleep(node, executor):
    """As in the tutorial "Using URDF with robot_state_publisher"."""
    rate = node.create_rate(100)
    for _ in range(3):
        executor.spin_once()
        rate.sleep()


def test_a_destroyed_rate_does_not_sleep(later, node):
    rate = node.create_rate(0.001)
    later(node.destroy_rate, rate)
    with pytest.raises(RuntimeError, match="Rate cannot sleep because it has been destroyed"):
        rate.sleep()
    with pytest.raises(RuntimeError, match="Rate cannot sleep because it has been destroyed"):
        rate.sleep()


def test_rate_raises_in_the_spinning_thread(node, executor):
    rate = node.create_rate(0.001)  # not due before the other timer, however busy the machine is
    node.create_timer(0.001, rate.sleep)
    with pytest.raises(
        RuntimeError,
        match="Rate cannot sleep in a callback of the executor that serves its timer: it would "
        "never wake up",
    ):
        executor.spin()  # spin_once may find something else ready before the timer


def test_a_rate_may_sleep_in_a_callback_of_another_thread_of_the_pool(node, pool, spinning):
    rate, slept = node.create_rate(100), threading.Event()

    def sleep_once():
        timer.cancel()
        rate.sleep()
        slept.set()

    timer = node.create_timer(0.001, sleep_once, callback_group=ReentrantCallbackGroup())
    spinning(pool)
    assert slept.wait(60)


def test_a_frequency_must_be_positive(node):
    with pytest.raises(ValueError, match="frequency must be > 0"):
        node.create_rate(0)


class _Waited:
    """Stands for an executor's wait."""

    def __init__(self):
        self.woken = 0

    def __call__(self):
        self.woken += 1


def test_the_queue_wakes_a_waiting_thread_for_an_earlier_timer_only():
    waited = _Waited()
    queue = TimerQueue(waited)
    slow, fast, idle = (Timer(None, None, 0, Clock(), context=object()) for _ in range(3))
    assert queue.time_until_next() is None
    queue.schedule(slow, 10_000_000_000)
    assert waited.woken == 1
    assert queue.pop_due() == []
    assert 9_000_000_000 < queue.time_until_next() <= 10_000_000_000
    queue.schedule(idle, 20_000_000_000)
    assert waited.woken == 1
    queue.schedule(fast, 0)
    assert waited.woken == 2
    assert queue.time_until_next() == 0
    assert queue.pop_due() == [fast]
    assert queue.pop_due() == []
    queue.schedule(fast, 0)  # by the thread itself, which waits again afterwards
    assert waited.woken == 2
    assert queue.time_until_next() == 0


def test_an_entry_that_was_replaced_or_discarded_does_not_count():
    queue = TimerQueue(lambda: None)
    timer, other = (Timer(None, None, 0, Clock(), context=object()) for _ in range(2))
    queue.schedule(timer, 0)
    queue.schedule(timer, 50_000_000_000)
    queue.schedule(other, 0)
    queue.discard(other)
    assert queue.pop_due() == []
    queue.schedule(timer, 0)
    assert queue.pop_due() == [timer]
    assert queue.time_until_next() is None
