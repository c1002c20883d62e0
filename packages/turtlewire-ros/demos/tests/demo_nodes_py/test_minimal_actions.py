"""The minimal action servers that defer, queue or abort goals, and clients of other styles."""

from __future__ import annotations

import signal
import sys
import threading
from contextlib import contextmanager
from types import SimpleNamespace

import pytest
from tests.places import ROS2

import rclpy
from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from examples_rclpy_minimal_action_server import (
    server_defer,
    server_queue_goals,
    server_single_goal,
)
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor

HURRIED = """
import time
time.sleep = lambda _: None  # the server waits a second before each number
from examples_rclpy_minimal_action_server.server import main
main()
"""


class Rig:
    """A server of an example's module whose timers and sleeps wait for `go`, and its client."""

    def __init__(self, module, monkeypatch) -> None:
        self.go = threading.Event()
        self.handled = threading.Semaphore(0)
        self.handles = []
        self.executing = []
        rig = self

        class Server(module.MinimalActionServer):
            def handle_accepted_callback(self, goal_handle) -> None:
                rig.handles.append(goal_handle)
                super().handle_accepted_callback(goal_handle)
                rig.handled.release()

            def create_timer(self, _seconds, callback):
                return super().create_timer(0.01, lambda: rig.go.wait(60) and callback())

        monkeypatch.setattr(module, "time", SimpleNamespace(sleep=self.sleep))
        self.server = Server()
        self.client = ActionClient(self.server, Fibonacci, "fibonacci")

    def sleep(self, _seconds) -> None:
        """Count the goals that are executing, and wait."""
        executing = GoalStatus.STATUS_EXECUTING
        self.executing.append(sum(handle.status == executing for handle in self.handles))
        assert self.go.wait(60)

    def send(self, order):
        """Send a goal; returns once the server has handled it."""
        assert self.client.wait_for_server(60)
        goal = outcome(self.client.send_goal_async(Fibonacci.Goal(order=order)))
        assert goal.accepted
        assert self.handled.acquire(timeout=60)
        return goal.get_result_async()


def outcome(future):
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    assert done.wait(60)
    return future.result()


@contextmanager
def serving(rig):
    def spin() -> None:
        try:
            executor.spin()
        except ExternalShutdownException:
            return

    executor = MultiThreadedExecutor(4)
    executor.add_node(rig.server)
    thread = threading.Thread(target=spin)
    thread.start()
    try:
        yield
    finally:
        rig.go.set()
        rclpy.shutdown()
        thread.join()


@pytest.fixture
def rig_of(monkeypatch):
    """Serves a module's action server on four threads."""

    @contextmanager
    def rig_of(module):
        with rclpy.init():
            rig = Rig(module, monkeypatch)
            with serving(rig):
                yield rig

    return rig_of


def test_a_deferred_goal_is_accepted_first_and_executed_later(rig_of):
    with rig_of(server_defer) as rig:
        answer = rig.send(4)
        assert rig.handles[0].status == GoalStatus.STATUS_ACCEPTED
        rig.go.set()
        assert list(outcome(answer).result.sequence) == [0, 1, 1, 2, 3]


def test_queued_goals_are_executed_one_after_the_other(rig_of):
    with rig_of(server_queue_goals) as rig:
        answers = [rig.send(order) for order in (3, 4, 2)]
        rig.go.set()
        sequences = [list(outcome(answer).result.sequence) for answer in answers]
        assert sequences == [[0, 1, 1, 2], [0, 1, 1, 2, 3], [0, 1, 1]]
        assert set(rig.executing) == {1}


def test_a_new_goal_aborts_the_single_goal(rig_of):
    with rig_of(server_single_goal) as rig:
        first, second = rig.send(10), rig.send(3)
        rig.go.set()
        assert outcome(first).status == GoalStatus.STATUS_ABORTED
        assert outcome(second).status == GoalStatus.STATUS_SUCCEEDED
        assert list(outcome(second).result.sequence) == [0, 1, 1, 2]


@pytest.fixture
def start(run):
    """Starts executables of the examples' actions, each in its own process."""

    def start(kind: str, executable: str):
        return run(ROS2, "run", f"examples_rclpy_minimal_action_{kind}", executable)

    return start


def end(program) -> None:
    program.signal_group(signal.SIGINT)
    assert program.wait() == 0
    assert "Traceback" not in program.text


def test_results_in_asyncio_and_in_one_function(start, run):
    server = run(sys.executable, "-c", HURRIED)
    asyncio_client, function = (
        start("client", "client_asyncio"),
        start("client", "client_not_composable"),
    )
    short, long = r"\[0, 1, 1, 2, 3, 5\]", r"\[0, 1, 1, 2, 3, 5, 8, 13, 21, 34, 55\]"
    asyncio_client.wait_for(rf"Result: array\('i', {short}\), status: 4$", count=2)
    asyncio_client.wait_for(rf"Result: array\('i', {long}\), status: 4$")
    function.wait_for(rf"Goal succeeded! Result: array\('i', {long}\)$")
    for program in (asyncio_client, function):
        assert program.wait() == 0
        assert "Traceback" not in program.text
    end(server)


@pytest.mark.parametrize("executable", ["server", "server_not_composable"])
def test_ctrl_c_in_the_middle_of_a_goal_is_one_line(start, run, executable):
    server = start("server", executable)
    client = start("client", "client_not_composable")
    server.wait_for(r"Publishing feedback: ", count=2)
    end(server)
    (line,) = [text for text in server.text.splitlines() if "[WARN]" in text or "[ERROR]" in text]
    assert "Goal not finished: the context was shut down. Goal ID: [" in line
    client.signal_group(signal.SIGINT)
    client.wait()


def test_a_server_of_functions_and_ctrl_c_in_asyncio(start):
    server = start("server", "server_not_composable")
    client = start("client", "client_asyncio")
    client.wait_for(r"\[minimal_action_client_asyncio\]: Received feedback: ")
    end(client)
    cancelling = start("client", "client_cancel")
    cancelling.wait_for(r"\[minimal_action_client\]: Goal successfully canceled$")
    assert cancelling.wait() == 0
    server.wait_for(r"\[minimal_action_server\]: Goal canceled$")
    end(server)


@pytest.mark.parametrize("executable", ["client", "client_asyncio", "client_not_composable"])
def test_ctrl_c_while_there_is_no_server(start, executable):
    client = start("client", executable)
    client.wait_for("Waiting for action server...$")
    end(client)
    assert "Sending goal request..." not in client.text
