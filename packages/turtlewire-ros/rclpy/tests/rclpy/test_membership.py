"""Nodes that leave an executor and come back, as in a loop of ``rclpy.spin_once``."""

import gc
import sys
import threading
import time
import weakref

import pytest

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.timer import Timer
from rclpy.waitable import Waitable
from std_msgs.msg import Int32


@pytest.fixture
def executor(context):
    executor = SingleThreadedExecutor(context=context)
    yield executor
    executor.shutdown()


@pytest.fixture
def make_node(context):
    made = []

    def make(name):
        made.append(Node(name, context=context))
        return made[-1]

    yield make
    for node in made:
        node.destroy_node()


@pytest.fixture
def heard(node):
    """What the node hears on ``number``."""
    numbers = []
    node.create_subscription(Int32, "number", lambda message: numbers.append(message.data), 10)
    return numbers


@pytest.fixture
def send(make_node):
    publisher = make_node("sender").create_publisher(Int32, "number", 10)
    return lambda number: publisher.publish(Int32(data=number))


def spin_once(executor, node, timeout_sec=60):
    executor.add_node(node)
    executor.spin_once(timeout_sec=timeout_sec)
    executor.remove_node(node)


def noted_changes(executor, monkeypatch):
    """Return a list of what is attached to the wait set, and detached from it, from now on."""
    changes = []
    wait_set = executor._rclpy_scheduler.wait._wait_set
    for name in ("attach", "detach"):
        original = getattr(wait_set, name)

        def change(wire, name=name, original=original):
            changes.append((name, wire))
            original(wire)

        monkeypatch.setattr(wait_set, name, change)
    return changes


def test_the_wait_set_stays_as_it_is(node, executor, heard, send, monkeypatch):
    spin_once(executor, node, 0)
    changes = noted_changes(executor, monkeypatch)
    for number in range(3):
        send(number)
        spin_once(executor, node)
    assert (heard, changes) == ([0, 1, 2], [])


def test_between_two_calls_no_executor_serves_the_node(node, executor, heard, send):
    spin_once(executor, node, 0)
    send(1)
    assert executor.get_nodes() == []
    executor.spin_once(timeout_sec=0)
    assert heard == []
    spin_once(executor, node)
    assert heard == [1]


def test_another_node_is_served_alone(node, executor, heard, send, make_node, monkeypatch):
    other, calls = make_node("other"), []
    guard = other.create_guard_condition(lambda: calls.append(1))
    spin_once(executor, node, 0)
    changes = noted_changes(executor, monkeypatch)
    send(1)
    guard.trigger()
    spin_once(executor, other)
    assert (calls, heard) == ([1], [])
    detached = {wire for name, wire in changes if name == "detach"}
    del changes[:]
    spin_once(executor, node)
    assert heard == [1]
    assert detached == {wire for name, wire in changes if name == "attach"} != set()


def test_a_passed_over_callback_is_reported_again(node, executor, make_node):
    """Found ready together with the first callback, and passed over in a spin of another node."""
    calls = []
    guards = [node.create_guard_condition(lambda n=n: calls.append(n)) for n in range(2)]
    other = make_node("other")
    other_guard = other.create_guard_condition(lambda: calls.append("other"))
    for guard in guards:
        guard.trigger()
    spin_once(executor, node)
    other_guard.trigger()
    spin_once(executor, other)
    spin_once(executor, node)
    assert calls == [0, "other", 1]


def test_entities_that_are_made_in_between_are_served(node, executor, heard, send):
    spin_once(executor, node, 0)
    more = []
    node.create_subscription(Int32, "number", lambda message: more.append(message.data), 10)
    send(1)
    spin_once(executor, node)
    spin_once(executor, node)
    assert (heard, more) == ([1], [1])


def test_entities_that_are_destroyed_in_between_are_not_served(node, executor, heard, send):
    more = []
    second = node.create_subscription(Int32, "number", more.append, 10)
    timer = node.create_timer(0.0, lambda: more.append("timer"))
    spin_once(executor, node, 0)
    del more[:]
    node.destroy_subscription(second)
    node.destroy_timer(timer)
    send(1)
    spin_once(executor, node)
    spin_once(executor, node, 0)
    assert (heard, more) == ([1], [])


