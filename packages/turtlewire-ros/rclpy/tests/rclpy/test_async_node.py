"""Asynchronous nodes: start, failure and end. The outcomes are those of ROS 2 Lyrical."""

import asyncio
import gc
import threading

import pytest

from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import AsyncNode
from rclpy.node import BaseNode, Node
from std_msgs.msg import String
from std_srvs.srv import Empty, SetBool

from .asyncio_nodes import failure, failure_of, in_groups, run, tree, turns, until

DESTROYED = "cannot use Destroyable because destruction was requested"


async def test_run_ends_when_the_node_is_destroyed(context):
    node = AsyncNode("tested", context=context)
    asyncio.get_running_loop().call_soon(node.destroy_node)
    await node.run()
    node.destroy_node()


def test_an_exception_of_the_block_comes_in_a_group(context):
    node = AsyncNode("tested", context=context)

    async def main():
        async with node:
            raise RuntimeError("user error")

    assert run(failure(main())) == in_groups(1, "RuntimeError", "user error")
    for what, create in {
        "publisher": lambda: node.create_publisher(String, "t", 1),
        "subscription": lambda: node.create_subscription(String, "t", print, 1),
        "service": lambda: node.create_service(Empty, "s", print),
        "client": lambda: node.create_client(Empty, "s"),
        "timer": lambda: node.create_timer(1.0, print),
    }.items():
        assert failure_of(create) == ("RuntimeError", f"Cannot create {what} on a destroyed node")
    again = ("RuntimeError", "Node has been destroyed and cannot be reentered")
    assert run(failure(node.__aenter__())) == again
    assert run(failure(node.run())) == again


async def test_a_node_runs_once_at_a_time(context):
    async with AsyncNode("tested", context=context) as node:
        twice = ("RuntimeError", "Node is already running")
        assert await failure(node.__aenter__()) == twice
        assert await failure(node.run()) == twice


@pytest.mark.parametrize(
    ("is_async", "concurrent", "depth"), [(True, False, 1), (True, True, 2), (False, False, 1)]
)
def test_an_exception_of_a_subscription_callback_ends_the_node(
    context, is_async, concurrent, depth
):
    def fail(_message):
        raise ValueError("boom")

    async def fail_async(_message):
        raise ValueError("boom")

    log = []

    async def tick():
        log.append("tick")
        await until_cancelled("timer callback")

    async def until_cancelled(what):
        try:
            await asyncio.Event().wait()
        except asyncio.CancelledError:
            log.append(f"{what} cancelled")
            raise

    async def main(node, publisher):
        async with node:
            await until(lambda: log)
            publisher.publish(String(data="x"))
            await until_cancelled("block")

    node = AsyncNode("tested", context=context)
    publisher = node.create_publisher(String, "chatter", 10)
    callback = fail_async if is_async else fail
    node.create_subscription(String, "chatter", callback, 10, concurrent=concurrent)
    node.create_timer(0.0, tick)
    error = run(failure(main(node, publisher)))
    assert error == in_groups(depth, "ValueError", "boom")
    assert sorted(log) == ["block cancelled", "tick", "timer callback cancelled"]
    assert failure_of(publisher.publish, String()) == ("InvalidHandle", DESTROYED)


def test_an_exception_of_a_timer_callback_ends_the_node(context):
    def fail():
        raise KeyError("k")

    async def main():
        node = AsyncNode("tested", context=context)
        node.create_timer(0.0, fail)
        await node.run()

    assert run(failure(main())) == in_groups(1, "KeyError", "'k'")


@pytest.mark.parametrize(("concurrent", "depth"), [(False, 1), (True, 2)])
def test_an_exception_of_a_service_ends_its_node(context, concurrent, depth):
    async def answer(_request, _response):
        raise ValueError("service boom")

    async def main():
        server, asking = AsyncNode("server", context=context), AsyncNode("asking", context=context)
        server.create_service(SetBool, "switch", answer, concurrent=concurrent)
        async with server, asking:
            await asking.create_client(SetBool, "switch").call(SetBool.Request())

    assert run(failure(main())) == in_groups(depth, "ValueError", "service boom")


