"""Zenoh: publishing Strings, images in shared memory, queries of the graph.

The floor of publishing is a loop around ``zenoh.Publisher.put`` with the same bytes. Each program
runs with a second process that receives; reliable, with all history, so nothing is lost.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from benchmarks.figures import Figure, Row, on_loopback, printed, printed_by_pair
from benchmarks.rivals import rclpy_programs

TITLE = "Zenoh: publishing, shared memory, the graph"
ROUNDS = 5
ENVIRONMENT = on_loopback(103, RMW_IMPLEMENTATION="rmw_zenoh_cpp")
SHARED_MEMORY = {
    **ENVIRONMENT,
    "ZENOH_CONFIG_OVERRIDE": "transport/shared_memory/enabled=true",
}
IMAGES = [sys.executable, rclpy_programs.__file__]
MESSAGES, TEXT = 20_000, "Hello World: 1234"
CDR = b"\x00\x01\x00\x00" + len(TEXT + "\0").to_bytes(4, "little") + TEXT.encode() + b"\0"
ATTACHMENT = bytes(33)
KEY = "benchmarks/floor"
SESSION = {
    "mode": "peer",
    "listen": {"endpoints": ["tcp/127.0.0.1:0"]},
    "scouting": {"multicast": {"interface": "127.0.0.1"}},
}
#: A node has ten tokens: itself, two publishers and seven services.
NODES, TOKENS = 13, 135
QUERIES = 100


def rows() -> Iterator[Row]:
    own = [sys.executable, "-m", __name__]
    floors, strings, images, queries = [], [], [], []
    for _ in range(ROUNDS):
        floors.append(printed_by_pair(own, "floor_receive", "floor_send", ENVIRONMENT))
        strings.append(printed_by_pair(own, "receive", "send", ENVIRONMENT))
        images.append(printed_by_pair(IMAGES, "images_serve", "images_ask", SHARED_MEMORY))
        queries.append(printed([*own, "graph"], ENVIRONMENT))
    for name, what, budget in (
        ("seconds", "a String, nothing lost: time for each", "<= 16.7 µs (60,000 a second)"),
        ("cpu", "the same, CPU of the publisher", "<= 12 µs"),
    ):
        yield Row(what, figure(strings, name), {}, budget, figure(floors, name))
    image = "an image of 6.2 MB in shared memory, nothing lost: time for each"
    yield Row(image, figure(images, "image"), {}, "<= 1.67 ms (600 a second)")
    yield Row("the same, CPU of the sender", figure(images, "image_cpu"))
    for name in queries[0]:
        yield Row(f"{name}, {TOKENS} tokens", figure(queries, name), {}, "<= 50 µs")


def figure(runs: list[dict[str, float]], name: str) -> Figure:
    return Figure.of([run[name] for run in runs])


def measured(publish: Callable[[], object]) -> None:
    """Print the cost of a message [ns]."""
    for _ in range(MESSAGES // 10):
        publish()
    cpu, begin = time.process_time_ns(), time.perf_counter_ns()
    for _ in range(MESSAGES):
        publish()
    spent = time.perf_counter_ns() - begin
    cpu = time.process_time_ns() - cpu
    print(json.dumps({"seconds": spent / MESSAGES, "cpu": cpu / MESSAGES}), flush=True)


def receive() -> None:
    from std_msgs.msg import String

    node = rclpy_programs.make_node("receiver")
    node.create_subscription(String, "/text", lambda _: None, rclpy_programs.LOSSLESS)
    rclpy_programs.spin_until_stdin_closes(node)


def send() -> None:
    import rclpy
    from std_msgs.msg import String

    node = rclpy_programs.make_node("sender")
    publisher = node.create_publisher(String, "/text", rclpy_programs.LOSSLESS)
    node.context.wait_for_graph(lambda: publisher.get_subscription_count() > 0, None)
    message = String(data=TEXT)
    measured(lambda: publisher.publish(message))
    rclpy.shutdown()


def floor_receive() -> None:
    with session() as opened, opened.declare_subscriber(KEY):
        sys.stdin.read()


def floor_send() -> None:
    import threading

    import zenoh

    matched = threading.Event()
    block = zenoh.CongestionControl.BLOCK
    with (
        session() as opened,
        opened.declare_publisher(KEY, congestion_control=block) as publisher,
        publisher.declare_matching_listener(lambda _: matched.set()),
    ):
        if not publisher.matching_status.matching:
            matched.wait()
        measured(lambda: publisher.put(CDR, attachment=ATTACHMENT))


def graph() -> None:
    """Print what a query takes when nothing has changed since the last one [ns]."""
    import rclpy
    from std_msgs.msg import String

    node = rclpy_programs.make_node("observer")
    others = [rclpy.create_node(f"other_{number}") for number in range(NODES - 1)]
    for number in range(TOKENS - 10 * NODES):
        others[number].create_publisher(String, f"/topic_{number}", 10)
    queries = {
        "names and types of topics": node.get_topic_names_and_types,
        "names of nodes": node.get_node_names,
        "publishers of a topic": lambda: node.get_publishers_info_by_topic("/topic_0"),
        "publishers of a node": lambda: node.get_publisher_names_and_types_by_node("other_0", "/"),
    }
    print(json.dumps({name: time_of(query) for name, query in queries.items()}))
    rclpy.shutdown()


def time_of(query: Callable[[], object]) -> float:
    """The median, because another process may interrupt some [ns]."""
    spent = []
    for _ in range(QUERIES):
        begin = time.perf_counter_ns()
        query()
        spent.append(time.perf_counter_ns() - begin)
    return statistics.median(spent)


def session() -> Any:
    import zenoh

    return zenoh.open(zenoh.Config.from_json5(json.dumps(SESSION)))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
