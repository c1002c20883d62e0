"""Growth of cost with the number of nodes, topics, frames, turtles … and with the length of a bag.

`scripts/bench growth` prints a row for each size and draws all of them into
``build/growth.svg``, with logarithmic axes. Each size runs in its own process.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks import tf_listener, turtles
from benchmarks.figures import Figure, Row, on_loopback, printed
from benchmarks.view_growth import robot, running_view

TITLE = "How cost grows"
ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "build" / "growth.svg"
ROUNDS = 3
SECONDS = 2.0
ENVIRONMENT = on_loopback(104)


class Quantity(NamedTuple):
    """A quantity that grows, and the cost that is measured.

    Attributes:
        what: The cost, for the table and the plot.
        sizes: The numbers of it.
        measure: Returns the cost at a size in nanoseconds, once for each repetition.
    """

    what: str
    sizes: tuple[int, ...]
    measure: Callable[[int], list[float]]


def rows() -> Iterator[Row]:
    measured = {}
    for name, quantity in QUANTITIES.items():
        figures = {size: run(name, size) for size in quantity.sizes}
        measured[quantity.what] = figures
        for size, figure in figures.items():
            yield Row(f"{name}: {size:,}; {quantity.what}", figure)
        yield Row(
            f"{name}: largest exponent between two sizes", exponent(figures), {}, "n log n: about 1"
        )
    PICTURE.parent.mkdir(exist_ok=True)
    PICTURE.write_text(picture(measured))


def run(name: str, size: int) -> Figure:
    command = [sys.executable, "-m", __name__, name, str(size)]
    return Figure.of(printed(command, ENVIRONMENT))


def exponent(figures: dict[int, Figure]) -> Figure:
    """The steepest step of the curve: 1 is linear, 2 is quadratic."""
    steps = [
        math.log(figures[large].minimum / figures[small].minimum) / math.log(large / small)
        for small, large in pairwise(figures)
    ]
    return Figure(max(steps), max(steps), "")


def picture(measured: dict[str, dict[int, Figure]]) -> str:
    """An SVG document: a panel for each quantity, in powers of ten, with a line for n log n."""
    from turtlewire.trajectory.chart import COLOURS, GREY, Panel, page

    width, height = 430.0, 240.0
    panels = []
    for number, (what, figures) in enumerate(measured.items()):
        sizes = np.array(list(figures), dtype=float)
        costs = np.array([figure.minimum for figure in figures.values()])
        limit = sizes * np.log(sizes + 1)
        limit *= costs[0] / limit[0]
        x, y, y_limit = np.log10(sizes), np.log10(costs), np.log10(limit)
        place = (number % 2 * width, number // 2 * height, width, height)
        ends = min(y.min(), y_limit.min()), max(y.max(), y_limit.max())
        panel = Panel(place, (x[0], x[-1]), ends, ("log10 of the number", "log10 ns"), title=what)
        panel.line(x, y_limit, GREY, dashed=True)
        panel.line(x, y, COLOURS[0])
        for a, b in zip(x.tolist(), y.tolist(), strict=True):
            panel.circle(a, b, COLOURS[0])
        panels.append(panel)
    return page(panels, 2 * width, [("measured", COLOURS[0]), ("n log n", GREY)]).svg


def nodes(count: int) -> list[float]:
    """The time in which one process creates nodes and another one knows all of them."""
    from turtlewire import wire

    other = wire.open_context()
    with contextlib.closing(other):
        rclpy = initialised_rclpy()
        start = time.perf_counter_ns()
        made = [rclpy.create_node(f"node_{number}") for number in range(count)]
        seen = other.graph.wait_for(lambda: len(other.graph.nodes()) >= len(made), 60_000_000_000)
        assert seen
        return [time.perf_counter_ns() - start]


def topics(count: int) -> list[float]:
    """The same for the publishers of a node."""
    from std_msgs.msg import String
    from turtlewire import wire

    other = wire.open_context()

    def known() -> int:
        return sum(info.topic.startswith("/topic_") for info in other.graph.endpoints())

    with contextlib.closing(other):
        node = initialised_rclpy().create_node("node")
        start = time.perf_counter_ns()
        for number in range(count):
            node.create_publisher(String, f"/topic_{number}", 10)
        assert other.graph.wait_for(lambda: known() == count, 60_000_000_000)
        return [time.perf_counter_ns() - start]


def subscriptions(count: int) -> list[float]:
    """The time from a message to the callback of one of the subscriptions of an executor."""
    from rclpy.executors import SingleThreadedExecutor
    from std_msgs.msg import String

    node = initialised_rclpy().create_node("node")
    heard: list[Any] = []
    for number in range(count):
        node.create_subscription(String, f"/topic_{number}", heard.append, 10)
    publisher = node.create_publisher(String, "/topic_0", 10)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    costs = []
    for _ in range(300):
        heard.clear()
        start = time.perf_counter_ns()
        publisher.publish(String(data="x"))
        while not heard:
            executor.spin_once()
        costs.append(time.perf_counter_ns() - start)
    return costs[100:]


def frames(count: int) -> list[float]:
    """The time in which a buffer takes a tree of moving frames and answers about each."""
    from turtlewire import Buffer

    names = [f"frame_{number}" for number in range(count + 1)]
    costs = []
    for _ in range(ROUNDS):
        buffer = Buffer(max_frames=None)
        start = time.perf_counter_ns()
        for number in range(1, count + 1):
            buffer.set_transform(names[(number - 1) // 2], names[number], 10**9, (1, 0, 0))
        for number in range(1, count + 1):
            buffer.lookup_transform(names[0], names[number])
        costs.append(time.perf_counter_ns() - start)
    return costs


def listeners(count: int) -> list[float]:
    """CPU of all processes, each with a TransformListener, in a second with 100 messages."""
    program = """
