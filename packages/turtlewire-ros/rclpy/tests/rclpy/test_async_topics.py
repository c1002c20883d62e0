"""Topics of asynchronous nodes. The outcomes are those of ROS 2 Lyrical."""

import asyncio

import pytest
from tests.needs import needs_cyclone_dds

from rclpy.experimental import AsyncNode
from rclpy.serialization import serialize_message
from std_msgs.msg import String

from .asyncio_nodes import failure, failure_of, turns, until


@pytest.mark.parametrize("concurrent", [False, True])
async def test_the_order_of_callbacks_that_wait(context, concurrent):
    log = []
    may_end = asyncio.Event()
    ended = asyncio.Semaphore(0)

    async def on_message(message):
        log.append(f"begin {message.data}")
        await may_end.wait()
        log.append(f"end {message.data}")
        ended.release()

    async with AsyncNode("tested", context=context) as node:
        publisher = node.create_publisher(String, "chatter", 10)
        node.create_subscription(String, "chatter", on_message, 10, concurrent=concurrent)
        for text in "123":
            publisher.publish(String(data=text))
        await turns()
        may_end.set()
        for _ in "123":
            await ended.acquire()
    if concurrent:
        assert log == ["begin 1", "begin 2", "begin 3", "end 1", "end 2", "end 3"]
    else:
        assert log == ["begin 1", "end 1", "begin 2", "end 2", "begin 3", "end 3"]


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
async def test_the_middleware_drops_what_a_slow_callback_leaves(context):
    heard = []

    may_end, last = asyncio.Event(), asyncio.Event()

    async def on_message(message):
        heard.append(message.data)
        if message.data == "6":
            last.set()
        await may_end.wait()

    async with AsyncNode("tested", context=context) as node:
        publisher = node.create_publisher(String, "chatter", 10)
        node.create_subscription(String, "chatter", on_message, 2)
        publisher.publish(String(data="1"))
        await until(lambda: heard)
        for text in "23456":
            publisher.publish(String(data=text))
        may_end.set()
        await last.wait()
    assert heard == ["1", "5", "6"]


async def test_endpoints_that_are_made_before_the_node_runs(context):
    heard = asyncio.Event()
    node = AsyncNode("tested", context=context)
    publisher = node.create_publisher(String, "chatter", 10)
    node.create_subscription(String, "chatter", lambda _message: heard.set(), 10)
    publisher.publish(String())
    await turns()
    assert not heard.is_set()
    async with node:
        await heard.wait()


async def test_a_subscription_that_is_destroyed_cancels_its_callback(context):
    log = []
    inside = asyncio.Event()

    async def on_message(_message):
        inside.set()
        try:
            await asyncio.Event().wait()
        except asyncio.CancelledError:
            log.append("cancelled")
            raise

    async with AsyncNode("tested", context=context) as node:
        publisher = node.create_publisher(String, "chatter", 10)
        with node.create_subscription(String, "chatter", on_message, 10) as subscription:
            publisher.publish(String())
            await inside.wait()
        subscription.destroy()
        await turns()
        log.append("the node runs")
        assert node.count_subscribers("chatter") == 0
    assert log == ["cancelled", "the node runs"]


@pytest.mark.parametrize(
    ("middleware", "counted"),
    [
        ("local", int),
        ("rmw_zenoh_cpp", int),
        pytest.param("rmw_cyclonedds_cpp", type(None), marks=needs_cyclone_dds),
    ],
)
async def test_a_callback_gets_the_message_info(context, middleware, counted):
    """Cyclone DDS does not report the publisher's count of a message; ROS 2 says None then."""

    heard = asyncio.Queue()
    async with AsyncNode("tested", context=context) as node:
        node.create_subscription(String, "t", lambda _, info: heard.put_nowait(info), 10)
        publisher = node.create_publisher(String, "t", 10)
        publisher.publish(String())
        publisher.publish(String())
        infos = [await heard.get(), await heard.get()]
    assert {key: type(value) for key, value in infos[0].items()} == {
        "source_timestamp": int,
        "received_timestamp": int,
        "publication_sequence_number": counted,
        "reception_sequence_number": type(None),
        "publisher_gid": dict,
    }
    if counted is int:
        assert [info["publication_sequence_number"] for info in infos] == [1, 2]
    gid = infos[0]["publisher_gid"]
    assert (gid["implementation_identifier"], len(gid["data"])) == (middleware, 16)