def test_a_timer_goes_on(node, executor):
    calls = []
    node.create_timer(0.001, lambda: calls.append(1))
    for _ in range(3):
        spin_once(executor, node)
    assert len(calls) == 3


def test_a_timer_calls_nothing_while_its_node_is_away(node, executor, make_node):
    calls = []
    node.create_timer(0.0, lambda: calls.append("away"))
    make_node("other").create_timer(0.0, lambda: calls.append("other"))
    spin_once(executor, node)
    assert calls == ["away"]
    executor.spin_once(timeout_sec=0.0)
    assert calls == ["away"]


def test_it_comes_back_behind_nodes_that_were_added_since(node, executor, make_node):
    order = []
    guard = node.create_guard_condition(lambda: order.append("first"))
    other = make_node("other")
    other_guard = other.create_guard_condition(lambda: order.append("second"))
    spin_once(executor, node, 0)
    executor.add_node(other)
    executor.add_node(node)
    guard.trigger()
    other_guard.trigger()
    for _ in range(2):
        executor.spin_once(timeout_sec=60)
    assert order == ["second", "first"]


def test_another_executor_takes_it(node, context, executor, heard, send, monkeypatch):
    spin_once(executor, node, 0)
    changes = noted_changes(executor, monkeypatch)
    with SingleThreadedExecutor(context=context) as another:
        another.add_node(node)
        assert {name for name, _ in changes} == {"detach"}
        send(1)
        another.spin_once(timeout_sec=60)
        assert heard == [1]
        another.remove_node(node)
        send(2)
        spin_once(executor, node)
    assert heard == [1, 2]


def test_a_node_that_is_dropped_in_between_is_freed(executor, make_node, context):
    node = Node("dropped", context=context)
    node.create_subscription(Int32, "number", lambda _: None, 10)
    node.create_timer(3600.0, lambda: None)
    spin_once(executor, node, 0)
    reference = weakref.ref(node)
    del node
    gc.collect()
    assert reference() is None
    spin_once(executor, make_node("next"), 0)


def test_a_dropped_executor_is_freed_although_its_last_node_lives(node, context):
    executor = SingleThreadedExecutor(context=context)
    spin_once(executor, node, 0)
    reference = weakref.ref(executor)
    del executor
    gc.collect()
    assert reference() is None


def test_goals_between_two_calls_wait_for_the_next(node, executor, make_node, context):
    finished = []

    def execute(handle):
        handle.succeed()
        finished.append(handle.request.order)
        return Fibonacci.Result()

    accepted = []
    server = ActionServer(
        node, Fibonacci, "count", execute, handle_accepted_callback=accepted.append
    )
    caller = make_node("caller")
    client = ActionClient(caller, Fibonacci, "count")
    with SingleThreadedExecutor(context=context) as calling:
        calling.add_node(caller)
        for order in (1, 2):
            goal = client.send_goal_async(Fibonacci.Goal(order=order))
            while not accepted:
                spin_once(executor, node)
            calling.spin_until_future_complete(goal, timeout_sec=60)
            accepted.pop().execute()
            assert order not in finished
            spin_once(executor, node)
            assert order in finished
        client.destroy()
    server.destroy()


def test_a_node_leaves_while_its_group_is_busy(node, context, send):
    """Its paused subscription is not in the wait set, and must be when the node comes back."""
    group = MutuallyExclusiveCallbackGroup()
    entered, leave, heard = threading.Event(), threading.Event(), threading.Event()

    def block():
        timer.cancel()
        entered.set()
        assert leave.wait(60)

    timer = node.create_timer(0.0, block, callback_group=group)
    node.create_subscription(Int32, "number", lambda _: heard.set(), 10, callback_group=group)
    executor = MultiThreadedExecutor(2, context=context)
    executor.add_node(node)
    executor.spin_once(timeout_sec=60)
    assert entered.wait(60)
    send(1)
    executor.spin_once(timeout_sec=0)
    executor.remove_node(node)
    leave.set()
    executor.add_node(node)
    deadline = time.monotonic() + 60
    while not heard.wait(0.01):
        assert time.monotonic() < deadline
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()


