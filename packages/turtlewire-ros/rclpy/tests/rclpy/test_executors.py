"""Executors: order, waits, callback groups, threads, shutdown."""

import gc
import math
import os
import threading
import time
import weakref
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import pytest

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.executors import (
    Executor,
    ExternalShutdownException,
    MultiThreadedExecutor,
    ShutdownException,
    SingleThreadedExecutor,
    TimeoutException,
    TimeoutObject,
)
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int32


@pytest.fixture(params=[SingleThreadedExecutor, MultiThreadedExecutor, EventsExecutor])
def any_executor(request, context, node):
    arguments = {"num_threads": 3} if request.param is MultiThreadedExecutor else {}
    executor = request.param(context=context, **arguments)
    executor.add_node(node)
    yield executor
    executor.shutdown()


def add_two_ints(request, response):
    response.sum = request.a + request.b
    return response


def test_it_needs_an_initialized_context():
    with pytest.raises(NotInitializedException):
        SingleThreadedExecutor(context=Context())


def test_one_cycle_runs_in_ros_2s_order(node, executor):
    order = []
    client = node.create_client(AddTwoInts, "add")
    node.create_service(
        AddTwoInts, "add", lambda request, response: order.append("service") or response
    )
    guard = node.create_guard_condition(lambda: order.append("guard"))
    node.create_subscription(Int32, "number", lambda _: order.append("subscription"), 10)
    publisher = node.create_publisher(Int32, "number", 10)
    node.create_timer(0, lambda: order.append("timer")).timer_period_ns = 3_600_000_000_000
    executor.create_task(order.append, "older task")
    executor.create_task(order.append, "newer task")
    client.call_async(AddTwoInts.Request())
    guard.trigger()
    publisher.publish(Int32())
    for _ in range(6):
        executor.spin_once(timeout_sec=60)
    assert order == ["newer task", "older task", "timer", "subscription", "guard", "service"]


def test_nodes_are_served_in_the_order_in_which_they_were_added(context, node, executor):
    order = []
    second = Node("second", context=context)
    executor.add_node(second)
    for owner in (second, node):
        owner.create_guard_condition(partial(order.append, owner.get_name())).trigger()
    executor.spin_once(timeout_sec=60)
    executor.spin_once(timeout_sec=60)
    assert order == ["tested", "second"]


def test_spin_once_runs_one_callback(node, executor):
    calls = []
    guards = [
        node.create_guard_condition(lambda number=number: calls.append(number))
        for number in range(3)
    ]
    for guard in guards:
        guard.trigger()
    executor.spin_once(timeout_sec=60)
    assert calls == [0]
    executor.spin_once(timeout_sec=math.inf)
    assert calls == [0, 1]


def test_a_wake_up_for_nothing_does_not_end_spin_once(later, executor):
    start = time.monotonic()
    later(executor.wake)
    executor.spin_once(timeout_sec=0.1)
    assert time.monotonic() - start >= 0.1


def test_messages_come_one_by_one_and_in_order(node, executor, spin_until):
    got = []
    node.create_subscription(Int32, "number", lambda message: got.append(message.data), 100)
    publisher = node.create_publisher(Int32, "number", 100)
    for number in range(20):
        publisher.publish(Int32(data=number))
    executor.spin_once(timeout_sec=60)
    assert got == [0]
    spin_until(lambda: len(got) == 20)
    assert got == list(range(20))


def test_a_trigger_without_an_executor_is_not_lost(context, node):
    calls = []
    guard = node.create_guard_condition(lambda: calls.append(1))
    guard.trigger()
    guard.trigger()
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.spin_once(timeout_sec=60)
    executor.spin_once(timeout_sec=0)
    assert calls == [1]
    executor.shutdown()


def test_entities_that_come_and_go_while_it_spins(node, executor, spinning):
    spinning(executor)
    for round_number in range(5):
        called = threading.Event()
        guard = node.create_guard_condition(called.set)
        guard.trigger()
        assert called.wait(60), round_number
        node.destroy_guard_condition(guard)
    assert list(node.guards) == []


