"""The filters by themselves, and on topics."""

import random
from types import SimpleNamespace

import pytest

from geometry_msgs.msg import PointStamped
from message_filters import (
    ApproximateTimeSynchronizer,
    Cache,
    Chain,
    SimpleFilter,
    Subscriber,
    TimeSynchronizer,
)
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import ClockType, ROSClock
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from rclpy.time import Time
from std_msgs.msg import String


def ros_time(nanoseconds):
    return Time(nanoseconds=nanoseconds, clock_type=ClockType.ROS_TIME)


def at(nanoseconds, x=0.0):
    message = PointStamped()
    message.header.stamp = Time(nanoseconds=nanoseconds).to_msg()
    message.point.x = x
    return message


@pytest.fixture
def collected():
    class Collected(list):
        def __call__(self, *messages):
            self.append(messages)

        def stamps(self):
            return [
                tuple(Time.from_msg(message.header.stamp).nanoseconds for message in messages)
                for messages in self
            ]

    return Collected()


def test_callbacks_get_what_passes_and_their_own_arguments(collected):
    first = SimpleFilter()
    number = first.registerCallback(collected)
    first.registerCallback(collected, "extra", 2)
    first.signalMessage("message")
    assert collected == [("message",), ("message", "extra", 2)]
    first.unregisterCallback(number)
    first.signalMessage("a", "b")
    assert collected[2:] == [("a", "b", "extra", 2)]


def test_the_number_of_a_removed_callback_is_not_used_again(collected):
    source = SimpleFilter()
    removed = source.registerCallback(collected, "removed")
    source.registerCallback(collected, "stays")
    source.unregisterCallback(removed)
    added = source.registerCallback(callback=collected)
    source.unregisterCallback(removed)
    source.signalMessage("message")
    assert collected == [("message", "stays"), ("message",)]
    source.unregisterCallback(added)
    source.signalMessage("next")
    assert collected[2:] == [("next", "stays")]


def test_a_callback_that_removes_itself_hears_one_message(collected):
    source = SimpleFilter()

    def once(message):
        source.unregisterCallback(number)
        collected(message)

    number = source.registerCallback(once)
    source.registerCallback(collected)
    source.signalMessage("first")
    source.signalMessage("second")
    assert collected == [("first",), ("first",), ("second",)]


def test_exact_sets_pass_in_the_order_of_time(collected):
    filters = [SimpleFilter() for _ in range(3)]
    synchronizer = TimeSynchronizer(filters, 10)
    synchronizer.registerCallback(collected)
    arrivals = [(index, stamp) for index in range(3) for stamp in range(1, 6)]
    random.Random(3).shuffle(arrivals)
    for index, stamp in arrivals:
        filters[index].signalMessage(at(stamp, x=float(index)))
    assert sorted(collected.stamps()) == [(stamp,) * 3 for stamp in range(1, 6)]
    assert all(
        [message.point.x for message in messages] == [0.0, 1.0, 2.0] for messages in collected
    )
    assert synchronizer.queues == [{}, {}, {}]


def test_a_synchronizer_leaves_its_former_filters(collected):
    first, second, third = filters = [SimpleFilter() for _ in range(3)]
    synchronizer = TimeSynchronizer([first, second], 2)
    synchronizer.registerCallback(collected)
    first.signalMessage(at(1))
    synchronizer.connectInput([second, third])
    assert [len(each.callbacks) for each in filters] == [0, 1, 1]
    for each in filters[::-1]:
        each.signalMessage(at(1))
    assert collected.stamps() == [(1, 1)]


def test_exact_means_exact_and_the_queue_has_an_end(collected):
    left, right = SimpleFilter(), SimpleFilter()
    synchronizer = TimeSynchronizer([left, right], 2)
    synchronizer.registerCallback(collected)
    for stamp in (1, 2, 3):
        left.signalMessage(at(stamp))
    right.signalMessage(at(1))
    assert collected == []
    right.signalMessage(at(3))
    right.signalMessage(at(4))
    assert collected.stamps() == [(3, 3)]


def test_a_stamp_that_comes_again_has_waited_least(collected):
    left, right = SimpleFilter(), SimpleFilter()
    TimeSynchronizer([left, right], 2).registerCallback(collected)
    for stamp, x in ((1, 0.0), (2, 0.0), (1, 7.0), (3, 0.0)):
        left.signalMessage(at(stamp, x=x))
    for stamp in (1, 2, 3):
        right.signalMessage(at(stamp))
    assert collected.stamps() == [(1, 1), (3, 3)]
    assert collected[0][0].point.x == 7.0