def test_a_service_that_returns_no_response_ends_its_node(context):
    async def main():
        async with AsyncNode("tested", context=context) as node:
            node.create_service(SetBool, "switch", lambda _request, _response: None)
            await node.create_client(SetBool, "switch").call(SetBool.Request())

    with pytest.raises(Exception, match="TaskGroup") as caught:
        run(main())
    assert tree(caught.value) == in_groups(1, "TypeError", "")
    assert "service '/switch' has to return" in caught.value.exceptions[0].hint


def test_an_exception_passes_several_nodes(context):
    async def main():
        one, two = AsyncNode("one", context=context), AsyncNode("two", context=context)
        async with one, two:
            raise RuntimeError("x")

    assert run(failure(main())) == in_groups(2, "RuntimeError", "x")


async def test_a_callback_that_destroys_its_node_is_cancelled_at_its_next_await(context):
    log = []

    node = AsyncNode("tested", context=context)

    async def on_message(_message):
        node.destroy_node()
        log.append("after destroy_node")
        try:
            await asyncio.sleep(0)
            log.append("after await")
        except asyncio.CancelledError:
            log.append("cancelled")
            raise

    publisher = node.create_publisher(String, "chatter", 10)
    node.create_subscription(String, "chatter", on_message, 10)
    publisher.publish(String())
    await node.run()
    assert log == ["after destroy_node", "cancelled"]


async def test_the_shutdown_of_the_context_ends_the_node_but_not_the_block(context):
    log = []
    node = AsyncNode("tested", context=context)
    started = asyncio.Event()

    async def tick():
        started.set()
        try:
            await asyncio.Event().wait()
        except asyncio.CancelledError:
            log.append("callback cancelled")
            raise

    node.create_timer(0.0, tick)
    async with node:
        await started.wait()
        context.shutdown()
        log.append("block goes on")
        await turns()
        log.append("block ends")
    assert log == ["block goes on", "callback cancelled", "block ends"]


@pytest.mark.parametrize("thread", ["loop's", "other"])
@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
async def test_run_ends_when_the_context_is_shut_down(context, thread):
    node = AsyncNode("tested", context=context)
    node.create_subscription(String, "chatter", print, 10)
    loop = asyncio.get_running_loop()
    if thread == "other":
        loop.call_soon(loop.run_in_executor, None, context.shutdown)
    else:
        loop.call_soon(context.shutdown)
    await node.run()
    assert not context.ok()