def test_a_destroyed_entity_is_not_served_although_it_was_ready(node, executor):
    calls = []
    first = node.create_guard_condition(lambda: node.destroy_guard_condition(second))
    second = node.create_guard_condition(lambda: calls.append("never"))
    first.trigger()
    second.trigger()
    executor.spin_once(timeout_sec=60)
    executor.spin_once(timeout_sec=0)
    assert calls == []


def test_a_node_leaves_the_executor_it_was_in(context, node, executor):
    other = SingleThreadedExecutor(context=context)
    assert not executor.add_node(node)
    assert other.add_node(node)
    assert node.executor is other
    assert executor.get_nodes() == []
    calls = []
    node.create_guard_condition(lambda: calls.append(1)).trigger()
    executor.spin_once(timeout_sec=0)
    assert calls == []
    other.spin_once(timeout_sec=60)
    assert calls == [1]
    node.executor = executor
    assert other.get_nodes() == []
    executor.remove_node(node)
    executor.remove_node(node)
    assert executor.get_nodes() == []
    assert node.executor is executor
    node.executor = None
    assert node.executor is None
    other.shutdown()


def test_a_node_of_a_dropped_executor_is_served_by_the_next_one(context):
    node = Node("served_again", context=context)
    calls = []
    guard = node.create_guard_condition(lambda: calls.append(1))
    dropped = SingleThreadedExecutor(context=context)
    dropped.add_node(node)
    dropped.spin_once(timeout_sec=0)
    del dropped  # without a shutdown
    gc.collect()
    following = SingleThreadedExecutor(context=context)
    following.add_node(node)
    guard.trigger()
    following.spin_once(timeout_sec=60)
    assert calls == [1]
    following.shutdown()


def test_a_task_survives_an_interrupted_wait(node, executor, monkeypatch):
    calls = []
    executor.create_task(calls.append, 1)

    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(executor._rclpy_scheduler.wait, "wait", interrupted)
        with pytest.raises(KeyboardInterrupt):
            executor.spin_once(timeout_sec=60)
    executor.spin_once(timeout_sec=60)
    assert calls == [1]


def test_a_shutdown_may_wait_without_limit(later, node, executor, spinning):
    begun, goes_on = threading.Event(), threading.Event()
    node.create_guard_condition(lambda: (begun.set(), goes_on.wait(60))).trigger()
    spinning(executor)
    assert begun.wait(60)
    later(goes_on.set)
    assert executor.shutdown(timeout_sec=math.inf)
    assert executor.get_nodes() == []


def test_an_exception_leaves_spin_and_the_group_is_free_again(node, executor):
    node.create_guard_condition(lambda: 1 / 0).trigger()
    with pytest.raises(ZeroDivisionError):
        executor.spin()
    calls = []
    node.create_guard_condition(lambda: calls.append(1)).trigger()
    executor.spin_once(timeout_sec=60)
    assert calls == [1]


def test_an_exception_of_an_async_callback_leaves_spin(node, executor):
    gate = Future()

    async def fail():
        await gate
        raise LookupError("after waiting")

    node.create_guard_condition(fail).trigger()
    executor.spin_once(timeout_sec=60)
    gate.set_result(None)
    with pytest.raises(LookupError, match="after waiting"):
        executor.spin_once(timeout_sec=60)


@pytest.mark.parametrize("waits", [False, True])
def test_an_interrupted_async_callback_releases_its_group(node, executor, waits):
    gate = Future()

    async def interrupt():
        if waits:
            await gate
        raise KeyboardInterrupt

    node.create_guard_condition(interrupt).trigger()
    if waits:
        executor.spin_once(timeout_sec=60)
        gate.set_result(None)
    with pytest.raises(KeyboardInterrupt):
        executor.spin_once(timeout_sec=60)
    called = Future()
    node.create_guard_condition(lambda: called.set_result(None)).trigger()
    executor.spin_until_future_complete(called, timeout_sec=60)
    assert called.done()


