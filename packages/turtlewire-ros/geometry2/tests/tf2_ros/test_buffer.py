"""tf2_ros.Buffer.

Answers, waiting in callbacks, futures, the frames service, jumps of the clock.
"""

import asyncio
import gc
import sys
import threading
import time
import weakref
from contextlib import suppress
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.programs import run_python

import tf2_ros
from geometry_msgs.msg import PointStamped, TransformStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import ClockType, ROSClock
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Header
from tf2_ros import Buffer, MessageFilter, TransformBroadcaster, TransformListener
from tf2_ros.transform_futures import Deadlines

LONG = Duration(seconds=60)


@pytest.fixture
def buffer():
    return Buffer()


def at(seconds):
    return Time(seconds=seconds)


def test_every_public_name_exists():
    assert all(hasattr(tf2_ros, name) for name in tf2_ros.__all__)
    assert issubclass(tf2_ros.LookupException, tf2_ros.TransformException)


def test_a_lookup_is_a_real_message(buffer, stamped):
    sent = stamped("world", "robot", x=2.0, stamp_s=3)
    assert buffer.set_transform(sent, "me") is None
    assert buffer.lookup_transform("world", "robot", at(3)) == sent
    assert type(buffer.lookup_transform("world", "robot", Time())) is TransformStamped
    assert buffer.lookup_transform("world", "robot", sent.header.stamp) == sent
    assert (
        buffer.lookup_transform(
            target_frame="world", source_frame="robot", time=Time(), timeout=Duration()
        )
        == sent
    )


def test_can_transform_is_a_number_or_a_tuple(buffer, stamped):
    buffer.set_transform_static(stamped("world", "wall"), "me")
    assert buffer.can_transform("world", "wall", Time()) == 1
    assert buffer.can_transform("world", "nothing", Time()) == 0
    assert buffer.can_transform("world", "wall", Time(), return_debug_tuple=True) == (1, "")
    known, reason = buffer.can_transform("world", "nothing", Time(), Duration(), True)
    assert (known, reason) == (
        0,
        (
            'Invalid frame ID "nothing" passed to canTransform argument source_frame - '
            "frame does not exist"
        ),
    )
    assert buffer.can_transform_full("world", at(1), "wall", at(2), "world") == 1
    assert (
        buffer.can_transform_full(
            "world", at(1), "nothing", at(2), "world", return_debug_tuple=True
        )[0]
        == 0
    )


def test_the_errors_have_tf2_s_texts(buffer, stamped):
    with pytest.raises(tf2_ros.LookupException) as unknown:
        buffer.lookup_transform("turtle2", "turtle1", Time())
    assert (
        str(unknown.value)
        == '"turtle2" passed to lookupTransform argument target_frame does not exist. '
    )
    buffer.set_transform(stamped("world", "robot", stamp_s=3), "me")
    buffer.set_transform(stamped("world", "robot", stamp_s=4), "me")
    with pytest.raises(tf2_ros.ExtrapolationException, match="into the future"):
        buffer.lookup_transform("world", "robot", at(5))
    with pytest.raises(tf2_ros.InvalidArgumentException):
        buffer.lookup_transform("", "robot", at(5))
    buffer.set_transform(stamped("map", "other", stamp_s=3), "me")
    with pytest.raises(tf2_ros.ConnectivityException):
        buffer.lookup_transform("map", "robot", Time())


@pytest.mark.parametrize("wrong", [3, 3.0, None, "now"])
def test_times_are_ros_times(buffer, wrong):
    with pytest.raises(TypeError, match=r"time must have sec and nanosec, or nanoseconds\."):
        buffer.lookup_transform("a", "b", wrong)
    with pytest.raises(TypeError, match=r"duration must have sec and nanosec, or nanoseconds\."):
        buffer.can_transform("a", "b", Time(), wrong)


