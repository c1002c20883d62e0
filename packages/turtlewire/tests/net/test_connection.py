"""Topics and transforms of a network without ROS's names."""

import asyncio
import gc
import threading
import weakref

import numpy as np
import pytest

import turtlewire
from turtlewire import msg
from turtlewire.errors import InterfaceError, InvalidTransformError, WireError
from turtlewire.wire import report
from turtlewire.wire.qos import Durability, QoS, Reliability

LONG_NS = 60_000_000_000
SECOND = 1_000_000_000


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def pair(request):
    with (
        turtlewire.connect("talker", middleware=request.param) as talker,
        turtlewire.connect("listener", middleware=request.param) as listener,
    ):
        yield talker, listener


def test_messages_arrive_in_a_loop(pair):
    talker, listener = pair
    heard = listener.subscribe("/chatter", "std_msgs/msg/String", qos=QoS())
    talk = talker.publisher("/chatter", "std_msgs/msg/String")
    assert talk.wait_for_subscribers(timeout_ns=LONG_NS)
    talk.publish(data="one")
    talk.publish(msg.get_message("std_msgs/msg/String")(data="two"))
    assert [next(heard).data, next(heard).data] == ["one", "two"]
    assert heard.latest().data == "two"
    assert heard.dropped == 0
    assert "std_msgs/msg/String" in listener.topics()["/chatter"]


def test_type_and_qos_of_the_publisher(pair):
    talker, listener = pair
    heard = listener.subscribe("/map_name")  # before anybody publishes
    assert heard.latest() is None
    latched = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
    talker.publisher("/map_name", "std_msgs/msg/String", qos=latched).publish(data="hall")
    assert next(heard).data == "hall"
    again = listener.subscribe("/map_name")  # the publisher is known by now
    assert next(again).data == "hall"


def test_best_effort_publishers_are_matched(pair):
    talker, listener = pair
    heard = listener.subscribe("/fast", "std_msgs/msg/Int32")
    talk = talker.publisher(
        "/fast", "std_msgs/msg/Int32", qos=QoS(reliability=Reliability.BEST_EFFORT)
    )
    assert talk.wait_for_subscribers(timeout_ns=np.timedelta64(60, "s"))
    talk.publish(data=7)
    assert next(heard).data == 7


def test_async_iteration_and_its_end(pair):
    talker, listener = pair

    async def run():
        seen = []
        async with listener:
            heard = listener.subscribe("/chatter", "std_msgs/msg/Int32", qos=QoS(depth=100))
            talk = talker.publisher("/chatter", "std_msgs/msg/Int32", qos=QoS(depth=100))
            assert await asyncio.to_thread(talk.wait_for_subscribers, timeout_ns=LONG_NS)
            for number in range(50):
                talk.publish(data=number)
            async for message in heard:
                seen.append(message.data)
                if len(seen) == 50:
                    break
            waiting = asyncio.ensure_future(anext_of(heard))
            await asyncio.sleep(0)  # it waits for a message
            cancelled = asyncio.ensure_future(anext_of(heard))
            await asyncio.sleep(0)
            cancelled.cancel()
            talk.publish(data=50)
            assert (await waiting).data == 50
        assert [message async for message in heard] == []  # closed
        return seen

    assert asyncio.run(run()) == list(range(50))


@pytest.mark.parametrize("first", ["publisher", "subscription"])
def test_two_types_on_a_topic_are_a_warning(pair, first, monkeypatch):
    talker, listener = pair
    warned = threading.Event()
    texts = []
    monkeypatch.setattr(report, "warn", lambda text: (texts.append(text), warned.set()))
    monkeypatch.setattr(report, "_said", set())
    makers = [
        lambda: talker.publisher("/number", "std_msgs/msg/Int32"),
        lambda: listener.subscribe("/number", "std_msgs/msg/String"),
    ]
    for make in makers if first == "publisher" else reversed(makers):
        make()
    assert warned.wait(60)
    (text,) = texts
    assert text.startswith(
        "topic /number has the type std_msgs/msg/Int32, but this process subscribes to "
        "std_msgs/msg/String: no messages get through."
    )