import sys, time, turtlewire
network = turtlewire.connect(sys.argv[1])
transforms = network.transforms()
transforms.lookup_transform("world", "frame0", timeout_ns=60_000_000_000)
print("hears", flush=True)
time.sleep(1e6)
"""
    publish = [sys.executable, "-m", tf_listener.__name__, "publish", "20", "100"]
    sender = subprocess.Popen(publish)
    listening = [
        subprocess.Popen(
            [sys.executable, "-c", program, f"listener_{number}"], stdout=subprocess.PIPE
        )
        for number in range(count)
    ]
    try:
        for each in listening:
            assert each.stdout is not None
            assert each.stdout.readline() == b"hears\n"
        return cpu_each_second([each.pid for each in listening])
    finally:
        for each in (*listening, sender):
            each.kill()
            each.wait()


def cpu_each_second(pids: list[int]) -> list[float]:
    """CPU of processes in a second, of several periods."""
    costs = []
    for _ in range(ROUNDS):
        before = sum(map(cpu_ns, pids))
        time.sleep(SECONDS)  # the period that is measured
        costs.append((sum(map(cpu_ns, pids)) - before) / SECONDS)
    return costs


def cpu_ns(pid: int) -> int:
    """Return the CPU time of all threads of a process."""
    threads = Path(f"/proc/{pid}/task").iterdir()
    return sum(int((thread / "schedstat").read_text().split()[0]) for thread in threads)


def bag(megabytes: int) -> list[float]:
    """The time in which the messages of a bag are read, without decoding them."""
    from turtlewire.bag import Bag, BagWriter

    blob = bytes([0, 1, 0, 0]) + (10_000 - 8).to_bytes(4, "little") + os.urandom(10_000 - 8)
    costs = []
    with tempfile.TemporaryDirectory(dir=ROOT / "build") as folder:
        path = Path(folder) / "bag"
        with BagWriter(path) as writer:
            writer.add_topic("/blob", "std_msgs/msg/String")
            for number in range(megabytes * 100):
                writer.write("/blob", blob, number * 1_000_000)
        for _ in range(ROUNDS):
            start = time.perf_counter_ns()
            count = sum(1 for _ in Bag(path))
            costs.append(time.perf_counter_ns() - start)
            assert count == megabytes * 100
    return costs


def swarm(count: int) -> list[float]:
    """CPU of a tick of the simulator with its swarm."""
    environment = {**ENVIRONMENT, "PYTHONPATH": os.pathsep.join(map(str, turtles.PATH))}
    return [cost * count for cost in turtles.run(str(count), environment)["process"]]


def clients(count: int) -> list[float]:
    """CPU of the server of `turtlewire view` in a second, with pages that show 30 frames."""
    from websockets.sync.client import connect

    def read(page: Any) -> None:
        for _ in page:
            continue

    with running_view() as (url, pid), robot(), contextlib.ExitStack() as stack:
        address = url.replace("http", "ws", 1) + "live"
        for _ in range(count):
            page = stack.enter_context(connect(address, max_size=None))
            page.recv()
            # The server sends less to a page that does not read.
            threading.Thread(target=read, args=(page,), daemon=True).start()
        return cpu_each_second([pid])


def initialised_rclpy() -> Any:
    import rclpy

    rclpy.init(args=[])
    return rclpy


QUANTITIES = {
    "nodes": Quantity(
        "nodes of a process: created, and known to another one", (1, 10, 50, 200), nodes
    ),
    "topics": Quantity("topics: created, and known to others", (1, 10, 100, 1000), topics),
    "subscriptions": Quantity(
        "subscriptions of an executor: a message", (1, 10, 100, 1000), subscriptions
    ),
    "frames": Quantity(
        "frames: a transform and a lookup of each", (10, 100, 1000, 10_000, 100_000), frames
    ),
    "listeners": Quantity("listening processes: CPU for 100 messages", (1, 5, 20, 50), listeners),
    "bag": Quantity("megabytes of a bag: read", (10, 100, 1000, 10_000), bag),
    "turtles": Quantity("turtles: CPU of a tick", (1, 10, 100, 1000, 5000), swarm),
    "clients": Quantity("pages of the 3D view: CPU in a second", (1, 5, 20, 50), clients),
}


if __name__ == "__main__":
    name, size = sys.argv[1], int(sys.argv[2])
    print(json.dumps(QUANTITIES[name].measure(size)), flush=True)
    os._exit(0)  # what was measured need not be taken down one by one