@pytest.mark.skipif(sys.version_info < (3, 11), reason="Python 3.10 has no notes")
@pytest.mark.parametrize(
    ("call", "hint"),
    [
        (
            lambda buffer: buffer.lookup_transform("a", "b", 0),
            "It is of type int: write rclpy.time.Time() for the latest transform.",
        ),
        (
            lambda buffer: buffer.lookup_transform("a", "b", 1.5),
            (
                "It is of type float: write rclpy.time.Time() for the latest transform, or "
                "rclpy.time.Time(seconds=1.5)."
            ),
        ),
        (
            lambda buffer: buffer.lookup_transform("a", "b", 1_700_000_000_500_000_000),
            (
                "It is of type int: write rclpy.time.Time() for the latest transform, or "
                "rclpy.time.Time(nanoseconds=1700000000500000000)."
            ),
        ),
        (
            lambda buffer: buffer.lookup_transform("a", "b", Header()),
            "It is of type Header: pass its stamp.",
        ),
        (
            lambda buffer: buffer.lookup_transform("a", "b", PointStamped()),
            "It is of type PointStamped: pass its header.stamp.",
        ),
        (
            lambda buffer: buffer.lookup_transform("a", "b", Time(), timeout=1),
            "It is of type int: write rclpy.duration.Duration(seconds=1.0).",
        ),
        (
            lambda _: tf2_ros.Buffer("10"),
            "It is of type str: write rclpy.duration.Duration(seconds=…).",
        ),
    ],
)
def test_errors_of_times_say_what_to_write(buffer, call, hint):
    with pytest.raises(TypeError, match="nanosec") as caught:
        call(buffer)
    assert caught.value.__notes__ == [hint]


def test_full_lookups_travel_in_time(buffer, stamped):
    for second in (1, 2, 3):
        buffer.set_transform(stamped("world", "robot", x=float(second), stamp_s=second), "me")
    then = buffer.lookup_transform_full("robot", at(3), "robot", at(1), "world")
    assert then.transform.translation.x == -2.0
    assert (
        buffer.lookup_transform_full(
            target_frame="robot",
            target_time=at(3),
            source_frame="robot",
            source_time=at(1),
            fixed_frame="world",
            timeout=LONG,
        )
        == then
    )


def test_a_lookup_waits_for_data(buffer, stamped):
    feeder = threading.Timer(0.05, lambda: buffer.set_transform(stamped(x=4.0), "me"))
    feeder.start()
    assert buffer.lookup_transform("world", "robot", Time(), LONG).transform.translation.x == 4.0
    feeder.join()


def test_a_wait_ends_with_the_error_of_the_lookup(buffer):
    started = time.monotonic()
    with pytest.raises(tf2_ros.LookupException):
        buffer.lookup_transform("world", "robot", Time(), Duration(seconds=0.1))
    assert time.monotonic() - started >= 0.1
    assert buffer.can_transform("world", "robot", Time(), Duration(seconds=0.01)) == 0


def test_a_callback_of_a_single_threaded_executor_may_wait(spin_until, make_node, stamped):
    node, talker = make_node("waits"), make_node("talks")
    buffer, broadcaster = Buffer(node=node), TransformBroadcaster(talker)
    TransformListener(buffer, node)
    results = []

    def on_timer():
        threading.Timer(0.05, broadcaster.sendTransform, [stamped(x=1.0)]).start()
        results.append(buffer.lookup_transform("world", "robot", Time(), LONG))

    node.create_timer(0.001, on_timer)
    spin_until(node, lambda: results)
    assert results[0].transform.translation.x == 1.0


def test_futures_finish_when_the_data_comes(buffer, stamped):
    future = buffer.wait_for_transform_async("world", "robot", at(1))
    full = buffer.wait_for_transform_full_async("world", at(1), "robot", at(1), "world")
    buffer.set_transform(stamped(stamp_s=3), "me")
    assert not future.done()
    buffer.set_transform(stamped(x=5.0, stamp_s=1), "me")
    assert future.result().transform.translation.x == full.result().transform.translation.x == 5.0
    assert buffer.wait_for_transform_async("world", "robot", at(1)).result() == future.result()


