"""Many processes on one host, each with one node.

Measures the time until all have discovered each other, and their memory.

``scripts/bench crowd`` measures 50; ``python -m benchmarks.crowd 120 5`` measures 120, five started
per second.
"""

from __future__ import annotations

import math
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from benchmarks.figures import Figure, Row, on_loopback

TITLE = "A crowd of processes on one host, one node each"
ROUNDS = 3
BUDGET = "<= 3 s"
#: A small process that imports little besides what it measures; the tests run it, too.
MEMBER = Path(__file__).parents[1] / "packages/turtlewire/tests/wire/peers/crowd.py"
#: A domain whose ports lie below those that systems hand out: 120 processes take all that it has.
ENVIRONMENT = on_loopback(95)


def rows() -> Iterator[Row]:
    at_once = [start(50, each_second=math.inf)[0] for _ in range(ROUNDS)]
    what = "50 that start at once: the last one's start until all see all"
    yield Row(what, Figure.of(at_once, factor=1e9), {}, BUDGET)
    seconds, megabytes = zip(*(let_one_join(50) for _ in range(ROUNDS)), strict=True)
    what = "the 50th, beside 49: its start until all see all"
    yield Row(what, Figure.of(seconds, factor=1e9), {}, BUDGET)
    yield Row("memory of each of the 50 (proportional)", Figure.of(megabytes, "MB"))


class Member:
    """A process of the crowd, which says when it sees the given numbers of nodes."""

    def __init__(self, *counts: int, environment: dict[str, str] = ENVIRONMENT) -> None:
        command = [sys.executable, MEMBER, *map(str, counts)]
        self.started = time.time()
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
        )

    def next_time(self) -> float:
        """Return the time of the next count."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            what, when = line.split()
            if what == "sees":
                return float(when)
        sys.exit("a member of the crowd gave up")

    def megabytes(self) -> float:
        lines = Path(f"/proc/{self.process.pid}/smaps_rollup").read_text().splitlines()
        return sum(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024


@contextmanager
def crowd() -> Iterator[list[Member]]:
    """A list for its members, which end with it whatever happens."""
    members: list[Member] = []
    try:
        yield members
        for member in members:
            member.process.communicate()
    finally:
        for member in members:
            member.process.kill()


def start(
    count: int, each_second: float, environment: dict[str, str] = ENVIRONMENT
) -> tuple[float, float]:
    """Seconds from the last start until all see all; and MB of each."""
    with crowd() as members:
        begin = time.monotonic()
        for number in range(count):
            time.sleep(max(0.0, begin + number / each_second - time.monotonic()))
            members.append(Member(count, environment=environment))
        seen = max(member.next_time() for member in members)
        return seen - members[-1].started, statistics.mean(member.megabytes() for member in members)


def let_one_join(count: int) -> tuple[float, float]:
    """Seconds from the last one's start, after the others know each other, until all see all.

    And MB of each.
    """
    with crowd() as members:
        members += [Member(count - 1, count) for _ in range(count - 1)]
        for member in members:
            member.next_time()
        members.append(Member(count))
        seen = max(member.next_time() for member in members)
        return seen - members[-1].started, statistics.mean(member.megabytes() for member in members)


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit("usage: python -m benchmarks.crowd COUNT STARTS_PER_SECOND")
    seconds, megabytes = start(int(sys.argv[1]), float(sys.argv[2]))
    print(f"from the last one's start until all see all: {seconds:.1f} s; {megabytes:.1f} MB each")


if __name__ == "__main__":
    main()