def test_a_callback_of_a_wrong_shape(context):
    node = AsyncNode("tested", context=context)
    name, text = failure_of(node.create_subscription, String, "x", lambda: None, 1)
    assert name == "RuntimeError"
    assert text == (
        "Subscription callback should be either be callable with one argument(to get only the "
        "message) or two (to get message and message info)"
    )
    assert node.count_subscribers("x") == 0


async def test_raw_messages(context):
    heard = asyncio.Queue()
    async with AsyncNode("tested", context=context) as node:
        node.create_subscription(String, "chatter", heard.put, 10, raw=True)
        node.create_publisher(String, "chatter", 10).publish(String(data="x"))
        assert await heard.get() == serialize_message(String(data="x"))


async def test_callbacks_without_await_leave_the_loop_to_others(context):
    node = AsyncNode("tested", context=context)
    publisher = node.create_publisher(String, "chatter", 10)
    heard = []

    def again(message):
        heard.append(message)
        publisher.publish(message)

    async with node:
        node.create_subscription(String, "chatter", again, 10)
        publisher.publish(String())
        await asyncio.sleep(0.01)
    assert heard


async def test_a_malformed_message_is_skipped(context, capfd):
    heard = asyncio.Queue()
    async with AsyncNode("tested", context=context) as node:
        node.create_subscription(String, "chatter", heard.put, 10)
        publisher = node.create_publisher(String, "chatter", 10)
        publisher.publish(b"\x00\x01\x00\x00\xff\xff\xff\xff")
        publisher.publish(String(data="good"))
        assert (await heard.get()).data == "good"
    assert "Ignoring a malformed message on topic '/chatter'" in capfd.readouterr().err


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
async def test_iterating_over_messages(context):
    heard = []
    async with AsyncNode("tested", context=context) as node:
        publisher = node.create_publisher(String, "chatter", 10)
        subscription = node.create_subscription(String, "chatter", None, 10)
        loop = asyncio.get_running_loop()
        for delay, text in enumerate("123"):
            loop.call_later(delay / 100, publisher.publish, String(data=text))
        async for message in subscription:
            heard.append(message.data)
            if message.data == "3":
                break
        ending = asyncio.ensure_future(subscription.__anext__())
        await turns()
        loop.call_soon(subscription.destroy)
        heard += [message async for message in subscription]
        assert (await failure(ending))[0] == "StopAsyncIteration"
    assert heard == ["1", "2", "3"]


async def test_an_iteration_that_is_cancelled_loses_nothing(context):
    async with AsyncNode("tested", context=context) as node:
        publisher = node.create_publisher(String, "chatter", 10)
        subscription = node.create_subscription(String, "chatter", None, 10)
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(subscription.__anext__(), 0.01)
        publisher.publish(String(data="kept"))
        assert (await subscription.__anext__()).data == "kept"


async def test_the_end_of_the_node_ends_an_iteration(context):
    async with AsyncNode("tested", context=context) as node:
        subscription = node.create_subscription(String, "chatter", None, 10)
        asyncio.get_running_loop().call_later(0.01, node.destroy_node)
        assert [message async for message in subscription] == []


def test_a_subscription_with_a_callback_is_not_iterated(context):
    node = AsyncNode("tested", context=context)
    subscription = node.create_subscription(String, "chatter", print, 10)
    name, text = failure_of(subscription.__aiter__)
    assert (name, "create it with None as the callback" in text) == ("RuntimeError", True)
