"""Entities that are destroyed or change their executor while one serves them: it keeps spinning."""

import asyncio
import contextlib
import threading

import pytest

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy._execution.blocking import SelfWaits
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

pytestmark = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])

LIMIT_S = 60
ROUNDS = 60


class Spinning:
    """An executor that spins in a thread, and what made it stop."""

    def __init__(self, executor, node):
        self.executor = executor
        self.failure = None
        executor.add_node(node)
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def _spin(self):
        try:
            self.executor.spin()
        except BaseException as failure:
            self.failure = failure

    def still_runs(self, node):
        done = threading.Event()
        guard = node.create_guard_condition(done.set)
        guard.trigger()
        ran = done.wait(LIMIT_S)
        return ran and self.failure is None

    def end(self):
        self.executor.shutdown()
        self._thread.join(LIMIT_S)
        assert not self._thread.is_alive()


@pytest.fixture(
    params=[SingleThreadedExecutor, lambda context: MultiThreadedExecutor(4, context=context)]
)
def spinning(request, context, node):
    spinning = Spinning(request.param(context=context), node)
    yield spinning
    spinning.end()


class InterruptedGroup(ReentrantCallbackGroup):
    """Is busy when it is asked first, and then something happens before the answer arrives."""

    def __init__(self, event):
        super().__init__()
        self.event = event

    def can_execute(self, _entity):
        event, self.event = self.event, None
        if event is not None:
            event()
        return event is None


