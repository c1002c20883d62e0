import threading
import time

import pytest

from rclpy._rclpy_pybind11 import RCLError
from rclpy.clock import Clock, ClockChange, ClockType, JumpHandle, JumpThreshold, ROSClock, TimeJump
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time


class FakeContext:
    """The part of a context that a clock uses."""

    def __init__(self):
        self.valid = True
        self.callbacks = []

    def ok(self):
        return self.valid

    def on_shutdown(self, callback):
        self.callbacks.append(callback)

    def shutdown(self):
        self.valid = False
        for callback in self.callbacks:
            callback()


def ros_time(nanoseconds):
    return Time(nanoseconds=nanoseconds, clock_type=ClockType.ROS_TIME)


def sleeping(clock, until, context):
    """Starts a sleep in a thread; returns the thread and the list that will hold the answer."""
    answers = []
    thread = threading.Thread(target=lambda: answers.append(clock.sleep_until(until, context)))
    thread.start()
    deadline = time.monotonic() + 60
    while not clock._jump_handles and time.monotonic() < deadline:
        time.sleep(0.001)
    assert clock._jump_handles
    return thread, answers


def test_the_clock_type_decides_the_class():
    assert type(Clock()) is Clock
    assert Clock().clock_type is ClockType.SYSTEM_TIME
    assert type(Clock(clock_type=ClockType.ROS_TIME)) is ROSClock
    assert ROSClock().clock_type is ClockType.ROS_TIME
    assert repr(ROSClock()) == "Clock(clock_type=ROS_TIME)"
    with pytest.raises(TypeError, match=r"^Clock type must be a ClockType enum$"):
        Clock(clock_type=1)


@pytest.mark.parametrize("kind", [ClockType.SYSTEM_TIME, ClockType.STEADY_TIME])
def test_only_ros_time_is_overridden(kind):
    clock = Clock(clock_type=kind)
    text = "failed to set ROS time override: Clock is not of type RCL_ROS_TIME, cannot set time"
    with pytest.raises(RCLError, match=text) as caught:
        clock.set_ros_time_override(Time(seconds=1))
    assert "Clock(clock_type=ClockType.ROS_TIME)" in caught.value.hint
    text = "failed to get ROS time override status: .* cannot query override state"
    with pytest.raises(RCLError, match=text):
        _ = clock.ros_time_is_active


def test_each_clock_tells_its_time():
    before = time.time_ns()
    assert before <= Clock().now().nanoseconds <= ROSClock().now().nanoseconds <= time.time_ns()
    before = time.monotonic_ns()
    assert (
        before <= Clock(clock_type=ClockType.STEADY_TIME).now().nanoseconds <= time.monotonic_ns()
    )


def test_ros_time_follows_the_override_while_active():
    clock = ROSClock()
    clock.set_ros_time_override(ros_time(7))
    assert not clock.ros_time_is_active
    assert clock.now().nanoseconds > 7
    clock._set_ros_time_is_active(True)
    assert clock.now() == ros_time(7)
    clock._set_ros_time_is_active(False)
    assert clock.now().nanoseconds > 7
    with pytest.raises(
        TypeError, match=r"^Time must be specified as rclpy.time.Time. Received type: "
    ):
        clock.set_ros_time_override(7)


@pytest.mark.parametrize(
    ("min_forward", "min_backward", "on_clock_change", "steps", "heard"),
    [
        (10, None, False, [5, 15, 26, 20], [10, 11]),
        (None, -10, False, [50, 45, 35, 5], [-10, -30]),
        (1, -1, False, [1, 0, 0], [1, -1]),
    ],
)
def test_jump_thresholds(min_forward, min_backward, on_clock_change, steps, heard):
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    threshold = JumpThreshold(
        min_forward=None if min_forward is None else Duration(nanoseconds=min_forward),
        min_backward=None if min_backward is None else Duration(nanoseconds=min_backward),
        on_clock_change=on_clock_change,
    )
    jumps = []
    handle = clock.create_jump_callback(
        threshold, post_callback=lambda jump: jumps.append(jump.delta.nanoseconds)
    )
    for step in steps:
        clock.set_ros_time_override(ros_time(step))
    assert jumps == heard
    handle.unregister()
    handle.unregister()
    clock.set_ros_time_override(ros_time(1000))
    clock.set_ros_time_override(ros_time(0))
    assert jumps == heard


