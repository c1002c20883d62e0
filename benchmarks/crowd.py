"""Many processes on one host, each with one node: how long until everybody sees everybody, and what they weigh."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.figures import Figure, Row

if TYPE_CHECKING:
    from collections.abc import Iterator

TITLE = "A crowd of processes on one host, one node each"
ROUNDS = 3
BUDGET = "<= 3 s"
LIMIT_NS = 200_000_000_000
ENVIRONMENT = {**os.environ, "ROS_DOMAIN_ID": "105", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def rows() -> Iterator[Row]:
    at_once = [start_at_once(50) for _ in range(ROUNDS)]
    yield Row("50 that start at once: the last one's start until all see all", figure(at_once), {}, BUDGET)
    joining = [let_one_join(50) for _ in range(ROUNDS)]
    yield Row("the 50th, beside 49: its start until all see all", figure([seconds for seconds, _ in joining]), {}, BUDGET)
    yield Row("memory of each of the 50 (proportional)", figure([size for _, size in joining], "MB"))


def figure(values: list[float], unit: str = "ns") -> Figure:
    factor = 1e9 if unit == "ns" else 1.0
    return Figure(min(values) * factor, statistics.median(values) * factor, unit)


class Member:
    """A process of the crowd, which says when it sees the given numbers of nodes."""

    def __init__(self, *counts: int) -> None:
        command = [sys.executable, "-m", __name__, *map(str, counts)]
        self.started = time.time()
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=ENVIRONMENT)

    def next_time(self) -> float:
        assert self.process.stdout is not None
        return float(self.process.stdout.readline())

    def megabytes(self) -> float:
        lines = Path(f"/proc/{self.process.pid}/smaps_rollup").read_text().splitlines()
        return sum(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024


def start_at_once(count: int) -> float:
    """Seconds from the last start until all see all."""
    members = [Member(count) for _ in range(count)]
    seen = max(member.next_time() for member in members)
    end(members)
    return seen - members[-1].started


def let_one_join(count: int) -> tuple[float, float]:
    """Seconds from the last one's start, after the others know each other, until all see all; and MB of each."""
    members = [Member(count - 1, count) for _ in range(count - 1)]
    for member in members:
        member.next_time()
    members.append(Member(count))
    seen = max(member.next_time() for member in members)
    size = statistics.mean(member.megabytes() for member in members)
    end(members)
    return seen - members[-1].started, size


def end(members: list[Member]) -> None:
    for member in members:
        member.process.communicate()


def be_a_member(counts: list[int]) -> None:
    from turtlewire.wire import open_context
    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS

    context = open_context()
    node = context.create_node(f"member{os.getpid()}")
    text = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
    endpoints = node.create_publisher("/chatter", text, QoS()), node.create_subscription("/chatter", text, QoS())
    graph = context.graph

    def sees(count: int) -> bool:
        if len(graph.nodes()) < count:
            return False
        return sum(endpoint.topic == "/chatter" and endpoint.node is not None for endpoint in graph.endpoints()) >= len(endpoints) * count

    for count in counts:
        if not graph.wait_for(lambda: sees(count), LIMIT_NS):  # noqa: B023
            sys.exit(f"sees {len(graph.nodes())} of {count}")
        print(time.time(), flush=True)
    sys.stdin.read()
    context.close()


if __name__ == "__main__":
    be_a_member([int(word) for word in sys.argv[1:]])