@pytest.mark.parametrize("moment", ["before", "after"])
def test_an_entity_that_is_made_while_its_node_leaves_is_served_later(
    node, executor, monkeypatch, moment
):
    """Another thread makes it, just before or after the executor has parked the node."""
    calls = []
    executor.add_node(node)
    scheduler = executor._rclpy_scheduler
    original = scheduler.adopt

    def adopt(*arguments):
        if moment == "before":
            executor.remove_node(node)
        original(*arguments)
        if moment == "after":
            executor.remove_node(node)

    with monkeypatch.context() as patch:
        patch.setattr(scheduler, "adopt", adopt)
        guard = node.create_guard_condition(lambda: calls.append(1))
    guard.trigger()
    spin_once(executor, node)
    guard.trigger()
    spin_once(executor, node)
    assert calls == [1, 1]


def test_an_entity_that_is_destroyed_while_its_node_leaves(node, executor, heard, monkeypatch):
    executor.add_node(node)
    scheduler = executor._rclpy_scheduler
    original = scheduler.release

    def release(entity):
        executor.remove_node(node)
        original(entity)

    timer = node.create_timer(0.0, lambda: None)
    changes = noted_changes(executor, monkeypatch)
    with monkeypatch.context() as patch:
        patch.setattr(scheduler, "release", release)
        node.destroy_timer(timer)
    executor.spin_once(timeout_sec=0)
    left = {wire for name, wire in changes if name == "detach"}
    assert left != set()
    spin_once(executor, node, 0)
    assert {wire for name, wire in changes if name == "attach"} == left


def test_timers_of_another_thread_come_and_go(node, executor):
    """Nothing that it made is lost, and nothing raises in the thread that spins."""
    lost, interval = [], sys.getswitchinterval()

    def make():
        for number in range(300):
            node.destroy_timer(node.create_timer(3600.0, lambda: None))
            came = threading.Event()
            guard = node.create_guard_condition(came.set)
            guard.trigger()
            if not came.wait(60):
                lost.append(number)
            node.destroy_guard_condition(guard)

    maker = threading.Thread(target=make)
    sys.setswitchinterval(1e-6)
    try:
        maker.start()
        while maker.is_alive():
            spin_once(executor, node, 0)
    finally:
        sys.setswitchinterval(interval)
        maker.join(60)
    assert lost == []


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
def test_a_waitable_moves_between_parked_nodes(node, executor, make_node):
    other = make_node("other")
    client = ActionClient(node, Fibonacci, "count")
    spin_once(executor, node, 0)
    node.remove_waitable(client)
    other.add_waitable(client)
    spin_once(executor, other, 0)
    spin_once(executor, node, 0)
    server = ActionServer(make_node("server"), Fibonacci, "count", lambda _: Fibonacci.Result())
    answer = client.send_goal_async(Fibonacci.Goal())
    with SingleThreadedExecutor(context=node.context) as serving:
        serving.add_node(server._node)
        serving.spin_once(timeout_sec=60)
    while not answer.done():
        spin_once(executor, other)
    assert answer.result() is not None
    server.destroy()
    client.destroy()


def test_a_destroyed_part_of_a_waitable_is_not_served(node, executor):
    ran = []

    class Ticking(Waitable):
        def __init__(self):
            super().__init__(ReentrantCallbackGroup())
            self.timer = Timer(
                callback=None,
                callback_group=None,
                timer_period_ns=1_000_000,
                clock=node.get_clock(),
                context=node.context,
            )

        def add_to_wait_set(self, wait_set):
            wait_set.add_timer(self.timer)

        def is_ready(self, wait_set):
            return wait_set.is_ready("timer", 0)

        def take_data(self):
            return None

        async def execute(self, _):
            ran.append(1)

    ticking = Ticking()
    node.add_waitable(ticking)
    while not ran:
        spin_once(executor, node)
    ticking.timer.destroy()
    del ran[:]
    executor.add_node(node)
    for _ in range(5):
        executor.spin_once(timeout_sec=0.005)
    assert ran == []


def test_a_service_answers_in_a_loop_of_calls(node, executor, make_node, context):
    node.create_service(
        AddTwoInts, "add", lambda request, response: setattr(response, "sum", 7) or response
    )
    caller = make_node("caller")
    client = caller.create_client(AddTwoInts, "add")
    with SingleThreadedExecutor(context=context) as calling:
        for _ in range(3):
            future = client.call_async(AddTwoInts.Request())
            spin_once(executor, node)
            while not future.done():
                spin_once(calling, caller)
            assert future.result().sum == 7
