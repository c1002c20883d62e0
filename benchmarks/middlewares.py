"""Zenoh compared with Cyclone: the same programs alternate on one host, without a router."""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from benchmarks import crowd, tf_listener
from benchmarks.figures import Figure, Row, on_loopback, printed_by_pair
from benchmarks.rivals.rclpy_programs import LOSSLESS, make_node

TITLE = "Zenoh (ours) compared with Cyclone"
ROUNDS = 3
MIDDLEWARES = {"Zenoh": "rmw_zenoh_cpp", "Cyclone": "rmw_cyclonedds_cpp"}
ENVIRONMENT = on_loopback(103)
PROGRAM = [sys.executable, "-m", __name__]
PERIOD_S = 0.001
PINGS, WARM_UP = 1500, 300
BLOCKS, BLOCK_SIZE = 300, 1_000_000
#: How many transforms a message has, and how many messages a second.
STREAMS = ((20, 1000), (1000, 50))
CROWD = 50

ROUND_TRIP = {
    "p50": "round trip of a String at 1 kHz, p50",
    "p99": "the same, p99",
    "cpu": "CPU of the process that answers, for each message received and sent",
}
THROUGHPUT = {
    "seconds": "1 MB, reliable and nothing lost: seconds for each message",
    "receiver": "the same, CPU of the receiver for each message",
    "sender": "the same, CPU of the sender for each message",
}


def rows() -> Iterator[Row]:
    yield from compare(ROUND_TRIP, round_trip)
    yield from compare(THROUGHPUT, throughput)
    for count, rate in STREAMS:
        what = f"TransformListener's CPU for each message of {count} at {rate} Hz"
        yield from compare(
            {"cpu": what}, lambda of, count=count, rate=rate: listen(of, count, rate)
        )
    everybody = f"{CROWD} processes started at once: from the last start until all see all"
    yield from compare({"seconds": everybody}, know_each_other, "Zenoh <= 4 s")


def compare(
    titles: dict[str, str],
    measure: Callable[[dict[str, str]], dict[str, float]],
    budget: str = "",
) -> Iterator[Row]:
    """A row for each figure that ``measure`` returns, in ns, when it has run with both."""
    runs: dict[str, list[dict[str, float]]] = {name: [] for name in MIDDLEWARES}
    for _ in range(ROUNDS):
        for name, middleware in MIDDLEWARES.items():
            runs[name].append(measure({**ENVIRONMENT, "RMW_IMPLEMENTATION": middleware}))
    for what, title in titles.items():
        ours, cyclone = ([run[what] for run in runs[name]] for name in MIDDLEWARES)
        yield Row(title, Figure.of(ours), {"Cyclone": Figure.of(cyclone)}, budget)


def round_trip(environment: dict[str, str]) -> dict[str, float]:
    return printed_by_pair(PROGRAM, "answer", "ask", environment)


def throughput(environment: dict[str, str]) -> dict[str, float]:
    return printed_by_pair(PROGRAM, "receive", "send", environment)


def listen(environment: dict[str, str], count: int, rate: int) -> dict[str, float]:
    with subprocess.Popen(
        [sys.executable, "-m", tf_listener.__name__, "publish", str(count), str(rate)],
        env=environment,
    ) as publisher:
        try:
            runs = tf_listener.run("listener", environment, rate)
        finally:
            publisher.terminate()
    return {"cpu": statistics.median(runs)}


def know_each_other(environment: dict[str, str]) -> dict[str, float]:
    seconds, _ = crowd.start(CROWD, float("inf"), environment)
    return {"seconds": seconds * 1e9}


def finish(done: Any) -> None:
    """End spinning from a callback."""
    if not done.done():
        done.set_result(None)


def answer() -> None:
    """Send each String back, and tell the CPU of it."""
    import rclpy
    from std_msgs.msg import String

    node, done = make_node("answerer"), rclpy.task.Future()
    publisher = node.create_publisher(String, "/pong", 10)
    cpu: list[float] = []

    def on_ping(message: Any) -> None:
        cpu.append(time.process_time())
        publisher.publish(message)
        if message.data == "end":
            finish(done)

    node.create_subscription(String, "/ping", on_ping, 10)
    rclpy.spin_until_future_complete(node, done)
    counted = cpu[WARM_UP:]
    print(json.dumps({"cpu": (counted[-1] - counted[0]) * 1e9 / (len(counted) - 1)}))
    rclpy.shutdown()


def ask() -> None:
    """Send a String a millisecond, and tell how long each takes to come back."""
    import rclpy
    from std_msgs.msg import String

    node, done = make_node("asker"), rclpy.task.Future()
    publisher = node.create_publisher(String, "/ping", 10)
    times: list[int] = []

    def on_pong(message: Any) -> None:
        if message.data == "end":
            finish(done)
        else:
            times.append(time.perf_counter_ns() - int(message.data))

    def send() -> None:
        enough = len(times) >= WARM_UP + PINGS
        publisher.publish(String(data="end" if enough else str(time.perf_counter_ns())))

    node.create_subscription(String, "/pong", on_pong, 10)
    node.create_timer(PERIOD_S, send)
    rclpy.spin_until_future_complete(node, done)
    ranked = sorted(times[WARM_UP : WARM_UP + PINGS])
    print(json.dumps({"p50": ranked[PINGS // 2], "p99": ranked[PINGS * 99 // 100]}))
    rclpy.shutdown()


def receive() -> None:
    """Take blocks, and tell how long each took."""
    import rclpy
    from std_msgs.msg import UInt8MultiArray

    node, done = make_node("receiver"), rclpy.task.Future()
    moments: list[tuple[float, float]] = []

    def on_block(_: Any) -> None:
        moments.append((time.perf_counter(), time.process_time()))
        if len(moments) == BLOCKS:
            finish(done)

    node.create_subscription(UInt8MultiArray, "/blocks", on_block, LOSSLESS)
    rclpy.spin_until_future_complete(node, done)
    (begin, cpu_before), (end, cpu_after) = moments[BLOCKS // 10], moments[-1]
    count = len(moments) - BLOCKS // 10 - 1
    print(
        json.dumps(
            {
                "seconds": (end - begin) * 1e9 / count,
                "receiver": (cpu_after - cpu_before) * 1e9 / count,
            }
        )
    )
    rclpy.shutdown()


def send() -> None:
    """Publish blocks, and tell the CPU of each."""
    import rclpy
    from std_msgs.msg import UInt8MultiArray

    node = make_node("sender")
    publisher = node.create_publisher(UInt8MultiArray, "/blocks", LOSSLESS)
    node.context.wait_for_graph(lambda: publisher.get_subscription_count() > 0, None)
    block = UInt8MultiArray(data=bytes(BLOCK_SIZE))
    cpu = time.process_time()
    for _ in range(BLOCKS):
        publisher.publish(block)
    print(json.dumps({"sender": (time.process_time() - cpu) * 1e9 / BLOCKS}), flush=True)
    # The receiver ends when it has all of them.
    node.context.wait_for_graph(lambda: publisher.get_subscription_count() == 0, None)
    rclpy.shutdown()


if __name__ == "__main__":
    {"answer": answer, "ask": ask, "receive": receive, "send": send}[sys.argv[1]]()
