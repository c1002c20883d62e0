"""Goals and short messages that get through rclpy between two processes.

The budgets are 1.2 times the rate of the real rclpy, which was measured beside commit 16a1ae2 of
this repository: that commit served 0.79 times as many goals and published 0.85 times as many
strings. `benchmarks.real` compares larger messages, latencies and services directly.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from collections.abc import Iterator
from typing import Any

from benchmarks.figures import Figure, Row, on_loopback, printed_by_pair
from benchmarks.rivals.rclpy_programs import make_node, spin_until_stdin_closes

TITLE = "rclpy: throughput between two processes"
ROUNDS = 5
GOALS, GOALS_AT_ONCE = 300, 8
STRINGS = 100_000
BUDGETS = {
    "goals": ">= 1.58x commit 16a1ae2 (1.2x rclpy)",
    "strings": ">= 1.41x commit 16a1ae2 (1.2x rclpy)",
}


def rows() -> Iterator[Row]:
    for what, budget in BUDGETS.items():
        runs = [measure(what) for _ in range(ROUNDS)]
        rates = [run["rate"] for run in runs]
        best = Figure(max(rates), statistics.median(rates), "/s")
        yield Row(f"{what} each second (best / median)", best, {}, budget)
        yield Row(
            f"{what}: CPU of the {'server' if what == 'goals' else 'sender'} for each",
            Figure.of([run["cpu"] for run in runs]),
        )


def measure(what: str) -> dict[str, float]:
    """Let one process serve and the other one ask; figures of both."""
    program = [sys.executable, "-m", __name__, what]
    return printed_by_pair(program, "serve", "ask", on_loopback(104))


def goals_serve() -> None:
    from example_interfaces.action import Fibonacci
    from rclpy.action import ActionServer

    node = make_node("server")
    begin: list[float] = []

    def execute(goal_handle: Any) -> Any:
        begin.append(time.process_time())
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=[0, 1, 1]))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=[0, 1, 1, 2])

    server = ActionServer(node, Fibonacci, "fibonacci", execute)
    spin_until_stdin_closes(node)
    cpu = (time.process_time() - begin[0]) / (len(begin) - 1)
    print(json.dumps({"cpu": cpu * 1e9}))
    server.destroy()


def ignore(_feedback: Any) -> None:
    """Feedback is counted as work of the server, not read."""


def goals_ask() -> None:
    import rclpy
    from example_interfaces.action import Fibonacci
    from rclpy.action import ActionClient

    node = make_node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    client.wait_for_server()
    done = rclpy.task.Future()
    left, finished = [GOALS], [0]

    def send() -> None:
        if left[0]:
            left[0] -= 1
            goal = client.send_goal_async(Fibonacci.Goal(order=4), ignore)
            goal.add_done_callback(on_accepted)

    def on_accepted(future: Any) -> None:
        future.result().get_result_async().add_done_callback(on_finished)

    def on_finished(future: Any) -> None:
        assert future.result().status == 4
        finished[0] += 1
        send()
        if finished[0] == GOALS:
            done.set_result(None)

    begin = time.perf_counter()
    for _ in range(GOALS_AT_ONCE):
        send()
    rclpy.spin_until_future_complete(node, done)
    print(json.dumps({"rate": GOALS / (time.perf_counter() - begin)}))
    rclpy.shutdown()


def strings_serve() -> None:
    """Count what arrives."""
    from std_msgs.msg import String

    node = make_node("receiver")
    moments: list[float] = []
    node.create_subscription(String, "flood", lambda _: moments.append(time.perf_counter()), 10)
    spin_until_stdin_closes(node)
    print(json.dumps({"received": len(moments) / (moments[-1] - moments[0])}))


def strings_ask() -> None:
    """Publish one message as fast as it goes, once a subscription is there."""
    import rclpy
    from std_msgs.msg import String

    message = String(data="Hello World: 12345")
    node = make_node("sender")
    publisher = node.create_publisher(String, "flood", 10)
    node.context.wait_for_graph(lambda: publisher.get_subscription_count() > 0, None)
    for _ in range(STRINGS // 10):
        publisher.publish(message)
    cpu, begin = time.process_time(), time.perf_counter()
    for _ in range(STRINGS):
        publisher.publish(message)
    took, cpu = time.perf_counter() - begin, time.process_time() - cpu
    print(json.dumps({"rate": STRINGS / took, "cpu": cpu / STRINGS * 1e9}))
    rclpy.shutdown()


if __name__ == "__main__":
    globals()["_".join(sys.argv[1:])]()