def test_a_callback_may_feed_the_synchronizer_again(collected):
    left, right = SimpleFilter(), SimpleFilter()
    synchronizer = TimeSynchronizer([left, right], 5)
    synchronizer.registerCallback(collected)
    synchronizer.registerCallback(lambda *_: left.signalMessage(at(99)))
    left.signalMessage(at(1))
    right.signalMessage(at(1))
    assert collected.stamps() == [(1, 1)]
    assert list(synchronizer.queues[0]) == [99]


def test_near_sets_pass_once_and_the_closest_partner_is_taken(collected):
    left, right = SimpleFilter(), SimpleFilter()
    synchronizer = ApproximateTimeSynchronizer([left, right], 10, 1e-7)
    synchronizer.registerCallback(collected)
    for stamp in (1000, 1060, 1500):
        left.signalMessage(at(stamp))
    right.signalMessage(at(1050))
    assert collected.stamps() == [(1060, 1050)]
    right.signalMessage(at(1399))
    assert len(collected) == 1
    right.signalMessage(at(1401))
    assert collected.stamps()[1:] == [(1500, 1401)]
    right.signalMessage(at(1100))
    assert len(collected) == 2, "exactly the slop is too far"


def test_near_sets_of_three_are_near_altogether(collected):
    filters = [SimpleFilter() for _ in range(3)]
    ApproximateTimeSynchronizer(filters, 10, 1e-8).registerCallback(collected)
    filters[0].signalMessage(at(100))
    filters[1].signalMessage(at(109))
    filters[2].signalMessage(at(91))
    assert collected == [], "each is near the first, but the others are 18 ns apart"
    filters[2].signalMessage(at(104))
    assert collected.stamps() == [(100, 109, 104)]


def test_random_traffic_gives_each_message_to_one_set_within_the_slop(collected):
    chance = random.Random(7)
    filters = [SimpleFilter() for _ in range(3)]
    ApproximateTimeSynchronizer(filters, 20, 3e-8).registerCallback(collected)
    arrivals = [
        (index, 100 * number + chance.randrange(-10, 11))
        for number in range(1, 200)
        for index in range(3)
    ]
    for index, stamp in arrivals:
        filters[index].signalMessage(at(stamp))
    sets = collected.stamps()
    assert len(sets) == 199
    assert all(max(stamps) - min(stamps) < 30 for stamps in sets)
    for index in range(3):
        assert len({stamps[index] for stamps in sets}) == 199


def test_offsets_are_subtracted_from_the_stamps(collected):
    filters = [SimpleFilter() for _ in range(3)]
    synchronizer = ApproximateTimeSynchronizer(filters, 10, 1e-8, queue_offset=[0, 500, -200])
    synchronizer.registerCallback(collected)
    for index, stamp in ((0, 1000), (1, 1000), (2, 1000), (1, 1509)):
        filters[index].signalMessage(at(stamp))
    assert collected == [], "without the offsets, the first three would be a set"
    filters[2].signalMessage(at(801))
    assert collected.stamps() == [(1000, 1509, 801)]
    assert [list(queue) for queue in synchronizer.queues] == [[], [500], [1200]]


def test_a_stamp_smaller_than_its_offset(collected):
    left, right = SimpleFilter(), SimpleFilter()
    synchronizer = ApproximateTimeSynchronizer([left, right], 10, 1e-8, queue_offset=[100, 0])
    synchronizer.registerCallback(collected)
    left.signalMessage(at(1))
    right.signalMessage(at(1))
    left.signalMessage(at(105))
    assert collected.stamps() == [(105, 1)]
    assert list(synchronizer.queues[0]) == [-99]
    synchronizer.add(at(50), synchronizer.queues[0])
    assert list(synchronizer.queues[0]) == [-99, 50], "without its index, no offset is subtracted"


@pytest.mark.parametrize("none", [False, None])
def test_no_offsets(none):
    both = [SimpleFilter(), SimpleFilter()]
    assert ApproximateTimeSynchronizer(both, 5, 0.1, queue_offset=none).queue_offset == [0, 0]


@pytest.mark.parametrize("offsets", [[], [0], [0, 1, 2]])
def test_more_or_fewer_offsets_than_filters(offsets):
    source = SimpleFilter()
    with pytest.raises(ValueError, match=f"has {len(offsets)} offsets for 2 filters"):
        ApproximateTimeSynchronizer([source, source], 5, 0.1, queue_offset=offsets)
    assert source.callbacks == {}, "nothing is connected"


