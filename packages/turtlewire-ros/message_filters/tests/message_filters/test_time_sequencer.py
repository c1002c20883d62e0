"""Messages in the order of their stamps, by a clock that the tests set."""

import gc
import weakref

import pytest

from geometry_msgs.msg import PointStamped
from message_filters import SimpleFilter, TimeSequencer
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Header, String


def at(seconds, frame=""):
    return PointStamped(header=Header(stamp=Time(seconds=seconds).to_msg(), frame_id=frame))


class World:
    """A node in simulated time, and the stamps that a sequencer passed on."""

    def __init__(self, node, executor):
        self.node = node
        self.executor = executor
        self.clock = node.get_clock()
        self.clock._set_ros_time_is_active(True)
        self.source = SimpleFilter()
        self.passed = []
        self.ticks = 0
        self.set_clock(100)

    def set_clock(self, seconds):
        self.clock.set_ros_time_override(Time(seconds=seconds, clock_type=ClockType.ROS_TIME))

    def sequencer(self, delay=1.0, update_rate=0.5, queue_size=10, **options):
        made = TimeSequencer(self.source, delay, update_rate, queue_size, self.node, **options)
        made.registerCallback(lambda message: self.passed.append(message.header.stamp.sec))
        # Created after it and with the same period, so this timer fires after its.
        self.node.create_timer(0.5, self._tick)
        return made

    def _tick(self):
        self.ticks += 1

    def send(self, *seconds):
        for each in seconds:
            self.source.signalMessage(at(each))

    def until(self, seconds):
        """Set the clock, and wait until the timers have fired."""
        before = self.ticks
        self.set_clock(seconds)
        for _ in range(1000):
            if self.ticks > before:
                return self.passed
            self.executor.spin_once(timeout_sec=60)
        raise AssertionError(self.passed)


@pytest.fixture
def world(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    context = Context()
    context.init(args=[])
    node = Node("sequencer", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    yield World(node, executor)
    node.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize("delay", [2, 2.0, Duration(seconds=2)])
def test_messages_pass_by_stamp_once_they_are_as_old_as_the_delay(world, delay):
    world.sequencer(delay, Duration(seconds=0.5))
    world.send(103, 101, 102)
    assert world.until(102.9) == []
    assert world.until(103.5) == [101]
    assert world.until(105) == [101, 102, 103], "exactly the delay is old enough"


def test_nothing_passes_between_two_looks(world):
    world.sequencer(update_rate=50.0)
    world.send(101)
    assert world.until(120) == []
    assert world.until(151) == [101]


def test_late_messages_are_dropped_and_equal_stamps_are_not(world):
    world.sequencer()
    world.send(102)
    assert world.until(103) == [102]
    world.send(101, 102, 103)
    assert world.until(104) == [102, 102, 103]


def test_equal_stamps_stay_in_the_order_of_arrival(world):
    frames = []
    world.sequencer().registerCallback(lambda message: frames.append(message.header.frame_id))
    for frame in ("first", "second", "third"):
        world.source.signalMessage(at(101, frame))
    world.until(103)
    assert frames == ["first", "second", "third"]


@pytest.mark.parametrize(("size", "kept"), [(2, [103, 104]), (4, [101, 102, 103, 104]), (0, None)])
def test_a_full_queue_drops_the_oldest_stamp(world, size, kept):
    world.sequencer(queue_size=size)
    world.send(103, 101, 104, 102)
    assert world.until(110) == (kept or [101, 102, 103, 104])


def test_after_the_clock_has_jumped_back_older_stamps_pass(world):
    world.sequencer(queue_size=2)
    world.send(101, 109)
    assert world.until(103) == [101]
    world.set_clock(1)
    world.send(2, 3)
    assert world.until(5) == [101, 2, 3]


def test_shutdown_ends_it_for_good(world):
    sequencer = world.sequencer()
    world.send(101)
    sequencer.shutdown()
    world.send(102)
    assert world.until(110) == []
    assert world.source.callbacks == {}
    assert sequencer._timer not in list(world.node.timers)
    sequencer.shutdown()


def test_nothing_holds_it_after_shutdown(world):
    sequencer = world.sequencer()
    sequencer.shutdown()
    world.until(110)
    held = weakref.ref(sequencer)
    del sequencer
    gc.collect()
    assert held() is None


def test_another_input_replaces_the_one_before(world):
    other = SimpleFilter()
    world.sequencer().connectInput(other)
    world.send(101)
    other.signalMessage(at(102))
    assert world.until(104) == [102]


def test_the_stamp_may_be_elsewhere(world):
    heard = []
    stamps = TimeSequencer(None, 1, 0.5, 5, world.node, msg_stamp_attr="stamp")
    stamps.registerCallback(heard.append)
    world.sequencer()
    headers = [Header(stamp=Time(seconds=second).to_msg()) for second in (102, 101)]
    for header in headers:
        stamps.add(header)
    world.until(104)
    assert heard == headers[::-1]


def test_wrong_words(world):
    sequencer = world.sequencer()
    with pytest.raises(AttributeError, match=r"String has no header\.stamp: name the attribute"):
        sequencer.add(String())
    for rate in (0, -1.0, Duration()):
        with pytest.raises(ValueError, match="must be above 0, not"):
            world.sequencer(update_rate=rate)
