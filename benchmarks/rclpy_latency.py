"""From publish() to the callback, two processes on loopback at 1 kHz, against the same messages on
the bare wire.
"""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any

from benchmarks.figures import Figure, Row, on_loopback

TITLE = "rclpy: publish to callback, two processes, std_msgs/String at 1 kHz"
TOPIC, TYPE_NAME = "/latency", "std_msgs/msg/String"
PERIOD_S = 0.001
MESSAGES, ROUNDS, WARM_UP = 1500, 4, 300


def rows() -> Iterator[Row]:
    runs: dict[str, list[dict[str, float]]] = {"rclpy": [], "wire": []}
    for _ in range(ROUNDS):
        for way, figures in runs.items():
            figures.append(measure(way))
    budgets = {
        "p50": "<= 118 us (rclpy, quiet machine), <= 2x the wire",
        "p99": "<= 260 us (rclpy, quiet machine)",
        "cpu": "253 us (bare rclpy subscription)",
    }
    for what, budget in budgets.items():
        ours, wire = (Figure.of([run[what] for run in runs[way]]) for way in ("rclpy", "wire"))
        yield Row(
            {"cpu": "CPU of the receiver for each message"}.get(what, what),
            ours,
            {"bare wire": wire},
            budget,
        )


def measure(way: str) -> dict[str, float]:
    environment = on_loopback(102)
    command = [sys.executable, "-m", __name__]
    with (
        subprocess.Popen(
            [*command, f"{way}_receive"], env=environment, stdout=subprocess.PIPE, text=True
        ) as receiver,
        subprocess.Popen([*command, f"{way}_send"], env=environment) as sender,
    ):
        output, _ = receiver.communicate(timeout=60)
        sender.terminate()
    return json.loads(output)


class Record:
    """Latencies in nanoseconds; the text of a message is the moment at which it was sent."""

    def __init__(self) -> None:
        self.latencies: list[int] = []
        self.cpu = 0.0

    def add(self, sent: str) -> bool:
        """Return True if there are enough."""
        self.latencies.append(time.perf_counter_ns() - int(sent))
        if len(self.latencies) == WARM_UP:
            self.cpu = time.process_time()
        return len(self.latencies) >= WARM_UP + MESSAGES

    def report(self) -> None:
        cpu = (time.process_time() - self.cpu) * 1e9 / MESSAGES
        ranked = sorted(self.latencies[WARM_UP:])
        print(
            json.dumps(
                {"p50": ranked[MESSAGES // 2], "p99": ranked[MESSAGES * 99 // 100], "cpu": cpu}
            )
        )


def rclpy_send() -> None:
    import rclpy
    from benchmarks.rivals.rclpy_programs import make_node
    from std_msgs.msg import String

    node = make_node("sender")
    publisher = node.create_publisher(String, TOPIC, 10)
    node.create_timer(PERIOD_S, lambda: publisher.publish(String(data=str(time.perf_counter_ns()))))
    with contextlib.suppress(
        rclpy.executors.ExternalShutdownException
    ):  # terminated when the receiver has enough
        rclpy.spin(node)


def rclpy_receive() -> None:
    import rclpy
    from benchmarks.rivals.rclpy_programs import make_node
    from std_msgs.msg import String

    node, record, done = make_node("receiver"), Record(), rclpy.task.Future()
    node.create_subscription(
        String, TOPIC, lambda message: record.add(message.data) and done.set_result(None), 10
    )
    rclpy.spin_until_future_complete(node, done)
    record.report()
    rclpy.shutdown()


def wire_node(name: str) -> tuple[Any, Any, Any]:
    from turtlewire import msg, wire
    from turtlewire.wire.base import TypeId

    context = wire.open_context()
    return context, context.create_node(name), TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))


def wire_send() -> None:
    from turtlewire.wire.qos import QoS

    _, node, type_id = wire_node("sender")
    publisher = node.create_publisher(TOPIC, type_id, QoS())
    due = time.monotonic()
    while True:
        text = str(time.perf_counter_ns()).encode() + b"\0"
        publisher.publish(b"\0\1\0\0" + len(text).to_bytes(4, "little") + text)
        due += PERIOD_S
        time.sleep(max(0.0, due - time.monotonic()))


def wire_receive() -> None:
    from turtlewire.wire.qos import QoS

    context, node, type_id = wire_node("receiver")
    subscription = node.create_subscription(TOPIC, type_id, QoS())
    wait_set = context.create_wait_set()
    wait_set.attach(subscription)
    record, enough = Record(), False
    while not enough:
        wait_set.wait()
        for data, _ in subscription.take():
            enough = record.add(data[8:].rstrip(b"\0").decode()) or enough
    record.report()
    context.close()


if __name__ == "__main__":
    globals()[sys.argv[1]]()