@pytest.mark.parametrize("kind", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_the_executor_itself_is_shut_down(context, node, kind):
    executor, got = kind(context=context), []
    executor.add_node(node)
    group = InterruptedGroup(lambda: executor.shutdown(LIMIT_S))
    node.create_subscription(Int32, "topic", got.append, 1, callback_group=group)
    publisher = node.create_publisher(Int32, "topic", 1)
    publisher.publish(Int32())
    executor.spin_once(LIMIT_S)
    assert group.event is None
    assert got == []


def test_the_node_moves_to_another_executor(context, node):
    ran = []
    with (
        SingleThreadedExecutor(context=context) as first,
        SingleThreadedExecutor(context=context) as second,
    ):
        first.add_node(node)
        group = InterruptedGroup(lambda: second.add_node(node))
        guard = node.create_guard_condition(lambda: ran.append(1), callback_group=group)
        guard.trigger()
        first.spin_once(0)  # the trigger is noted already
        first.spin_once(0)
        assert ran == []
        second.spin_once(LIMIT_S)
        assert ran == [1]


def test_a_service_that_a_callback_of_its_group_holds_up(node):
    """The executor may find it held up just as another thread destroys it."""
    service = node.create_service(Trigger, "serve", lambda _, response: response)
    service.destroy()
    waits = SelfWaits()
    waits.held_up(service, suspended=[service], served=[service])
    assert waits.bounded(None) is None


def test_a_service_that_answers(spinning, node, context):
    """The callback waits until the service has been destroyed: its answer goes nowhere."""
    in_callback, destroyed = threading.Event(), threading.Event()

    def answer(_, response):
        in_callback.set()
        destroyed.wait(LIMIT_S)
        return response

    service = node.create_service(Trigger, "serve", answer)
    caller = Node("caller", context=context)
    client = caller.create_client(Trigger, "serve")
    assert client.wait_for_service(LIMIT_S)
    client.call_async(Trigger.Request())
    assert in_callback.wait(LIMIT_S)
    node.destroy_service(service)
    destroyed.set()
    assert spinning.still_runs(node)


@pytest.mark.parametrize("asked", ["goal", "cancel"])
def test_an_action_server_that_answers(spinning, node, context, asked):
    """A callback waits until the server has been destroyed: its answer goes nowhere."""
    in_callback, destroyed = threading.Event(), threading.Event()

    def decide(decision):
        in_callback.set()
        destroyed.wait(LIMIT_S)
        return decision

    decisions = {
        "goal": {"goal_callback": lambda _: decide(GoalResponse.ACCEPT)},
        "cancel": {
            "cancel_callback": lambda _: decide(CancelResponse.ACCEPT),
            "handle_accepted_callback": lambda _: None,  # it stays accepted
        },
    }
    server = ActionServer(node, Fibonacci, "count", lambda _: None, **decisions[asked])
    caller = Node("caller", context=context)
    client = ActionClient(caller, Fibonacci, "count")
    assert client.wait_for_server(LIMIT_S)
    accepted = client.send_goal_async(Fibonacci.Goal())
    if asked == "cancel":
        with SingleThreadedExecutor(context=context) as executor:
            executor.add_node(caller)
            executor.spin_until_future_complete(accepted, LIMIT_S)
        accepted.result().cancel_goal_async()
    assert in_callback.wait(LIMIT_S)
    server.destroy()
    destroyed.set()
    assert spinning.still_runs(node)


def test_everything_under_load(spinning, node, context):
    """Entities come, are used and go, again and again; whatever the moment, spinning goes on."""
    other = Node("other", context=context)
    publisher = other.create_publisher(Int32, "numbers", 10)
    client = other.create_client(AddTwoInts, "add")
    for _ in range(ROUNDS):
        subscription = node.create_subscription(Int32, "numbers", lambda _: None, 10)
        service = node.create_service(AddTwoInts, "add", lambda _, response: response)
        timer = node.create_timer(0.0001, lambda: None)
        guard = node.create_guard_condition(lambda: None)
        assert client.wait_for_service(LIMIT_S)
        for _ in range(5):
            publisher.publish(Int32())
            client.call_async(AddTwoInts.Request())
            guard.trigger()
        node.destroy_service(service)
        node.destroy_subscription(subscription)
        node.destroy_timer(timer)
        node.destroy_guard_condition(guard)
        assert spinning.failure is None
    assert spinning.still_runs(node)


@pytest.mark.parametrize("by", ["client", "node"])
@pytest.mark.parametrize("kind", ["call", "wait_for_service", "send_goal", "wait_for_server"])
def test_a_client_that_another_thread_waits_with(spinning, node, context, kind, by):
    """The wait could never end: it raises, as the next use of the client would."""
    called = threading.Event()
    other = Node("other", context=context)
    other.create_service(AddTwoInts, "add", lambda _, response: response)  # nobody spins it
    ActionServer(other, Fibonacci, "count", lambda _: None)
    waiter = Node("waiter", context=context)
    spinning.executor.add_node(waiter)
    is_action = kind in ("send_goal", "wait_for_server")
    there = kind in ("call", "send_goal")
    if is_action:
        client = ActionClient(waiter, Fibonacci, "count" if there else "absent")
        assert not there or client.wait_for_server(LIMIT_S)
    else:
        client = waiter.create_client(AddTwoInts, "add" if there else "absent")
        assert not there or client.wait_for_service(LIMIT_S)
    arguments = {"call": [AddTwoInts.Request()], "send_goal": [Fibonacci.Goal()]}.get(kind, [])
    ends = []

    def wait():
        called.set()
        with pytest.raises(InvalidHandle, match="destruction was requested") as raised:
            getattr(client, kind)(*arguments)
        ends.append(raised)

    thread = threading.Thread(target=wait, daemon=True)
    thread.start()
    assert called.wait(LIMIT_S)
    if by == "node":
        waiter.destroy_node()
    elif is_action:
        client.destroy()
    else:
        waiter.destroy_client(client)
    thread.join(LIMIT_S)
    assert ends
    assert spinning.still_runs(node)


class DestroysAsItIsRead(Int32):
    """Destroys its publisher between the publisher's look whether it lives and the sending."""

    destroy = staticmethod(lambda: None)

    @property
    def data(self):
        self.destroy()
        return 1

    @data.setter
    def data(self, value):
        pass


def test_a_publisher_that_another_thread_destroys_while_it_publishes(node, context):
    publisher = node.create_publisher(Int32, "numbers", 10)
    message = DestroysAsItIsRead()
    Node("other", context=context).create_subscription(Int32, "numbers", lambda _: None, 10)
    message.destroy = lambda: node.destroy_publisher(publisher)
    with pytest.raises(InvalidHandle, match="destruction was requested"):
        publisher.publish(message)


def test_a_client_that_another_thread_destroys_while_it_calls(node):
    class Destroys(AddTwoInts.Request):
        @property
        def a(self):
            node.destroy_client(client)
            return 1

        @a.setter
        def a(self, value):
            pass

    client = node.create_client(AddTwoInts, "add")
    request = Destroys()
    with pytest.raises(InvalidHandle, match="destruction was requested"):
        client.call_async(request)


def test_a_future_awaited_in_a_callback_that_an_asyncio_loop_spins(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    client = node.create_client(Trigger, "inner")

    async def outer(_, response):
        response.message = (await client.call_async(Trigger.Request())).message
        return response

    def inner(_, response):
        response.message = "from within"
        return response

    node.create_service(Trigger, "inner", inner, callback_group=ReentrantCallbackGroup())
    node.create_service(Trigger, "outer", outer)

    async def main():
        future = node.create_client(Trigger, "outer").call_async(Trigger.Request())
        while not future.done():
            executor.spin_once(timeout_sec=LIMIT_S)
            await asyncio.sleep(0)
        return (await future).message

    assert asyncio.run(main()) == "from within"
    executor.shutdown()


def test_a_callback_may_run_an_asyncio_loop_that_awaits_a_future(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    result = executor.create_task(lambda: None)
    executor.spin_once()

    async def wait_for(future):
        return await asyncio.wait_for(_awaited(future), LIMIT_S)

    async def callback():
        later = executor.create_task(lambda: 3)
        threading.Timer(0.01, later).start()
        return asyncio.run(wait_for(later))

    assert result.done()
    task = executor.create_task(callback)
    executor.spin_until_future_complete(task, timeout_sec=LIMIT_S)
    assert task.result() == 3
    executor.shutdown()


async def _awaited(future):
    return await future


def test_shutdown_while_a_service_answers_ends_spin(context):
    node = Node("server", context=context)
    called = []

    def answer(_request, response):
        called.append(context.try_shutdown())  # as Ctrl-C does, in the middle of a callback
        return response

    node.create_service(Trigger, "go", answer)
    asker = Node("asker", context=context)
    client = asker.create_client(Trigger, "go")
    assert client.wait_for_service(timeout_sec=LIMIT_S)
    client.call_async(Trigger.Request())
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()
    assert len(called) == 1