def test_a_cancelled_wait_leaves_nothing_behind():
    with turtlewire.connect("one", middleware="local") as net:
        heard = net.subscribe("/silent", "std_msgs/msg/String", qos=QoS())

        async def give_up():
            with pytest.raises(asyncio.TimeoutError):
                await asyncio.wait_for(anext_of(heard), 0.01)

        asyncio.run(give_up())
        assert heard._waits == set()


async def anext_of(iterator):
    return await iterator.__anext__()


def test_closing_ends_a_blocked_loop(pair):
    _, listener = pair
    heard = listener.subscribe("/silent", "std_msgs/msg/String", qos=QoS())
    counts = []
    reader = threading.Thread(target=lambda: counts.append(len(list(heard))))
    reader.start()
    listener.close()
    reader.join(60)
    assert counts == [0]
    listener.close()
    for late in (
        lambda: listener.publisher("/chatter", "std_msgs/msg/String"),
        lambda: listener.subscribe("/chatter"),
        listener.transforms,
        lambda: listener.send_transform("a", "b", 1, (0, 0, 0)),
    ):
        with pytest.raises(WireError, match="is closed"):
            late()


def test_old_messages_are_dropped_and_counted(pair):
    talker, listener = pair
    heard = listener.subscribe("/chatter", "std_msgs/msg/Int32", qos=QoS(depth=3))
    talk = talker.publisher("/chatter", "std_msgs/msg/Int32", qos=QoS(depth=100))
    assert talk.wait_for_subscribers(timeout_ns=LONG_NS)
    last = listener.subscribe("/chatter", "std_msgs/msg/Int32", qos=QoS(depth=100))
    assert talk.wait_for_subscribers(2, timeout_ns=LONG_NS)
    for number in range(10):
        talk.publish(data=number)
    assert [next(last).data for _ in range(10)] == list(range(10))
    with heard:
        kept = [next(heard).data for _ in range(3)]
    assert kept == sorted(kept)
    assert kept[-1] - kept[0] == 2
    assert list(heard) == [] or heard.dropped < 7


def test_transforms(pair):
    talker, listener = pair
    talker.send_static_transform("base", "camera", (0, 0, 0.1))
    talker.send_static_transform("base", "lidar", (1, 0, 0))
    buffer = listener.transforms(cache_time_ns=None)
    camera_from_lidar = buffer.lookup_transform("camera", "lidar", timeout_ns=LONG_NS)
    assert camera_from_lidar.translation == pytest.approx((1, 0, -0.1))
    arrived = threading.Event()
    buffer.on_change(arrived.set)
    while not buffer.can_transform("map", "base", SECOND):
        talker.send_transform("map", "base", SECOND, (1, 2, 3), (0, 0, 1, 1))
        arrived.wait(0.05)
    found = buffer.lookup_transform("map", "base", SECOND)
    assert (found.translation, found.rotation[3]) == ((1.0, 2.0, 3.0), pytest.approx(0.5**0.5))


