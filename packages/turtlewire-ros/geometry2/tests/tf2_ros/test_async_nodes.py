"""Transforms of asynchronous nodes."""

import asyncio

import pytest

from rclpy.duration import Duration
from rclpy.experimental import AsyncNode
from rclpy.time import Time
from tf2_msgs.srv import FrameGraph
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)


def run(coroutine):
    return asyncio.run(asyncio.wait_for(coroutine, 60))


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
def test_a_lookup_is_awaited(monkeypatch, stamped, middleware):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    from rclpy.context import Context

    async def main(context):
        async with AsyncNode("tested", context=context) as node:
            buffer = Buffer()
            TransformListener(buffer, node)
            lookup = asyncio.ensure_future(
                buffer.lookup_transform_async("world", "tool", Time(seconds=1))
            )
            await asyncio.sleep(0)
            TransformBroadcaster(node).sendTransform(stamped(x=2.0))
            StaticTransformBroadcaster(node).sendTransform(stamped("robot", "tool", x=0.5))
            return (await lookup).transform.translation.x

    with Context() as context:
        assert run(main(context)) == 2.5


async def test_a_lookup_is_cancelled(context):
    async with AsyncNode("tested", context=context) as node:
        buffer = Buffer()
        TransformListener(buffer, node)
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(buffer.lookup_transform_async("a", "b", Time()), 0.01)
        limit = Duration(nanoseconds=1)
        with pytest.raises(TransformException):
            await buffer.lookup_transform_async("a", "b", Time(), timeout=limit)


async def test_the_listener_ends_with_its_node(context, make_node):
    node = AsyncNode("tested", context=context)
    buffer = Buffer()
    async with node:
        TransformListener(buffer, node)
        assert node.count_subscribers("/tf") == 1
    other = make_node("other")
    assert other.count_subscribers("/tf") == 0


def test_the_buffer_of_a_node_answers(context, stamped):
    async def main():
        async with AsyncNode("tested", context=context) as node:
            buffer = Buffer(node=node)
            buffer.set_transform(stamped(), "test")
            client = node.create_client(FrameGraph, "tf2_frames")
            return (await client.call(FrameGraph.Request())).frame_yaml

    assert "robot" in run(main())


async def test_the_buffer_follows_simulated_time_of_the_node(context, stamped):
    async with AsyncNode("tested", context=context) as node:
        buffer = Buffer()
        TransformListener(buffer, node)
        buffer.set_transform(stamped(), "test")
        clock = node.get_clock()
        clock._set_ros_time_is_active(True)
        assert buffer.can_transform("world", "robot", Time()) == 0


def test_a_listener_does_not_spin_an_asynchronous_node(context):
    node = AsyncNode("tested", context=context)
    with pytest.raises(TypeError, match="An executor serves nodes") as caught:
        TransformListener(Buffer(), node, spin_thread=True)
    assert caught.value.hint == "Serve it in asyncio: await node.run()"
    node.destroy_node()