def test_nothing_listens_when_no_future_waits(buffer, stamped):
    futures = buffer._futures
    waiting = [buffer.wait_for_transform_async("world", f"robot{i}", Time()) for i in range(3)]
    assert futures._stop_listening is not None
    waiting[0].cancel()
    buffer.set_transform(stamped(child="robot1"), "me")
    buffer.set_transform(stamped(child="robot2"), "me")
    assert [future.done() for future in waiting] == [True, True, True]
    assert futures._waiting == []
    assert futures._stop_listening is None


def test_a_request_that_cannot_be_answered_fails_at_once(buffer):
    with pytest.raises(tf2_ros.InvalidArgumentException):
        buffer.wait_for_transform_async("/world", "robot", Time()).result()


def test_a_wrong_argument_leaves_other_futures_alone(buffer, stamped):
    with pytest.raises(TypeError, match="target_frame must be str"):
        buffer.wait_for_transform_async(None, "robot", Time())
    future = buffer.wait_for_transform_async("world", "robot", Time())
    buffer.set_transform(stamped(), "me")
    assert future.done()
    assert buffer._futures._stop_listening is None


def test_awaiting_is_agnostic_of_loops(buffer, stamped):
    coroutine = buffer.lookup_transform_async("world", "robot", Time())
    coroutine.send(None)
    buffer.set_transform(stamped(x=6.0), "me")
    with pytest.raises(StopIteration) as end:
        coroutine.send(None)
    assert end.value.value.transform.translation.x == 6.0


def test_awaiting_in_asyncio(buffer, stamped):
    async def program():
        asyncio.get_running_loop().call_later(
            0.05, lambda: buffer.set_transform(stamped(x=7.0), "me")
        )
        first = await asyncio.wait_for(buffer.lookup_transform_async("world", "robot", Time()), 60)
        second = await buffer.lookup_transform_full_async("world", at(1), "robot", at(1), "world")
        return first, second

    first, second = asyncio.run(program())
    assert first == second
    assert first.transform.translation.x == 7.0


def test_awaiting_in_a_callback_leaves_the_executor_free(spin_until, make_node, stamped):
    node = make_node()
    buffer = Buffer()
    TransformListener(buffer, node)
    broadcaster = TransformBroadcaster(node)
    results, asked = [], []

    async def wait():
        if not asked:
            asked.append(True)
            results.append(await buffer.lookup_transform_async("world", "robot", Time()))

    node.create_timer(0.001, wait, callback_group=ReentrantCallbackGroup())
    node.create_timer(
        0.05, lambda: broadcaster.sendTransform(stamped(x=8.0))
    )  # only runs if the wait above does not block
    spin_until(node, lambda: results)
    assert results[0].transform.translation.x == 8.0


def test_a_node_offers_its_frames(spin_until, make_node, stamped):
    from tf2_msgs.srv import FrameGraph

    node = make_node()
    buffer = Buffer(node=node)
    buffer.set_transform_static(stamped("world", "wall"), "me")
    client = node.create_client(FrameGraph, "tf2_frames")
    future = client.call_async(FrameGraph.Request())
    spin_until(node, future.done)
    assert future.result().frame_yaml == buffer.all_frames_as_yaml()
    assert "wall:" in future.result().frame_yaml


def test_a_jump_back_clears_what_is_not_static(make_node, stamped, capfd):
    node = make_node()
    buffer = Buffer(node=node)
    clock = node.get_clock()
    assert isinstance(clock, ROSClock)
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(Time(seconds=100, clock_type=ClockType.ROS_TIME))
    buffer.set_transform(stamped(), "me")
    buffer.set_transform_static(stamped(child="wall"), "me")
    clock.set_ros_time_override(Time(seconds=99.5, clock_type=ClockType.ROS_TIME))
    assert buffer.can_transform("world", "robot", Time()) == 1
    clock.set_ros_time_override(Time(seconds=50, clock_type=ClockType.ROS_TIME))
    assert buffer.can_transform("world", "robot", Time()) == 0
    assert buffer.can_transform("world", "wall", Time()) == 1
    assert "Detected jump back in time. Clearing tf buffer." in capfd.readouterr().err