def test_an_exception_in_a_pool_thread_leaves_spin_in_the_spinning_one(node, pool):
    node.create_guard_condition(lambda: 1 / 0).trigger()
    with pytest.raises(ZeroDivisionError):
        pool.spin()


def test_a_waiting_async_callback_holds_its_group_but_nothing_else(node, executor, spin_until):
    order = []
    gate = Future()

    async def wait():
        order.append("waits")
        await gate
        order.append("goes on")

    node.create_guard_condition(wait).trigger()
    node.create_guard_condition(lambda: order.append("same group")).trigger()
    node.create_guard_condition(
        lambda: order.append("other group"), MutuallyExclusiveCallbackGroup()
    ).trigger()
    free = MutuallyExclusiveCallbackGroup()
    node.create_guard_condition(lambda: order.append("kept group"), free).trigger()
    spin_until(lambda: "kept group" in order)
    executor.spin_once(timeout_sec=0.05)
    assert order == ["waits", "other group", "kept group"]
    gate.set_result(None)
    spin_until(lambda: "same group" in order)
    assert order[3:] == ["goes on", "same group"]


def noted_waits(executor):
    """Return a list of the timeouts of the middleware's waits from now on."""
    wait_set, waits = executor._rclpy_scheduler.wait._wait_set, []
    wait_once = wait_set.wait
    wait_set.wait = lambda timeout: waits.append(timeout) or wait_once(timeout)
    return waits


def test_a_blocked_subscription_costs_no_cpu(node, executor):
    gate = Future()

    async def wait(_):
        await gate

    node.create_subscription(Int32, "number", wait, 10)
    publisher = node.create_publisher(Int32, "number", 10)
    publisher.publish(Int32())
    publisher.publish(Int32())
    executor.spin_once(timeout_sec=60)
    waits = noted_waits(executor)
    executor.spin_once(timeout_sec=0.2)
    assert len(waits) <= 3


def test_awaiting_a_service_in_the_same_group(node, executor):
    node.create_service(AddTwoInts, "add", add_two_ints, callback_group=ReentrantCallbackGroup())
    client = node.create_client(AddTwoInts, "add")
    answer = Future()

    async def ask():
        answer.set_result(await client.call_async(AddTwoInts.Request(a=2, b=3)))

    node.create_guard_condition(ask).trigger()
    executor.spin_until_future_complete(answer, timeout_sec=60)
    assert answer.result().sum == 5


def test_an_async_service_answers_when_it_is_done(node, executor):
    gate = Future()

    async def serve(request, response):
        await gate
        return add_two_ints(request, response)

    node.create_service(AddTwoInts, "add", serve)
    answer = node.create_client(AddTwoInts, "add").call_async(AddTwoInts.Request(a=1, b=1))
    executor.spin_once(timeout_sec=60)
    assert not answer.done()
    gate.set_result(None)
    executor.spin_until_future_complete(answer, timeout_sec=60)
    assert answer.result().sum == 2


def test_call_in_a_callback_of_a_single_thread(context, node, executor, spinning):
    """The server is in another executor.

    This one hands itself the response while its only thread blocks.
    """
    server = Node("server", context=context)
    server.create_service(AddTwoInts, "add", add_two_ints)
    elsewhere = SingleThreadedExecutor(context=context)
    elsewhere.add_node(server)
    spinning(elsewhere)
    client = node.create_client(AddTwoInts, "add")
    order = []
    node.create_guard_condition(
        lambda: order.append(client.call(AddTwoInts.Request(a=1, b=2)).sum)
    ).trigger()
    node.create_guard_condition(lambda: order.append("after"), ReentrantCallbackGroup()).trigger()
    node.create_timer(
        0.001, lambda: order.append("timer"), ReentrantCallbackGroup()
    ).timer_period_ns = 3_600_000_000_000
    executor.spin_once(timeout_sec=60)
    assert order in ([3], ["timer"])
    for _ in range(2):
        executor.spin_once(timeout_sec=60)
    assert sorted(order, key=str) == [3, "after", "timer"]


