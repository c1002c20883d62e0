"""tf2_ros.MessageFilter.

What can be transformed passes, what never can is dropped with a reason.
"""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geometry_msgs.msg import PointStamped, TransformStamped
from message_filters import Subscriber, TimeSynchronizer
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, FilterFailureReason, MessageFilter


def point(stamp_s, frame="robot"):
    message = PointStamped()
    message.header.frame_id = frame
    message.header.stamp = Time(seconds=stamp_s).to_msg()
    return message


class Setup:
    """A filter, what passed it, and what it dropped."""

    def __init__(self, context, node, *, target="world", queue_size=10, **options):
        self.buffer = Buffer()
        self.passed, self.failed = [], []
        self.filter = MessageFilter(None, self.buffer, target, queue_size, node, **options)
        self.filter.registerCallback(lambda message: self.passed.append(message.header.stamp.sec))
        self.filter.registerFailureCallback(
            lambda message, reason: self.failed.append((message.header.stamp.sec, reason))
        )
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(node)

    def spin_until(self, condition):
        for _ in range(1000):
            if condition():
                return
            self.executor.spin_once(timeout_sec=60)
        raise AssertionError((self.passed, self.failed))

    def settle(self):
        """Let the executor do all there is."""
        for _ in range(20):
            self.executor.spin_once(timeout_sec=0)


@pytest.fixture
def setup(context, node):
    return lambda **options: Setup(context, node, **options)


def test_a_message_passes_at_once_when_the_transform_is_there(setup, stamped):
    s = setup()
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.filter.add(point(1))
    assert s.passed == [1]


def test_messages_wait_for_their_transforms(setup, stamped):
    s = setup()
    s.filter.add(point(1))
    s.filter.add(point(2))
    s.settle()
    assert s.passed == []
    s.buffer.set_transform(stamped(stamp_s=0), "me")
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.spin_until(lambda: s.passed == [1])
    s.buffer.set_transform(stamped(stamp_s=5), "me")
    s.spin_until(lambda: s.passed == [1, 2])
    assert s.failed == []


def test_callbacks_run_on_the_executor_not_where_the_data_come(setup, stamped):
    s = setup()
    s.filter.add(point(1))
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    assert s.passed == []
    s.spin_until(lambda: s.passed == [1])


def test_all_target_frames_must_be_known(setup, stamped):
    s = setup(target=["world", "/map"])
    assert s.filter.getTargetFramesString() == "world map"
    s.filter.add(point(1))
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.settle()
    assert s.passed == []
    s.buffer.set_transform_static(stamped("map", "world"), "me")
    s.spin_until(lambda: s.passed == [1])


def test_another_target_frame_counts_for_those_that_wait(setup, stamped):
    s = setup(target="nowhere")
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.filter.add(point(1))
    s.filter.setTargetFrame("world")
    s.spin_until(lambda: s.passed == [1])


def test_the_tolerance_wants_later_data_too(setup, stamped):
    s = setup(tolerance=Duration(seconds=2))
    s.filter.add(point(1))
    for second in (1, 2):
        s.buffer.set_transform(stamped(stamp_s=second), "me")
    s.settle()
    assert s.passed == []
    s.buffer.set_transform(stamped(stamp_s=3), "me")
    s.spin_until(lambda: s.passed == [1])
    s.filter.setTolerance(Duration())
    s.filter.add(point(3))
    assert s.passed == [1, 3]


def test_the_oldest_is_dropped_when_too_many_wait(setup):
    s = setup(queue_size=2)
    for second in (1, 2, 3):
        s.filter.add(point(second))
    assert s.failed == [(1, FilterFailureReason.QueueFull)]
    s.filter.setQueueSize(0)
    for second in range(4, 30):
        s.filter.add(point(second))
    assert len(s.failed) == 1
    assert s.filter.getQueueSize() == 0


def test_a_message_as_old_as_the_cache_is_long_still_waits(setup, stamped):
    s = setup()
    for second in (5, 11):
        s.buffer.set_transform(stamped(stamp_s=second), "me")
    s.filter.add(point(1))
    older = point(0)
    older.header.stamp.nanosec = 999_999_999
    s.filter.add(older)
    assert s.failed == [(0, FilterFailureReason.OutTheBack)]
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.spin_until(lambda: s.passed == [1])
    assert len(s.failed) == 1


@pytest.mark.parametrize("newest_s", [3, 100])
def test_stamp_0_asks_for_the_latest_transform(setup, stamped, newest_s):
    s = setup(tolerance=Duration(seconds=1))
    s.filter.add(point(0))
    assert s.passed == []
    s.buffer.set_transform(stamped(stamp_s=newest_s), "me")
    s.spin_until(lambda: s.passed == [0])
    s.filter.add(point(0))
    assert s.passed == [0, 0]
    assert s.failed == []


def test_a_message_without_a_frame_is_dropped(setup):
    s = setup()
    s.filter.add(point(1, frame=""))
    assert s.failed == [(1, FilterFailureReason.EmptyFrameID)]


def test_a_message_older_than_the_buffer_is_dropped(setup, stamped):
    s = setup()
    s.filter.add(point(1))
    s.buffer.set_transform(stamped(stamp_s=100), "me")
    s.spin_until(lambda: s.failed == [(1, FilterFailureReason.OutTheBack)])
    s.filter.add(point(2))
    assert s.failed[1:] == [(2, FilterFailureReason.OutTheBack)]