@pytest.mark.parametrize("with_node", [True, False])
def test_a_buffer_follows_the_clock_of_its_listener(with_node, make_node, stamped):
    node = make_node()
    buffer = Buffer(node=make_node("other") if with_node else None)
    listener = TransformListener(buffer, node)
    clock = node.get_clock()
    clock._set_ros_time_is_active(True)
    for seconds, known in ((100, True), (50, with_node)):
        clock.set_ros_time_override(Time(seconds=seconds, clock_type=ClockType.ROS_TIME))
        if seconds == 100:
            buffer.set_transform(stamped(), "me")
        assert buffer.can_transform("world", "robot", Time()) == known
    listener.unregister()
    buffer.set_transform(stamped(), "me")
    clock.set_ros_time_override(Time(seconds=1, clock_type=ClockType.ROS_TIME))
    assert buffer.can_transform("world", "robot", Time()) == 1


def test_a_buffer_in_a_cycle_is_collected(context):
    node = Node("node", context=context)

    def leave_a_cycle():
        buffer = Buffer()
        MessageFilter(None, buffer, "world", 10, node).registerCallback(lambda _message: buffer)
        return weakref.ref(buffer.engine)

    gone = leave_a_cycle()
    node.destroy_node()
    gc.collect()
    assert gone() is None


