"""Cost of a TransformListener, and the delay of the answer to a waiting lookup.

The publisher is another process at 1 kHz.

The cost is the CPU time of the whole receiving process for each message. The wait ends with the
return of the lookup and begins with the stamp of the transform, before the publisher makes a
message of it.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any

from benchmarks.figures import Figure, Row, on_loopback, printed

TITLE = "TransformListener at 1 kHz: CPU per message, waiting lookups"
RATE_HZ = 1000
SECONDS = 2.0
ROUNDS = 3
WAITS = 2000
WAYS = {
    "listener": "tf2_ros.TransformListener",
    "callback": "a subscription that decodes and stores, spun",
}


def rows() -> Iterator[Row]:
    environment = on_loopback(101)
    for count, budget in (
        (1, "<= 48 us (1/6 of rclpy's 289 us)"),
        (20, "<= 53 us (1/12 of rclpy's 645 us)"),
    ):
        with subprocess.Popen(
            [sys.executable, "-m", __name__, "publish", str(count), str(RATE_HZ)],
            env=environment,
        ) as publisher:
            try:
                figures = {way: Figure.of(run(way, environment)) for way in WAYS}
                p50, p99 = run("wait", environment)
            finally:
                publisher.terminate()
        yield Row(
            f"{count} transform(s) in a message",
            figures["listener"],
            {WAYS["callback"]: figures["callback"]},
            budget,
        )
        yield Row(
            f"{count} transform(s): stamp to a waiting lookup's return, p50 / p99", Figure(p50, p99)
        )


def run(way: str, environment: dict[str, str], rate_hz: int = RATE_HZ) -> list[float]:
    return printed([sys.executable, "-m", __name__, way, str(rate_hz)], environment)


def publish(count: int, rate_hz: int) -> None:
    from turtlewire import msg, wire
    from turtlewire.tf.listener import QOS, TOPIC, TYPE_NAME
    from turtlewire.wire.base import TypeId

    context = wire.open_context()
    publisher = context.create_node("publisher").create_publisher(
        TOPIC, TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME)), QOS
    )
    transforms = [
        msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=f"frame{i}")
        for i in range(count)
    ]
    message = msg.get_message(TYPE_NAME)(transforms=transforms)
    due = time.monotonic()
    while True:
        for transform in transforms:
            transform.header.frame_id = "world"
            transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(
                time.time_ns(), 1_000_000_000
            )
        publisher.publish(msg.serialize(message))
        due += 1.0 / rate_hz
        time.sleep(max(0.0, due - time.monotonic()))


def receive(way: str, rate_hz: int) -> None:
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.node import Node
    from rclpy.time import Time
    from tf2_msgs.msg import TFMessage
    from tf2_ros import Buffer, TransformListener

    rclpy.init(args=[])
    node, buffer = Node("receiver"), Buffer()
    executor = SingleThreadedExecutor()
    if way == "listener":
        TransformListener(buffer, node)
        wait = time.sleep
    else:
        listener = TransformListener(buffer, node, tf_topic="/nothing")
        node.create_subscription(TFMessage, "/tf", listener.callback, 100)
        executor.add_node(node)

        def wait(seconds: float) -> None:
            end = time.monotonic() + seconds
            while time.monotonic() < end:
                executor.spin_once(timeout_sec=end - time.monotonic())

    while not buffer.can_transform("world", "frame0", Time()):
        wait(0.5)
    runs = []
    for _ in range(ROUNDS):
        first = newest_ns(buffer)
        cpu = time.process_time()
        wait(SECONDS)
        cpu = time.process_time() - cpu
        runs.append(cpu * 1e9 / max(1.0, (newest_ns(buffer) - first) * 1e-9 * rate_hz))
    print(json.dumps(runs))
    rclpy.shutdown()


def wait() -> None:
    from turtlewire import Buffer
    from turtlewire.tf.listener import TransformListener

    buffer = Buffer()
    with TransformListener(buffer):
        buffer.lookup_transform("world", "frame0", None, timeout_ns=10_000_000_000)
        waits = []
        for _ in range(WAITS):
            between = buffer._latest_common_time("world", "frame0") + 500_000_000 // RATE_HZ
            buffer.lookup_transform("world", "frame0", between, timeout_ns=10_000_000_000)
            waits.append(time.time_ns() - buffer._latest_common_time("world", "frame0"))
    waits.sort()
    print(json.dumps([waits[WAITS // 2], waits[WAITS * 99 // 100]]))


def newest_ns(buffer: Any) -> int:
    return buffer.engine._latest_common_time("world", "frame0")


if __name__ == "__main__":
    if sys.argv[1] == "publish":
        publish(int(sys.argv[2]), int(sys.argv[3]))
    elif sys.argv[1] == "wait":
        wait()
    else:
        receive(sys.argv[1], int(sys.argv[2]))