def test_wrong_arguments():
    with turtlewire.connect("one", middleware="local", namespace="/robot") as net:
        assert net.name == "/robot/one"
        assert net.publisher("odom", "nav_msgs/msg/Odometry").topic == "/robot/odom"
        with pytest.raises(ValueError, match="must not end with"):
            net.subscribe("/chatter/")
        with pytest.raises(InterfaceError):
            net.publisher("/chatter", "std_msgs/msg/Strin")
        with pytest.raises(TypeError, match="not int; static transforms take no stamp before it"):
            net.send_static_transform("a", "b", SECOND, (0, 0, 0))
        with pytest.raises(TypeError, match=r"not NoneType; .* call send_static_transform$"):
            net.send_transform("a", "b", None, (0, 0, 0))
        with pytest.raises(TypeError, match=r"not tuple; the translation comes after the stamp$"):
            net.send_transform("a", "b", (0, 0, 0), (0, 0, 0, 1))
        string = msg.get_message("std_msgs/msg/String")
        for method in ("publisher", "subscribe"):
            call = getattr(net, method)
            written = rf"are swapped: write {method}\('/chatter', 'std_msgs/msg/String'\)$"
            with pytest.raises(TypeError, match=written):
                call("std_msgs/msg/String", "/chatter")
            with pytest.raises(TypeError, match=r"swapped: write .*\('chatter', String\)$"):
                call(string, "chatter")
            with pytest.raises(TypeError, match=r"'std_msgs/msg/String', not the class str$"):
                call("/chatter", str)
            with pytest.raises(TypeError, match=r"'std_msgs/msg/String', not int$"):
                call("/chatter", 3)
            with pytest.raises(TypeError, match="topic must be str, not int"):
                call(3, "std_msgs/msg/String")
        with pytest.raises(TypeError, match="not NoneType"):
            net.publisher("/chatter", None)
        with pytest.raises(TypeError, match=r"topic must be str, not \w+$"):
            net.subscribe(string)
        assert net.publisher("a/msg/b", "std_msgs/msg/String").topic == "/robot/a/msg/b"
        talk = net.publisher("/chatter", "std_msgs/msg/String")
        with pytest.raises(
            TypeError, match=r"std_msgs/msg/String, but publish\(\) was called with Int32"
        ):
            talk.publish(msg.get_message("std_msgs/msg/Int32")())
        with pytest.raises(TypeError, match="not both"):
            talk.publish(talk.type(), data="x")
        with pytest.raises(InvalidTransformError):
            net.send_transform("a", "a", 0, (0, 0, 0))
        with pytest.raises(TypeError, match="nanoseconds"):
            net.send_transform("a", "b", 0.5, (0, 0, 0))
        assert not talk.wait_for_subscribers(timeout_ns=0)
    with pytest.raises(ValueError, match="node name"):
        turtlewire.connect("two words")


def test_a_connection_forgets_what_its_user_has_closed():
    with turtlewire.connect("busy", middleware="local") as net:
        closed = []
        for number in range(3):
            heard = net.subscribe(f"/topic{number}", "std_msgs/msg/String", qos=QoS())
            talk = net.publisher(f"/topic{number}", "std_msgs/msg/String")
            closed += [weakref.ref(heard), weakref.ref(talk)]
            heard.close()
            heard.close()
            talk.close()
        del heard, talk
        gc.collect()
        assert [each() for each in closed] == [None] * 6
        kept = net.subscribe("/kept", "std_msgs/msg/String", qos=QoS())
    with pytest.raises(StopIteration):
        next(kept)


@pytest.mark.parametrize("topic", ["/tf", "/robot1/tf_static"])
def test_topics_of_transforms_have_one_type(topic):
    """Nobody would receive other messages there."""
    reason = (
        f"{topic} carries tf2_msgs/msg/TFMessage, not geometry_msgs/msg/TransformStamped; put it "
        "into TFMessage(transforms=[...])"
    )
    with turtlewire.connect("talker", middleware="local") as net:
        for join in (net.publisher, net.subscribe):
            with pytest.raises(TypeError) as caught:
                join(topic, "geometry_msgs/msg/TransformStamped")
            assert str(caught.value) == reason
        net.publisher(topic, "tf2_msgs/msg/TFMessage").publish(transforms=[])
        net.subscribe(topic)


def test_fields_that_a_message_does_not_have():
    with turtlewire.connect("talker", middleware="local") as net:
        talk = net.publisher("/chatter", "std_msgs/msg/String")
        with pytest.raises(
            TypeError, match="std_msgs/msg/String has no field 'dta'; did you mean 'data'"
        ):
            talk.publish(dta="hello")
        with pytest.raises(
            TypeError, match="called with str; its fields can be given by name: data"
        ):
            talk.publish("hello")


def test_arguments_of_another_type():
    for arguments, text in (
        ({"name": 5}, "name must be str, not int"),
        ({"namespace": 5}, "namespace must be str, not int"),
        ({"domain_id": "1"}, "domain_id must be int, not str"),
    ):
        with pytest.raises(TypeError, match=text):
            turtlewire.connect(**arguments, middleware="local")
    with turtlewire.connect("talker", middleware="local") as net:
        for join in (net.publisher, net.subscribe):
            with pytest.raises(TypeError, match=r"qos must be turtlewire\.wire\.qos\.QoS, not str"):
                join("/chatter", "std_msgs/msg/String", qos="reliable")
