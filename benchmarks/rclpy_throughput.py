"""Goals and short messages that get through rclpy between two processes.

The budgets are 1.2 times the rate of the real rclpy, which was measured beside commit 16a1ae2 of
this repository: that commit served 0.79 times as many goals and published 0.85 times as many
strings. `benchmarks.real` compares larger messages, latencies and services directly.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

from benchmarks.figures import Figure, Row

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
        rates = _figure([run["rate"] for run in runs], "/s", max)
        yield Row(f"{what} each second (best / median)", rates, {}, budget)
        yield Row(
            f"{what}: CPU of the {'server' if what == 'goals' else 'sender'} for each",
            _figure([run["cpu"] for run in runs]),
        )


def _figure(
    values: list[float], unit: str = "ns", best: Callable[[list[float]], float] = min
) -> Figure:
    return Figure(best(values), statistics.median(values), unit)


def measure(what: str) -> dict[str, float]:
    """Let one process serve and the other one ask; figures of both."""
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": "104",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    command = [sys.executable, "-m", __name__, what]
    with (
        subprocess.Popen(
            [*command, "serve"],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as server,
        subprocess.Popen(
            [*command, "ask"], env=environment, stdout=subprocess.PIPE, text=True
        ) as asker,
    ):
        try:
            asked, _ = asker.communicate(timeout=120)
            served, _ = server.communicate("", timeout=60)
        finally:  # of one that waits for the other, which failed
            asker.kill()
            server.kill()
    return {**json.loads(asked), **json.loads(served)}


def spinning(node: Any) -> None:
    """Spin a node until the other process has enough, which closes this one's stdin."""
    import rclpy

    def wait_for_the_end() -> None:
        sys.stdin.read()
        rclpy.try_shutdown()

    threading.Thread(target=wait_for_the_end, daemon=True).start()
    try:
        rclpy.spin(node)
    except rclpy.executors.ExternalShutdownException:
        return


def make_node(name: str) -> Any:
    import rclpy

    rclpy.init(args=[])
    return rclpy.create_node(name)


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
    spinning(node)
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
    spinning(node)
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