def test_jump_callbacks_run_before_and_after():
    clock = ROSClock()
    clock.set_ros_time_override(ros_time(5))
    seen = []
    threshold = JumpThreshold(
        min_forward=Duration(nanoseconds=1), min_backward=None, on_clock_change=True
    )
    with clock.create_jump_callback(
        threshold,
        pre_callback=lambda: seen.append(clock.ros_time_is_active),
        post_callback=lambda jump: seen.append(
            (clock.ros_time_is_active, jump.clock_change, jump.delta)
        ),
    ):
        clock.set_ros_time_override(ros_time(6))  # no jump: it is not shown yet
        clock._set_ros_time_is_active(True)
        clock._set_ros_time_is_active(True)
        clock._set_ros_time_is_active(False)
    clock._set_ros_time_is_active(True)
    assert seen == [
        False,
        (True, ClockChange.ROS_TIME_ACTIVATED, Duration()),
        True,
        (False, ClockChange.ROS_TIME_DEACTIVATED, Duration()),
    ]


def test_a_jump_callback_may_unregister_itself():
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    threshold = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=None)
    calls = []

    def once(jump):
        calls.append(jump)
        handle.unregister()

    handle = clock.create_jump_callback(threshold, post_callback=once)
    clock.set_ros_time_override(ros_time(1))
    clock.set_ros_time_override(ros_time(2))
    assert len(calls) == 1


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (
            lambda: JumpThreshold(min_forward=None, min_backward=None, on_clock_change=False),
            "At least one jump threshold must be enabled",
        ),
        (
            lambda: JumpThreshold(min_forward=Duration(), min_backward=None),
            "min_forward must be a positive non-zero duration",
        ),
        (
            lambda: JumpThreshold(min_forward=None, min_backward=Duration()),
            "min_backward must be a negative non-zero duration",
        ),
        (
            lambda: JumpThreshold(min_forward=None, min_backward=Duration(nanoseconds=1)),
            "min_backward must be a negative non-zero duration",
        ),
        (
            lambda: Clock().create_jump_callback(
                JumpThreshold(min_forward=None, min_backward=None)
            ),
            "One of pre_callback or post_callback must be callable",
        ),
        (
            lambda: JumpHandle(
                clock=Clock(),
                threshold=JumpThreshold(min_forward=None, min_backward=None),
                pre_callback=1,
                post_callback=None,
            ),
            "pre_callback must be callable if given",
        ),
        (
            lambda: Clock().create_jump_callback(
                JumpThreshold(min_forward=None, min_backward=None), post_callback=1
            ),
            "post_callback must be callable if given",
        ),
    ],
)
def test_bad_thresholds(make, text):
    with pytest.raises(ValueError) as caught:
        make()
    assert str(caught.value) == text


def test_bad_jump():
    with pytest.raises(
        TypeError, match=r"^clock_change must be an instance of rclpy.clock.ClockChange$"
    ):
        TimeJump(1, Duration())


@pytest.mark.parametrize(
    "clock_type", [ClockType.SYSTEM_TIME, ClockType.STEADY_TIME, ClockType.ROS_TIME]
)
def test_sleep_lasts_until_the_time(clock_type):
    clock = Clock(clock_type=clock_type)
    until = clock.now() + Duration(seconds=0.02)
    assert clock.sleep_until(until, FakeContext()) is True
    assert clock.now() >= until
    until = clock.now() + Duration(seconds=0.02)
    assert clock.sleep_for(Duration(seconds=0.02), FakeContext()) is True
    assert clock.now() >= until
    assert clock.sleep_for(Duration(seconds=-1), FakeContext()) is True


def test_a_simulated_sleep_ends_with_the_clock_message():
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    thread, answers = sleeping(clock, ros_time(100), FakeContext())
    clock.set_ros_time_override(ros_time(50))
    assert answers == []
    clock.set_ros_time_override(ros_time(100))
    thread.join(60)
    assert answers == [True]


def test_a_shutdown_ends_the_sleep():
    clock, context = ROSClock(), FakeContext()
    thread, answers = sleeping(clock, clock.now() + Duration(seconds=60), context)
    context.shutdown()
    thread.join(60)
    assert answers == [False]


@pytest.mark.parametrize("was_active", [False, True])
def test_a_change_of_the_source_ends_the_sleep(was_active):
    clock = ROSClock()
    clock._set_ros_time_is_active(was_active)
    thread, answers = sleeping(clock, clock.now() + Duration(seconds=60), FakeContext())
    clock._set_ros_time_is_active(not was_active)
    thread.join(60)
    assert answers == [False]


def test_bad_sleeps():
    context = FakeContext()
    with pytest.raises(ValueError, match=r"^until's clock type does not match this clock's type$"):
        Clock().sleep_until(ros_time(1), context)
    context.shutdown()
    with pytest.raises(NotInitializedException):
        Clock().sleep_for(Duration(seconds=1), context)