def test_call_to_a_service_of_the_blocked_executor_raises(node, executor):
    node.create_service(AddTwoInts, "add", add_two_ints)
    client = node.create_client(AddTwoInts, "add")
    node.create_guard_condition(lambda: client.call(AddTwoInts.Request())).trigger()
    with pytest.raises(RuntimeError, match="it would never answer"):
        executor.spin_once(timeout_sec=60)


@pytest.mark.parametrize("timeout_sec", [0.05, -0.5])
def test_call_in_a_callback_respects_its_timeout(node, executor, timeout_sec):
    client = node.create_client(AddTwoInts, "nobody")
    responses = []
    node.create_guard_condition(
        lambda: responses.append(client.call(AddTwoInts.Request(), timeout_sec))
    ).trigger()
    executor.spin_once(timeout_sec=60)
    assert responses == [None]
    assert client._pending == {}


@pytest.mark.parametrize("spin", ["spin_until_future_complete", "spin_once_until_future_complete"])
def test_a_pending_future_keeps_no_executor_that_waited_for_it(context, spin):
    pending = Future()
    executor = SingleThreadedExecutor(context=context)
    for _ in range(3):
        getattr(executor, spin)(pending, timeout_sec=0)
    executor.shutdown()
    gone = weakref.ref(executor)
    del executor
    gc.collect()
    assert gone() is None
    assert not pending.done()


def test_call_in_a_pool_thread_while_all_threads_are_busy(node, pool, spinning):
    node.create_service(AddTwoInts, "add", add_two_ints, callback_group=ReentrantCallbackGroup())
    client = node.create_client(AddTwoInts, "add")
    sums = []
    done = threading.Semaphore(0)

    def ask(number):
        sums.append(client.call(AddTwoInts.Request(a=number, b=1), timeout_sec=60).sum)
        done.release()

    group = ReentrantCallbackGroup()
    for number in range(2):
        node.create_guard_condition(lambda number=number: ask(number), group).trigger()
    spinning(pool)
    for _ in range(2):
        assert done.acquire(timeout=60)
    assert sorted(sums) == [1, 2]


def test_call_ends_when_the_executor_is_shut_down(node, pool):
    client = node.create_client(AddTwoInts, "nobody")
    entered = threading.Event()
    ended = []

    def ask():
        entered.set()
        try:
            client.call(AddTwoInts.Request())
        except ShutdownException:
            ended.append("shut down")
            raise

    node.create_guard_condition(ask).trigger()
    pool.spin_once(timeout_sec=60)
    assert entered.wait(60)
    assert pool.shutdown(10)
    assert ended == ["shut down"]


def test_callback_ready_during_pool_shutdown_is_no_error(node, pool, monkeypatch):
    scheduler, ran = pool._rclpy_scheduler, []
    guard = node.create_guard_condition(lambda: ran.append(1))
    take_next = scheduler.next

    def next_then_shut_down(*arguments):
        found = take_next(*arguments)
        assert pool.shutdown(10)
        return found

    monkeypatch.setattr(scheduler, "next", next_then_shut_down)
    guard.trigger()
    pool.spin_once(timeout_sec=60)
    assert ran == []
    assert guard.callback_group.can_execute(guard)


def test_a_call_that_nobody_serves_is_warned_of(node, capfd, monkeypatch):
    monkeypatch.setattr("rclpy._execution.blocking._PATIENCE_S", 0.0)
    client = node.create_client(AddTwoInts, "add")
    node.create_service(AddTwoInts, "add", add_two_ints)
    assert client.call(AddTwoInts.Request(), timeout_sec=1) is None
    assert "no executor spins the calling node" in capfd.readouterr().err