def test_sets_by_the_time_of_arrival(collected):
    left, right = SimpleFilter(), SimpleFilter()
    synchronizer = ApproximateTimeSynchronizer(
        [left, right], 5, 600.0, queue_offset=[0, 10**9], sync_arrival_time=True
    )
    synchronizer.registerCallback(collected)
    before = ROSClock().now().nanoseconds
    right.signalMessage(at(5))
    (arrived,) = synchronizer.queues[1]
    assert before <= arrived + 10**9 <= ROSClock().now().nanoseconds
    left.signalMessage(at(10**18))
    right.signalMessage(String(data="has no stamp"))
    left.signalMessage(at(6))
    assert [(a.header.stamp.sec, getattr(b, "data", "")) for a, b in collected] == [
        (10**9, ""),
        (0, "has no stamp"),
    ]


@pytest.mark.parametrize(
    "make", [lambda fs: TimeSynchronizer(fs, 5), lambda fs: ApproximateTimeSynchronizer(fs, 5, 0.1)]
)
def test_messages_without_a_stamp_are_refused(make, collected, capfd, monkeypatch):
    left = SimpleFilter()
    make([left]).registerCallback(collected)
    # Another test may have warned already, and the warning comes at most every five seconds.
    monkeypatch.setattr("message_filters.time_synchronizer._LOGGER", get_logger("tested"))
    for _ in range(3):
        left.signalMessage(String(data="no header"))
    assert collected == []
    assert capfd.readouterr().err.count("can not use message filters") == 1


def test_messages_without_a_stamp_can_be_allowed(collected):
    left, right = SimpleFilter(), SimpleFilter()
    ApproximateTimeSynchronizer([left, right], 5, 10.0, allow_headerless=True).registerCallback(
        collected
    )
    left.signalMessage(String(data="left"))
    right.signalMessage(String(data="right"))
    assert [[message.data for message in messages] for messages in collected] == [["left", "right"]]


def test_the_cache_answers_by_time(collected):
    source = SimpleFilter()
    cache = Cache(source, cache_size=4)
    cache.registerCallback(collected)
    assert cache.getLast() is cache.getLatestTime() is cache.getOldestTime() is None
    assert cache.getElemAfterTime(ros_time(0)) is cache.getElemBeforeTime(ros_time(0)) is None
    for stamp in (10, 30, 40, 20, 50):
        source.signalMessage(at(stamp, x=float(stamp)))
    assert [time.nanoseconds for time in cache.cache_times] == [20, 30, 40, 50]
    assert [message.point.x for message in cache.getInterval(ros_time(30), ros_time(40))] == [
        30.0,
        40.0,
    ]
    assert cache.getElemAfterTime(ros_time(30)).point.x == 30.0
    assert cache.getElemAfterTime(ros_time(31)).point.x == 40.0
    assert cache.getElemAfterTime(ros_time(51)) is None
    assert cache.getElemBeforeTime(ros_time(30)).point.x == 30.0
    assert cache.getElemBeforeTime(ros_time(29)).point.x == 20.0
    assert cache.getElemBeforeTime(ros_time(19)) is None
    assert (cache.getOldestTime().nanoseconds, cache.getLatestTime().nanoseconds) == (20, 50)
    assert cache.getLast().point.x == 50.0
    assert len(collected) == 5


@pytest.mark.parametrize(
    "kind",
    [TimeSynchronizer, lambda filters, size: ApproximateTimeSynchronizer(filters, size, slop=0.5)],
)
def test_after_the_time_has_jumped_back_sets_pass_again(kind, collected):
    left, right = SimpleFilter(), SimpleFilter()
    kind([left, right], 3).registerCallback(collected)
    for second in (100, 101, 102, 103):
        left.signalMessage(at(second * 10**9))
    for second in (1, 2, 3):
        left.signalMessage(at(second * 10**9))
        right.signalMessage(at(second * 10**9))
    assert collected.stamps() == [(second * 10**9,) * 2 for second in (1, 2, 3)]


def test_the_cache_after_the_time_has_jumped_back():
    cache = Cache(cache_size=3)
    for stamp in (100, 101, 102, 1, 2, 3, 4):
        cache.add(at(stamp))
    assert [time.nanoseconds for time in cache.cache_times] == [2, 3, 4]


def test_of_equal_stamps_the_cache_forgets_what_came_first():
    cache = Cache(cache_size=3)
    for stamp, x in ((7, 0.0), (7, 1.0), (5, 2.0), (7, 3.0)):
        cache.add(at(stamp, x))
    assert [message.point.x for message in cache.cache_msgs] == [2.0, 1.0, 3.0]
    cache.add(at(7, 4.0))
    assert [message.point.x for message in cache.cache_msgs] == [2.0, 3.0, 4.0]
    cache.add(at(6, 5.0))
    assert [message.point.x for message in cache.cache_msgs] == [5.0, 3.0, 4.0]


