"""BufferServer and BufferClient: the answers and the errors of the buffer, from another node."""

import threading
import time

import pytest

from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from tf2_ros import (
    Buffer,
    BufferClient,
    BufferServer,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from tf2_ros.buffer_server import error_number, exception_for

LONG = Duration(seconds=60)


@pytest.fixture
def spun(context):
    """Spins nodes in separate threads."""
    executors, threads = [], []

    def spin(node):
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        executors.append(executor)
        threads.append(threading.Thread(target=executor.spin))
        threads[-1].start()
        return node

    yield spin
    for executor, thread in zip(executors, threads, strict=True):
        executor.shutdown()
        thread.join(60)
        assert not thread.is_alive()


@pytest.fixture
def buffer(make_node, spun):
    buffer, node = Buffer(), make_node("server")
    server = BufferServer(buffer, node, "lookup")
    spun(node)
    yield buffer
    server.destroy()


@pytest.fixture
def client(make_node):
    client = BufferClient(make_node("asks"), "lookup", timeout_padding=Duration(seconds=10))
    yield client
    client.destroy()


def test_a_remote_lookup(buffer, client, stamped):
    for second in (1, 2):
        buffer.set_transform(stamped(x=float(second), stamp_s=second), "me")
    assert client.lookup_transform(
        "world", "robot", Time(seconds=1), LONG
    ) == buffer.lookup_transform("world", "robot", Time(seconds=1))
    assert (
        client.lookup_transform_full(
            "robot", Time(seconds=2), "robot", Time(seconds=1), "world", LONG
        ).transform.translation.x
        == -1.0
    )
    assert client.can_transform("world", "robot", Time(), LONG) is True
    assert (
        client.can_transform_full("robot", Time(seconds=2), "robot", Time(seconds=1), "world", LONG)
        is True
    )


def test_a_remote_lookup_waits_for_data(buffer, client, stamped):
    threading.Timer(0.1, lambda: buffer.set_transform(stamped(x=3.0), "me")).start()
    assert client.lookup_transform("world", "robot", Time(), LONG).transform.translation.x == 3.0


def test_errors_come_as_they_were_raised(buffer, client, stamped):
    buffer.set_transform(stamped(stamp_s=1), "me")
    buffer.set_transform(stamped("map", "other", stamp_s=1), "me")
    for kind, arguments in (
        (LookupException, ("nowhere", "robot", Time())),
        (ConnectivityException, ("map", "robot", Time())),
        (ExtrapolationException, ("world", "robot", Time(seconds=5))),
        (InvalidArgumentException, ("/world", "robot", Time())),
    ):
        with pytest.raises(kind) as remote:
            client.lookup_transform(*arguments, Duration(seconds=0.1))
        with pytest.raises(kind) as local:
            buffer.lookup_transform(*arguments)
        assert str(remote.value) == str(local.value)
        assert client.can_transform(*arguments, Duration(seconds=0.01)) is False


def test_a_remote_timeout_is_an_error_and_no_empty_transform(buffer, client):
    started = time.monotonic()
    with pytest.raises(LookupException):
        client.lookup_transform("world", "robot", Time(), Duration(seconds=0.2))
    assert time.monotonic() - started >= 0.2


def test_many_wait_at_once(buffer, make_node, stamped):
    clients = [BufferClient(make_node(f"asks{number}"), "lookup") for number in range(5)]
    results = {}

    def ask(number):
        results[number] = (
            clients[number].lookup_transform("world", f"robot{number}", Time(), LONG).child_frame_id
        )

    threads = [threading.Thread(target=ask, args=[number]) for number in range(5)]
    for thread in threads:
        thread.start()
    for number in (3, 1, 4, 0, 2):
        buffer.set_transform(stamped(child=f"robot{number}"), "me")
    for thread in threads:
        thread.join(60)
    assert results == {number: f"robot{number}" for number in range(5)}
    for client in clients:
        client.destroy()


def test_a_callback_of_the_user_s_node_may_ask(spin_until, buffer, make_node, stamped):
    node = make_node("user")
    client = BufferClient(node, "lookup")
    buffer.set_transform(stamped(x=4.0), "me")
    results = []
    node.create_timer(
        0.001, lambda: results.append(client.lookup_transform("world", "robot", Time(), LONG))
    )
    spin_until(node, lambda: results)
    assert results[0].transform.translation.x == 4.0
    client.destroy()


def test_without_a_server(client):
    with pytest.raises(TimeoutException, match=r"^The BufferServer is not ready\.$"):
        client.lookup_transform("world", "robot", Time())
    assert client.can_transform("world", "robot", Time()) is False


def test_a_goal_that_waits_can_be_cancelled(spin_until, buffer, make_node):
    node = make_node("cancels")
    action = ActionClient(node, LookupTransform, "lookup")
    assert action.wait_for_server(60)
    goal = LookupTransform.Goal(
        target_frame="world", source_frame="robot", timeout=Duration(seconds=60).to_msg()
    )
    sent = action.send_goal_async(goal)
    spin_until(node, sent.done)
    result = sent.result().get_result_async()
    sent.result().cancel_goal_async()
    spin_until(node, result.done)
    assert result.result().status == 5  # canceled
    assert buffer._futures._waiting == []


def test_a_goal_can_be_cancelled_before_it_is_executed(spin_until, make_node):
    node, accepted = make_node("both"), []
    server = BufferServer(Buffer(), node, "lookup")
    server._server.register_handle_accepted_callback(accepted.append)
    action = ActionClient(node, LookupTransform, "lookup")
    assert action.wait_for_server(60)
    goal = LookupTransform.Goal(target_frame="world", source_frame="robot", timeout=LONG.to_msg())
    sent = action.send_goal_async(goal)
    spin_until(node, sent.done)
    cancelled = sent.result().cancel_goal_async()
    spin_until(node, cancelled.done)
    assert len(cancelled.result().goals_canceling) == 1
    accepted[0].execute()
    result = sent.result().get_result_async()
    spin_until(node, result.done)
    assert result.result().status == 5  # canceled
    assert result.result().result.error.error_string == "The lookup was cancelled."
    server.destroy()


@pytest.fixture
def strange_server(make_node, spun):
    """A server that behaves otherwise."""
    servers = []

    def serve(execute, **callbacks):
        node = make_node("strange")
        servers.append(ActionServer(node, LookupTransform, "lookup", execute, **callbacks))
        spun(node)

    yield serve
    for server in servers:
        server.destroy()


def test_a_server_that_aborts_without_a_reason_means_a_timeout(client, strange_server):
    def execute(goal_handle):
        goal_handle.abort()
        return LookupTransform.Result()

    strange_server(execute)
    with pytest.raises(TimeoutException):
        client.lookup_transform("world", "robot", Time(), LONG)


def test_a_server_that_rejects(client, strange_server):
    strange_server(
        lambda _goal: LookupTransform.Result(), goal_callback=lambda _request: GoalResponse.REJECT
    )
    with pytest.raises(TimeoutException, match="did not come back with accepted status"):
        client.lookup_transform("world", "robot", Time(), LONG)


def test_a_server_that_does_not_answer(make_node, strange_server):
    release = threading.Event()

    def execute(goal_handle):
        release.wait(60)
        goal_handle.succeed()
        return LookupTransform.Result()

    strange_server(execute)
    client = BufferClient(make_node("impatient"), "lookup", timeout_padding=0.1)
    client.action_client.wait_for_server(60)
    with pytest.raises(TimeoutException, match="did not come back in the specified time"):
        client.lookup_transform("world", "robot", Time(), Duration(seconds=0.1))
    release.set()
    client.destroy()


def test_abandoned_lookups_are_cancelled(make_node, strange_server):
    cancelled = Future()

    async def execute(goal_handle):
        await cancelled
        goal_handle.canceled()
        return LookupTransform.Result()

    def cancel(_goal):
        cancelled.set_result(None)
        return CancelResponse.ACCEPT

    strange_server(execute, cancel_callback=cancel)
    over = threading.Event()
    cancelled.add_done_callback(lambda _future: over.set())
    client = BufferClient(
        make_node("impatient"), "lookup", timeout_padding=3.0
    )  # time for a busy machine to accept the goal
    client.action_client.wait_for_server(60)
    with pytest.raises(TimeoutException, match="did not come back in the specified time"):
        client.lookup_transform("world", "robot", Time(), Duration(seconds=0.1))
    assert over.wait(60)
    client.destroy()


def test_times_must_be_times(buffer, client, stamped):
    buffer.set_transform(stamped(), "me")
    with pytest.raises(TypeError, match=r"^Must pass a rclpy\.time\.Time object\.$"):
        client.lookup_transform("world", "robot", 3.0)
    with pytest.warns(UserWarning, match=r"rclpy\.time\.Time"):
        client.lookup_transform("world", "robot", Time().to_msg(), LONG)


def test_a_time_message_is_refused_in_lyrical(client, monkeypatch):
    monkeypatch.setenv("ROS_DISTRO", "lyrical")
    with pytest.raises(TypeError, match=r"^Must pass a rclpy\.time\.Time object\.$"):
        client.lookup_transform("world", "robot", Time().to_msg(), LONG)


def test_the_numbers_of_the_errors():
    for number in range(1, 7):
        error = exception_for(TF2Error(error=number, error_string="text"))
        assert isinstance(error, TransformException)
        assert str(error) == "text"
        assert error_number(error) == number
    assert type(exception_for(TF2Error(error=77, error_string="text"))) is TransformException


def test_the_client_ends_with_its_context(context, make_node):
    client = BufferClient(make_node("short"), "lookup")
    context.shutdown()
    client._thread.join(60)
    assert not client._thread.is_alive()
    client.destroy()