def test_a_call_of_a_service_in_the_callers_own_group_is_warned_of(node, pool, spinning, capfd):
    client = node.create_client(AddTwoInts, "add")
    node.create_service(AddTwoInts, "add", add_two_ints)
    over, responses = threading.Event(), []

    def ask():
        responses.append(client.call(AddTwoInts.Request(), timeout_sec=4))
        over.set()

    node.create_guard_condition(ask).trigger()
    spinning(pool)
    assert over.wait(60)
    assert (
        "service '/add', which cannot run because its callback group is busy"
        in capfd.readouterr().err
    )


def test_reentrant_group_runs_up_to_the_number_of_threads(node, pool, spinning):
    barrier = threading.Barrier(3, timeout=60)
    done = threading.Semaphore(0)

    def meet(_):
        barrier.wait()
        done.release()

    node.create_subscription(Int32, "number", meet, 100, callback_group=ReentrantCallbackGroup())
    publisher = node.create_publisher(Int32, "number", 100)
    for number in range(30):
        publisher.publish(Int32(data=number))
    spinning(pool)
    for _ in range(30):
        assert done.acquire(timeout=60)
    assert not barrier.broken


def test_an_exclusive_group_never_runs_twice_at_a_time(node, pool, spinning):
    running = []
    overlaps = []
    done = threading.Semaphore(0)

    def work(message):
        running.append(message)
        overlaps.append(len(running))
        time.sleep(0.001)
        running.pop()
        done.release()

    group = MutuallyExclusiveCallbackGroup()
    for topic in ("a", "b"):
        node.create_subscription(Int32, topic, work, 100, callback_group=group)
        publisher = node.create_publisher(Int32, topic, 100)
        for number in range(40):
            publisher.publish(Int32(data=number))
    spinning(pool)
    for _ in range(80):
        assert done.acquire(timeout=60)
    assert overlaps == [1] * 80


def test_spin_until_future_complete(later, any_executor):
    future = Future()
    later(future.set_result, 7)
    any_executor.spin_until_future_complete(future, timeout_sec=60)
    assert future.result() == 7
    start = time.monotonic()
    any_executor.spin_until_future_complete(Future(), timeout_sec=0.05)
    assert 0.05 <= time.monotonic() - start < 30
    any_executor.spin_once_until_future_complete(future, timeout_sec=60)


def test_spinning_within_a_callback(node, executor):
    """A common mistake that ROS 2 lets pass.

    The inner spin runs what the outer callback does not block.
    """
    node.create_service(AddTwoInts, "add", add_two_ints, callback_group=ReentrantCallbackGroup())
    client = node.create_client(AddTwoInts, "add")
    sums = []

    def ask():
        answer = client.call_async(AddTwoInts.Request(a=4, b=4))
        executor.spin_until_future_complete(answer, timeout_sec=60)
        sums.append(answer.result().sum)

    node.create_guard_condition(ask).trigger()
    executor.spin_once(timeout_sec=60)
    assert sums == [8]


def test_a_spin_within_a_callback_that_cannot_succeed_is_warned_of(
    node, executor, capfd, monkeypatch
):
    done = Future()
    at_once, later = (
        node.create_guard_condition(lambda: done.set_result("in the same group")) for _ in range(2)
    )
    scheduler = executor._rclpy_scheduler
    warn = scheduler.warn_of_nested_spin
    monkeypatch.setattr(
        scheduler, "warn_of_nested_spin", lambda: (warn(), done.set_result("after the warning"))
    )

    def wait():
        at_once.trigger()
        helping = threading.Timer(
            0.1, later.trigger
        )  # what cannot run either does not put the warning off
        helping.start()
        executor.spin_until_future_complete(done)
        helping.join()

    node.create_guard_condition(wait).trigger()
    executor.spin_once(timeout_sec=60)
    assert done.result() == "after the warning"
    assert (
        "A callback spins its own executor, and nothing can run: the ready entities "
        "(GuardCondition)" in capfd.readouterr().err
    )