def test_a_node_that_does_not_run_ends_with_its_context(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with Context() as context:
        node = AsyncNode("tested", context=context)
    assert failure_of(node.create_timer, 1.0, print)[0] == "RuntimeError"


def test_a_node_without_a_reference_leaves_the_graph(context):
    node = Node("watching", context=context)
    AsyncNode("forgotten", context=context)
    gc.collect()
    assert context.wait_for_graph(lambda: node.get_node_names() == ["watching"], 60 * 10**9)


async def test_a_node_starts_no_thread(context):
    node = AsyncNode("tested", context=context)
    before = set(threading.enumerate())

    heard = asyncio.Event()
    async with node:
        node.create_subscription(String, "chatter", lambda _message: heard.set(), 10)
        node.create_publisher(String, "chatter", 10).publish(String())
        await heard.wait()
        assert set(threading.enumerate()) == before


async def test_nodes_in_a_browser_tab_need_no_thread(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    monkeypatch.setattr("turtlewire.wire.local.context.in_browser", lambda: True)

    def start(thread):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", start)
    with Context() as context:
        node, peer = AsyncNode("one", context=context), AsyncNode("two", context=context)
        peer.create_service(SetBool, "switch", lambda _request, response: response)
        async with node, peer:
            client = node.create_client(SetBool, "switch")
            await client.wait_for_service()
            assert await client.call(SetBool.Request()) == SetBool.Response()
            waiting = asyncio.ensure_future(node.wait_for_node("late"))
            await turns()
            async with AsyncNode("late", context=context):
                await waiting


async def test_waiting_for_a_node(context):
    async with AsyncNode("tested", context=context) as node:
        waiting = asyncio.ensure_future(node.wait_for_node("peer"))
        await turns()
        assert not waiting.done()
        peer = AsyncNode("peer", context=context)
        await waiting
        await node.wait_for_node("/peer", check_interval=1.0)
        missing = asyncio.wait_for(node.wait_for_node("/ns/peer"), 0.01)
        assert (await failure(missing))[0] == "TimeoutError"
        peer.destroy_node()
        forever = asyncio.ensure_future(node.wait_for_node("/nobody"))
        await turns()
        node.destroy_node()
        context.wake_waits()
        assert await failure(forever) == ("InvalidHandle", DESTROYED)


async def test_a_node_has_parameters_and_a_clock_but_no_executor(context):
    async with AsyncNode("tested", namespace="/ns", context=context) as node:
        assert isinstance(node, BaseNode)
        assert node.declare_parameter("speed", 1.5).value == 1.5
        assert node.get_fully_qualified_name() == "/ns/tested"
        services = node.get_service_names_and_types_by_node("tested", "/ns")
        assert sorted(name.rpartition("/")[2] for name, _ in services) == [
            "describe_parameters",
            "get_parameter_types",
            "get_parameters",
            "get_type_description",
            "list_parameters",
            "set_parameters",
            "set_parameters_atomically",
        ]
        assert repr(node.get_clock()) == "AsyncClock(clock_type=ROS_TIME)"
        for name in ("executor", "create_rate", "create_guard_condition", "subscriptions"):
            assert not hasattr(node, name)
        refused = failure_of(node.declare_parameter, "x")
        assert refused == failure_of(node.declare_parameters, "", [("x",)])
        assert refused[0] == "TypeError"
        assert refused[1] == (
            "when declaring parameter named 'x', declaring a parameter only providing its name "
            "is not allowed. You have to either:\n"
            '\t- Pass a name and a default value different to "PARAMETER NOT SET" (and '
            "optionally a descriptor).\n"
            "\t- Pass a name and a parameter type.\n"
            "\t- Pass a name and a descriptor with `dynamic_typing=True"
        )


def test_actions_and_executors_reject_an_asynchronous_node(context):
    node = AsyncNode("tested", context=context)
    with pytest.raises(AttributeError, match="'AsyncNode' object has no attribute") as caught:
        ActionClient(node, Fibonacci, "fibonacci")
    assert "has no executor and no callback groups, and so no actions" in caught.value.hint
    with pytest.raises(
        AttributeError, match=r"^'AsyncNode' object has no attribute 'wheels'$"
    ) as no:
        _ = node.wheels
    assert no.value.hint == ""
    with pytest.raises(TypeError, match="An executor serves nodes") as caught:
        SingleThreadedExecutor(context=context).add_node(node)
    assert caught.value.hint == "Serve it in asyncio: await node.run()"


def test_a_node_whose_constructor_forgets_its_base(context):
    class Forgetful(AsyncNode):
        def __init__(self):
            self.create_timer(1.0, print)

    with pytest.raises(AttributeError, match="no attribute"):
        Forgetful()


async def test_parameters_are_served(context):
    from rcl_interfaces.srv import GetParameters

    async with AsyncNode("tested", context=context) as node:
        node.declare_parameter("speed", 1.5)
        client = node.create_client(GetParameters, "tested/get_parameters")
        response = await client.call(GetParameters.Request(names=["speed"]))
        assert [value.double_value for value in response.values] == [1.5]