def test_a_program_that_destroys_nothing_ends_without_a_word():
    program = """
import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, MessageFilter, TransformListener
rclpy.init()
node, buffer = Node("node"), Buffer()
TransformListener(buffer, node)
MessageFilter(None, buffer, "world", 10, node).registerCallback(lambda message: buffer)
future = buffer.wait_for_transform_async("a", "b", rclpy.time.Time())
"""
    ended = run_python(program, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")


def test_cache_time():
    buffer = Buffer(cache_time=Duration(seconds=2))
    assert buffer.engine.cache_time_ns == 2_000_000_000
    assert Buffer(Duration(seconds=3)).engine.cache_time_ns == 3_000_000_000
    assert Buffer().engine.cache_time_ns == 10_000_000_000


def test_futures_may_have_a_timeout(buffer, stamped):
    late = buffer.wait_for_transform_async("world", "robot", Time(), timeout=Duration(seconds=0.05))
    in_time = buffer.wait_for_transform_async("world", "other", Time(), timeout=LONG)
    finished = threading.Event()
    late.add_done_callback(lambda _future: finished.set())
    assert finished.wait(60)
    with pytest.raises(tf2_ros.LookupException):
        late.result()
    buffer.set_transform(stamped(child="other"), "me")
    assert in_time.result().child_frame_id == "other"
    with pytest.raises(tf2_ros.LookupException):
        buffer.wait_for_transform_async("world", "robot", Time(), timeout=Duration()).result()


def test_an_awaited_lookup_may_have_a_timeout(buffer):
    with pytest.raises(tf2_ros.LookupException):
        asyncio.run(
            buffer.lookup_transform_async("world", "robot", Time(), timeout=Duration(seconds=0.05))
        )
    with pytest.raises(tf2_ros.LookupException):
        asyncio.run(
            buffer.lookup_transform_full_async(
                "world", at(1), "robot", at(1), "world", timeout=Duration(seconds=0.05)
            )
        )


def test_a_future_fails_when_its_time_has_fallen_out_of_the_cache(buffer, stamped):
    future = buffer.wait_for_transform_async("world", "robot", at(1))
    full = buffer.wait_for_transform_full_async("world", at(50), "robot", at(1), "world")
    buffer.set_transform(stamped(stamp_s=5), "me")
    assert not future.done()
    buffer.set_transform(stamped(stamp_s=50), "me")
    for each in (future, full, buffer.wait_for_transform_async("world", "robot", at(2))):
        with pytest.raises(tf2_ros.ExtrapolationException):
            each.result()


def test_future_fails_when_a_transform_dropped_its_time(buffer, stamped):
    future = buffer.wait_for_transform_async("world", "hand", at(40))
    latest = buffer.wait_for_transform_async("world", "hand", Time())
    buffer.set_transform(stamped(stamp_s=30), "me")
    for second in range(41, 61):
        buffer.set_transform(stamped("robot", "hand", stamp_s=second), "me")
        assert future.done() == (second > 50)
    with pytest.raises(tf2_ros.ExtrapolationException, match="into the past"):
        future.result()
    assert not latest.done()
    buffer.set_transform(stamped(stamp_s=60), "me")
    assert latest.result().header.stamp.sec == 60


def test_a_cancelled_future_is_forgotten(buffer):
    future = buffer.wait_for_transform_async("world", "robot", Time(), timeout=LONG)
    future.cancel()
    assert buffer._futures._waiting == []
    assert buffer._futures._stop_listening is None


def test_a_cancelled_task_waits_no_longer(buffer, stamped):
    async def give_up():
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(buffer.lookup_transform_async("world", "robot", Time()), 0.01)
        task = asyncio.create_task(
            buffer.lookup_transform_full_async("world", Time(), "robot", Time(), "world")
        )
        await asyncio.sleep(0)
        assert len(buffer._futures._waiting) == 1
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert buffer._futures._waiting == []

    asyncio.run(give_up())
    buffer.set_transform(stamped(), "me")


def test_deadlines_come_in_order_and_leave_no_thread():
    deadlines, calls, last = Deadlines(), [], threading.Event()
    deadlines.call_after(1.0, lambda: (calls.append("late"), last.set()))
    deadlines.call_after(0.05, lambda: calls.append("early"))
    cancel = deadlines.call_after(30.0, lambda: calls.append("cancelled"))
    cancel()
    cancel()
    assert last.wait(60)
    for thread in threading.enumerate():
        if thread.name == "tf2-deadlines":
            thread.join(60)
    assert calls == ["early", "late"]
    assert deadlines._due == []  # nor the cancelled one
    again = threading.Event()
    deadlines.call_after(0.0, again.set)
    assert again.wait(60)


def test_a_deadline_that_raises_is_reported_and_later_ones_come(monkeypatch):
    reported = []
    monkeypatch.setattr(threading, "excepthook", reported.append)
    deadlines, come = Deadlines(), threading.Event()

    def fail():
        raise LookupError("no such loop")

    deadlines.call_after(0.0, fail)
    deadlines.call_after(0.05, come.set)
    assert come.wait(60)
    assert [str(each.exc_value) for each in reported] == ["no such loop"]


@given(
    delays=st.lists(st.floats(0.0, 0.01), min_size=1, max_size=4),
    timeout=st.floats(0.0, 0.02),
    shut_down=st.booleans(),
)
@settings(max_examples=25)
def test_waiting_in_callbacks_always_ends(delays, timeout, shut_down):
    """Whatever comes before the timeout, after it or never, the callback returns and the executor
    goes on.
    """
    context = Context()
    context.init(args=[])
    node, buffer = Node("waits", context=context), Buffer()
    TransformListener(buffer, node)
    broadcaster, ended = TransformBroadcaster(node), []

    def wait(number):
        try:
            found = buffer.lookup_transform(
                "world", f"robot{number}", Time(), Duration(seconds=timeout)
            )
            ended.append(found.child_frame_id)
        except tf2_ros.TransformException as error:
            ended.append(type(error))

    def send(number):
        transform = TransformStamped(child_frame_id=f"robot{number}")
        transform.header.frame_id = "world"
        with suppress(Exception):  # the context may be shut down already
            broadcaster.sendTransform(transform)

    timers = [
        node.create_timer(0.001, partial(wait, number), callback_group=ReentrantCallbackGroup())
        for number in range(len(delays))
    ]
    feeders = [threading.Timer(delay, send, [number]) for number, delay in enumerate(delays)]
    for feeder in feeders:
        feeder.start()
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    while len(ended) < len(timers):
        executor.spin_once(timeout_sec=60)
    if shut_down:
        context.shutdown()
    for feeder in feeders:
        feeder.join()
    node.destroy_node()
    context.try_shutdown()
    assert all(
        outcome == tf2_ros.LookupException or str(outcome).startswith("robot") for outcome in ended
    )