def test_an_async_callback_that_waits_for_itself_is_warned_of(
    node, any_executor, capfd, monkeypatch
):
    monkeypatch.setattr("rclpy._execution.blocking._PATIENCE_S", 0.01)
    service = node.create_service(AddTwoInts, "held_up", lambda _, response: response)
    client = node.create_client(AddTwoInts, "held_up")
    warned = Future()
    warning = service._logger.warning
    monkeypatch.setattr(
        service._logger, "warning", lambda text: (warning(text), warned.set_result(None))
    )

    async def ask():
        await client.call_async(AddTwoInts.Request())

    node.create_guard_condition(ask).trigger()
    any_executor.spin_until_future_complete(warned, timeout_sec=60)
    any_executor.spin_once(timeout_sec=0.05)  # says nothing a second time
    assert (
        capfd.readouterr().err.count(
            "An async callback awaits, and service '/held_up', which was called, cannot run "
            "before it ends"
        )
        == 1
    )


def test_an_async_callback_that_waits_for_others_is_not(node, any_executor, capfd, monkeypatch):
    monkeypatch.setattr("rclpy._execution.blocking._PATIENCE_S", 0.0)
    node.create_service(
        AddTwoInts,
        "free",
        lambda _, response: response,
        callback_group=MutuallyExclusiveCallbackGroup(),
    )
    node.create_service(AddTwoInts, "not_called", lambda _, response: response)
    client = node.create_client(AddTwoInts, "free")
    answered = Future()

    async def ask():
        await client.call_async(AddTwoInts.Request())
        answered.set_result(None)

    node.create_guard_condition(ask).trigger()
    any_executor.spin_until_future_complete(answered, timeout_sec=60)
    assert answered.done()
    assert "An async callback" not in capfd.readouterr().err


def test_spinning_until_a_future_of_another_library_is_done(any_executor):
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(threading.get_ident)
        any_executor.spin_until_future_complete(future, timeout_sec=60)
    assert future.done()


def test_an_executor_knows_whether_it_spins(any_executor, context):
    assert not any_executor.is_spinning
    seen = any_executor.create_task(lambda: any_executor.is_spinning)
    any_executor.spin_until_future_complete(seen, timeout_sec=60)
    assert seen.result() is True
    assert not any_executor.is_spinning
    seen = []
    any_executor.create_task(lambda: (seen.append(any_executor.is_spinning), context.shutdown()))
    any_executor.spin()
    assert seen == [True]
    assert not any_executor.is_spinning


def test_two_threads_cannot_spin_one_executor(executor, spinning):
    spinning(executor)
    while not executor._rclpy_scheduler.is_spun():
        time.sleep(0.001)
    with pytest.raises(RuntimeError, match="Executor is already spinning"):
        executor.spin_once(timeout_sec=0)


def test_shutdown_waits_for_callbacks_of_other_threads(node, pool):
    entered, leave = threading.Event(), threading.Event()

    def work():
        entered.set()
        leave.wait(60)

    node.create_guard_condition(work).trigger()
    pool.spin_once(timeout_sec=60)
    assert entered.wait(60)
    assert not pool.shutdown(timeout_sec=0.05)
    leave.set()
    assert pool.shutdown(timeout_sec=60)


@pytest.mark.parametrize("waits", [True, False])
def test_shutdown_may_leave_the_threads_of_the_pool(pool, waits, monkeypatch):
    waited = []

    def note(*, wait):
        waited.append(wait)

    monkeypatch.setattr(pool._executor, "shutdown", note)
    assert pool.shutdown(timeout_sec=60, wait_for_threads=waits)
    assert waited == [False, waits]