def test_the_cache_and_messages_without_a_stamp(capfd, monkeypatch):
    monkeypatch.setattr("message_filters.cache._LOGGER", get_logger("tested_cache"))
    cache = Cache()
    for _ in range(3):
        cache.add(String())
    assert cache.getLast() is None
    assert capfd.readouterr().err.count("can not use message filters") == 1
    allowing = Cache(allow_headerless=True)
    allowing.add(SimpleNamespace(header=SimpleNamespace(stamp=ros_time(5))))
    assert allowing.getLatestTime() == ros_time(5)
    allowing.add(String(data="now"))
    assert [message.data for message in allowing.cache_msgs] == ["now"], "one by default"


def test_subscribers_on_topics(monkeypatch, collected):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    context = Context()
    context.init(args=[])
    node = Node("filters", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    left, right = (
        Subscriber(node, PointStamped, "left"),
        Subscriber(node, PointStamped, "right", qos_profile=QoSProfile(depth=3)),
    )
    third = Subscriber(node, PointStamped, "third", 7)
    assert (left.getTopic(), left.topic_name, right.qos_profile.depth, third.qos_profile.depth) == (
        "left",
        "/left",
        3,
        7,
    )
    with pytest.raises(AttributeError):
        _ = left.nothing
    with pytest.raises(TypeError, match=r"Subscriber.__init__\(\) got .* 'dept'"):
        Subscriber(node, PointStamped, "fourth", dept=7)
    assert node.count_subscribers("fourth") == 0
    group = ReentrantCallbackGroup()
    raw = Subscriber(node, PointStamped, "left", callback_group=group, raw=True)
    assert raw.callback_group is group
    serialized = []
    raw.registerCallback(serialized.append)
    TimeSynchronizer([left, right], 5).registerCallback(collected)
    for topic in ("left", "right"):
        node.create_publisher(PointStamped, topic, 1).publish(at(5))
    while not (collected and serialized):
        executor.spin_once(timeout_sec=60)
    assert collected.stamps() == [(5, 5)]
    assert serialized == [serialize_message(at(5))]
    raw.unsubscribe()
    left.unsubscribe()
    assert node.count_subscribers("left") == 0
    node.destroy_node()
    context.try_shutdown()


# Sequences of filters.


class Adder(SimpleFilter):
    """Adds a number to each message."""

    def __init__(self, number):
        super().__init__()
        self.number = number

    def connectInput(self, f):  # noqa: N802 -- ROS 2's name
        f.registerCallback(self.add)

    def add(self, message):
        self.signalMessage(message + self.number)


def test_messages_go_through_all_filters_and_leave_the_last_once():
    source, heard = SimpleFilter(), []
    chain = Chain(source)
    chain.registerCallback(heard.append)
    source.signalMessage("lost, because the chain has no filter yet")
    filters = [Adder("a"), Adder("b"), Adder("c")]
    for length, each in enumerate(filters, start=1):
        assert chain.addFilter(each) == length - 1
        source.signalMessage(">")
        assert heard == [">a", ">ab", ">abc"][:length]
    chain.add("<")
    assert heard[3:] == ["<abc"]
    assert [chain.getFilter(index) for index in range(-1, 4)] == [None, *filters, None]


def test_another_input_replaces_the_one_before():
    first, second, heard = SimpleFilter(), SimpleFilter(), []
    chain = Chain(first)
    chain.addFilter(Adder("!"))
    chain.registerCallback(heard.append)
    chain.connectInput(second)
    first.signalMessage("first")
    second.signalMessage("second")
    assert heard == ["second!"]


def test_a_chain_that_begins_with_a_subscriber(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    context, heard = Context(), []
    context.init(args=[])
    node = Node("chained", context=context)
    points, cache = Subscriber(node, PointStamped, "points"), Cache(cache_size=5)
    chain = Chain()
    chain.addFilter(points)
    chain.addFilter(cache)
    chain.registerCallback(heard.append)
    points.callback(message := PointStamped())
    assert heard == [message]
    assert cache.getLast() is message
    with pytest.raises(TypeError, match="Subscriber has no connectInput, so that it can only be"):
        chain.addFilter(Subscriber(node, PointStamped, "others"))
    points.callback(message)
    assert len(heard) == 2, "the chain is as it was"
    with pytest.raises(TypeError, match="a Subscriber, accepts no messages: use the chain"):
        chain.add(message)
    node.destroy_node()
    context.try_shutdown()