def test_a_message_waits_no_longer_than_the_timeout(setup, stamped):
    s = setup(timeout=Duration(seconds=0.05))
    s.filter.add(point(1))
    s.filter.add(point(2))
    s.spin_until(lambda: len(s.failed) == 2)
    assert s.failed == [
        (1, FilterFailureReason.NoTransformFound),
        (2, FilterFailureReason.NoTransformFound),
    ]
    s.filter.add(point(3))
    s.buffer.set_transform(stamped(stamp_s=3), "me")
    s.spin_until(lambda: s.passed == [3])


def test_no_timer_runs_when_no_message_waits(setup):
    s = setup(timeout=Duration(seconds=0.01))
    assert s.filter._timer.is_canceled()
    s.filter.add(point(1))
    assert not s.filter._timer.is_canceled()
    s.spin_until(lambda: s.failed)
    assert s.filter._timer.is_canceled()


def test_each_message_has_the_timeout_from_its_own_arrival(setup, node):
    clock = node.get_clock()
    clock._set_ros_time_is_active(True)

    def at(milliseconds):
        time = Time(nanoseconds=milliseconds * 1_000_000, clock_type=ClockType.ROS_TIME)
        clock.set_ros_time_override(time)
        s.settle()
        return [stamp for stamp, _ in s.failed]

    s = setup(timeout=Duration(seconds=1))
    assert at(1000) == []
    s.filter.add(point(1))
    at(1400)
    s.filter.add(point(2))
    assert at(1999) == []
    assert at(2000) == [1]
    assert at(2399) == [1]
    assert at(2400) == [1, 2]
    at(9000)
    s.filter.add(point(3))  # after a pause in which nothing waited
    assert at(9999) == [1, 2]
    assert at(10_000) == [1, 2, 3]


def test_waiting_messages_are_dropped_when_the_clock_jumps_back(setup, node, stamped):
    s = setup(timeout=Duration(seconds=1000))
    clock = node.get_clock()
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(Time(seconds=100, clock_type=ClockType.ROS_TIME))
    s.filter.add(point(100))
    clock.set_ros_time_override(Time(seconds=10, clock_type=ClockType.ROS_TIME))
    assert s.failed == [(100, FilterFailureReason.Unknown)]
    s.filter.add(point(10))
    s.buffer.set_transform(stamped(stamp_s=10), "me")
    s.spin_until(lambda: s.passed == [10])


steps = st.lists(
    st.tuples(st.sampled_from(["message", "transform", "spin", "jump"]), st.integers(1, 40)),
    max_size=40,
)


@settings(max_examples=150)
@given(steps, st.integers(1, 5))
def test_each_message_passes_or_is_dropped_once_whatever_comes(things, queue_size):
    context = Context()
    context.init(args=[])
    node = Node("node", context=context)
    s = Setup(context, node, queue_size=queue_size)
    clock, number = node.get_clock(), 0
    clock._set_ros_time_is_active(True)
    came, ended = [], []
    s.filter.registerCallback(lambda message: ended.append(message.header.stamp.nanosec))
    s.filter.registerFailureCallback(
        lambda message, _reason: ended.append(message.header.stamp.nanosec)
    )
    for thing, second in things:
        if thing == "message":
            number += 1
            message = point(second)
            message.header.stamp.nanosec = number  # tells it from the others
            came.append(number)
            s.filter.add(message)
        elif thing == "transform":
            transform = TransformStamped(child_frame_id="robot")
            transform.header.frame_id, transform.header.stamp.sec = "world", second
            s.buffer.set_transform(transform, "me")
        elif thing == "spin":
            s.settle()
        else:
            for time_s in (1000, 1):
                clock.set_ros_time_override(Time(seconds=time_s, clock_type=ClockType.ROS_TIME))
    s.settle()
    waiting = [each.message.header.stamp.nanosec for each in s.filter._waiting]
    for each in s.filter._waiting:
        assert not s.buffer.can_transform(
            "world", "robot", Time.from_msg(each.message.header.stamp)
        )
    assert sorted([*ended, *waiting]) == came
    assert len(waiting) <= queue_size
    node.destroy_node()
    context.try_shutdown()


def test_clear_forgets_silently(setup, stamped):
    s = setup()
    s.filter.add(point(1))
    s.filter.clear()
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.settle()
    assert (s.passed, s.failed) == ([], [])


def test_equal_messages_each_pass(setup, stamped):
    s = setup()
    s.filter.add(point(1))
    s.filter.add(point(1))
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.spin_until(lambda: s.passed == [1, 1])


def test_it_ends_with_its_node(setup, node, stamped):
    s = setup(timeout=Duration(seconds=1))
    s.filter.add(point(1))
    node.destroy_node()
    s.buffer.set_transform(stamped(stamp_s=1), "me")
    s.filter.destroy()
    assert s.passed == []


def test_it_is_one_filter_of_a_chain(spin_until, node, stamped):
    buffer, passed = Buffer(), []
    filters = [
        MessageFilter(Subscriber(node, PointStamped, topic), buffer, "world", 10, node)
        for topic in ("left", "right")
    ]
    TimeSynchronizer(filters, 10).registerCallback(lambda *messages: passed.append(len(messages)))
    for topic in ("left", "right"):
        node.create_publisher(PointStamped, topic, 1).publish(point(1))
    buffer.set_transform(stamped(stamp_s=1), "me")
    spin_until(node, lambda: passed)
    assert passed == [2]