def test_shutdown_in_a_callback_ends_spin(node, any_executor):
    ended = threading.Event()

    def shut_down():
        any_executor.shutdown()
        ended.set()

    node.create_guard_condition(shut_down).trigger()
    any_executor.spin()
    assert ended.wait(60)
    assert any_executor.get_nodes() == []


def test_shutting_the_context_down_ends_spin(later, context, executor):
    later(context.shutdown)
    with pytest.raises(ExternalShutdownException):
        executor.spin()
    executor.spin()


def test_a_pool_returns_from_spin_when_the_context_is_shut_down(later, context, pool):
    later(context.shutdown)
    pool.spin()


def test_with_statement_shuts_down(context):
    with SingleThreadedExecutor(context=context) as executor:
        assert executor.context is context
    executor.spin_once(timeout_sec=0)
    executor.spin()


def test_a_pool_of_one_is_warned_of(context):
    with pytest.warns(UserWarning, match="MultiThreadedExecutor is used with a single thread"):
        executor = MultiThreadedExecutor(1, context=context)
    executor.shutdown()


def test_the_default_size_of_a_pool(context):
    if len(os.sched_getaffinity(0)) == 1:
        pytest.skip("this machine gives the process a single processor")
    executor = MultiThreadedExecutor(context=context)
    assert executor._executor._max_workers == len(os.sched_getaffinity(0))
    executor.shutdown()


def test_an_idle_executor_does_not_run(node, executor, spinning):
    waits = noted_waits(executor)
    spinning(executor)
    deadline = time.monotonic() + 60
    while not waits and time.monotonic() < deadline:
        time.sleep(0.001)
    seen = len(waits)
    time.sleep(0.3)
    assert len(waits) == seen
    assert waits[-1] is None


class PoolForSomeNodes(Executor):
    """As one writes one for ROS 2.

    Callbacks of some nodes run in a pool, those of the others here.
    """

    def __init__(self, pool, nodes, **options):
        super().__init__(**options)
        self.pool = pool
        self.nodes_of_the_pool = nodes

    def spin_once(self, timeout_sec=None):
        handler, _entity, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        if node in self.nodes_of_the_pool:
            self.pool.submit(handler)
        else:
            handler()
            if handler.exception() is not None:
                raise handler.exception()


def test_an_executor_of_ones_own_decides_where_callbacks_run(context, node):
    other = Node("other", context=context)
    threads = {}
    both = threading.Barrier(2, timeout=60)

    def note(name):
        threads[name] = threading.get_ident()
        both.wait()

    group = MutuallyExclusiveCallbackGroup()
    guards = [
        node.create_guard_condition(partial(note, "pool"), group),
        other.create_guard_condition(partial(note, "here")),
        other.create_guard_condition(lambda: {}["missing"]),
    ]
    with ThreadPoolExecutor(1) as pool, PoolForSomeNodes(pool, [node], context=context) as executor:
        executor.add_node(node)
        executor.add_node(other)
        guards[0].trigger()
        executor.spin_once()
        assert not executor.can_execute(guards[0])
        guards[1].trigger()
        executor.spin_once()
        guards[2].trigger()
        with pytest.raises(KeyError, match="missing"):
            executor.spin_once()
        assert threads["here"] == threading.get_ident() != threads["pool"]
        executor.create_task(threads.clear)
        executor.spin_once()
        assert threads == {}
        with pytest.raises(TimeoutException):
            executor.spin_once(timeout_sec=0)
    assert executor.can_execute(guards[0])


def test_an_executor_of_ones_own_is_told_the_node_of_an_action(context, node):
    server = ActionServer(node, Fibonacci, "count", lambda _: Fibonacci.Result())
    caller = Node("caller", context=context)
    ActionClient(caller, Fibonacci, "count").send_goal_async(Fibonacci.Goal())
    with SingleThreadedExecutor(context=context) as executor:
        executor.add_node(node)
        handler, entity, owner = executor.wait_for_ready_callbacks(timeout_sec=60)
        handler()
    assert (entity, owner) == (server, node)


