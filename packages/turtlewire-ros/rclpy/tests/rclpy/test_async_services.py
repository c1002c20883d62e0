"""Services and clients of asynchronous nodes. The outcomes are those of ROS 2 Lyrical."""

import asyncio

import pytest

from rclpy.experimental import AsyncNode
from std_srvs.srv import SetBool

from .asyncio_nodes import failure, turns


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
async def test_a_call(context):

    async def answer(request, response):
        await asyncio.sleep(0)
        response.success = request.data
        response.message = "m"
        return response

    server, asking = AsyncNode("server", context=context), AsyncNode("asking", context=context)
    async with server, asking:
        client = asking.create_client(SetBool, "switch")
        assert not client.service_is_ready()
        waiting = asyncio.ensure_future(client.wait_for_service(check_interval=1.0))
        await turns()
        assert not waiting.done()
        server.create_service(SetBool, "switch", answer)
        await waiting
        assert client.service_is_ready()
        response = await client.call(SetBool.Request(data=True))
        assert (response.success, response.message) == (True, "m")


@pytest.mark.parametrize("concurrent", [False, True])
async def test_several_calls_at_once(context, concurrent):
    running = most = 0
    all_asked = asyncio.Event()

    async def answer(_request, response):
        nonlocal running, most
        running += 1
        most = max(most, running)
        await all_asked.wait()
        await turns()
        running -= 1
        return response

    async with AsyncNode("tested", context=context) as node:
        node.create_service(SetBool, "switch", answer, concurrent=concurrent)
        client = node.create_client(SetBool, "switch")
        calls = asyncio.gather(*(client.call(SetBool.Request()) for _ in range(4)))
        await turns()
        all_asked.set()
        assert len(await calls) == 4
    assert most == (4 if concurrent else 1)


async def test_limits_of_time_and_the_end_of_a_client(context):
    async with AsyncNode("tested", context=context) as node:
        client = node.create_client(SetBool, "nobody")
        waiting = asyncio.wait_for(client.wait_for_service(), 0.01)
        assert (await failure(waiting))[0] == "TimeoutError"
        calling = asyncio.wait_for(client.call(SetBool.Request()), 0.01)
        assert (await failure(calling))[0] == "TimeoutError"
        call = asyncio.ensure_future(client.call(SetBool.Request()))
        wait = asyncio.ensure_future(client.wait_for_service())
        await turns()
        client.destroy()
        assert await failure(call) == ("CancelledError", "")
        assert (await failure(wait))[0] == "InvalidHandle"
        assert await failure(client.call(SetBool.Request())) == (
            "RuntimeError",
            "Calling a destroyed client is forbidden",
        )


async def test_a_cancelled_call_forgets_its_request(context):
    may_answer = asyncio.Event()

    async def answer(_request, response):
        await may_answer.wait()
        return response

    async with AsyncNode("tested", context=context) as node:
        node.create_service(SetBool, "switch", answer)
        client = node.create_client(SetBool, "switch")
        call = asyncio.ensure_future(client.call(SetBool.Request(data=False)))
        await turns()
        assert len(client._pending) == 1
        call.cancel()
        assert await failure(call) == ("CancelledError", "")
        assert not client._pending
        may_answer.set()  # the late response is ignored
        assert await client.call(SetBool.Request(data=True)) == SetBool.Response()


async def test_a_request_of_another_class(context):
    async with AsyncNode("tested", context=context) as node:
        client = node.create_client(SetBool, "switch")
        name, text = await failure(client.call(SetBool.Response()))
        assert (name, "SetBool.Request()" in text) == ("TypeError", True)


async def test_the_end_of_the_node_cancels_calls(context):
    node = AsyncNode("tested", context=context)
    async with node:
        call = asyncio.ensure_future(node.create_client(SetBool, "nobody").call(SetBool.Request()))
        await turns()
    assert await failure(call) == ("CancelledError", "")