def test_a_group_that_becomes_free_while_an_entity_is_paused_is_noticed(node, executor):
    """Its last holder finds nothing to resume if it ends just before the entity is in the list."""

    class FreeOnSecondLook(MutuallyExclusiveCallbackGroup):
        looks = 0

        def can_execute(self, entity):
            self.looks += 1
            return self.looks > 1  # it was busy at the first look, and nothing will resume us

    ran = Future()
    group = FreeOnSecondLook()
    node.create_guard_condition(lambda: ran.set_result(True), callback_group=group).trigger()
    executor.spin_until_future_complete(ran, timeout_sec=60)
    assert ran.done()
    assert group.looks >= 2


KINDS = [SingleThreadedExecutor, partial(MultiThreadedExecutor, 2)]


@pytest.mark.parametrize("former_kind", KINDS)
@pytest.mark.parametrize("latter_kind", KINDS)
def test_callback_ended_by_a_former_executor_frees_its_group(
    context, node, spinning, former_kind, latter_kind
):
    """The former executor has no entity of the group any more: the latter one has to be woken."""
    former, latter = former_kind(context=context), latter_kind(context=context)
    started, may_end = threading.Event(), threading.Event()

    def hold():
        started.set()
        assert may_end.wait(60)

    holder = node.create_guard_condition(hold)
    spinning(former)
    for _ in range(2):
        former.add_node(node)
        started.clear()
        may_end.clear()
        holder.trigger()
        assert started.wait(60)
        latter.add_node(node)
        served = Future()
        node.create_guard_condition(partial(served.set_result, None)).trigger()
        latter.spin_once(timeout_sec=0)  # it finds the group busy
        assert not served.done()
        may_end.set()
        latter.spin_until_future_complete(served, timeout_sec=60)
        assert served.done()
    latter.shutdown()


def test_async_callback_of_a_former_executor_frees_its_group(context, node, executor):
    other = SingleThreadedExecutor(context=context)
    answer, served = Future(), []

    async def wait_for_the_answer():
        await answer

    node.create_guard_condition(wait_for_the_answer).trigger()
    executor.spin_once(timeout_sec=0)
    other.add_node(node)
    node.create_guard_condition(lambda: served.append(1)).trigger()
    other.spin_once(timeout_sec=0)
    assert served == []
    answer.set_result(None)
    executor.spin_once(timeout_sec=60)
    other.spin_once(timeout_sec=60)
    assert served == [1]
    other.shutdown()


def test_a_group_keeps_no_executor_that_waited_for_it(context, node):
    group = MutuallyExclusiveCallbackGroup()
    holder = object()
    assert group.beginning_execution(holder)
    other = SingleThreadedExecutor(context=context)
    other.add_node(node)
    node.create_guard_condition(lambda: None, callback_group=group).trigger()
    other.spin_once(timeout_sec=0)
    scheduler = weakref.ref(other._rclpy_scheduler)
    other.shutdown()
    del other
    gc.collect()
    assert scheduler() is None
    group.ending_execution(holder)


def test_an_executor_that_is_dropped_gives_back_its_wait_set(context):
    gc.collect()
    before = set(context.wire._wait_sets)
    other = SingleThreadedExecutor(context=context)
    assert len(context.wire._wait_sets) == len(before) + 1
    del other
    gc.collect()
    closed = threading.Event()
    context.wire.call_soon(closed.set)
    assert closed.wait(60)
    assert context.wire._wait_sets == before


def test_a_timeout_that_changes_between_waits(later, executor):
    timeout = TimeoutObject(0.0)
    with pytest.raises(TimeoutException):
        executor.wait_for_ready_callbacks(timeout)
    timeout.timeout = 60.0
    later(executor.create_task, lambda: None)
    handler, _, _ = executor.wait_for_ready_callbacks(timeout_sec=timeout)
    handler()
    assert (handler.done(), timeout.timeout) == (True, 60.0)
