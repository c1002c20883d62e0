"""The same programs in our rclpy, in the real ones on Fast DDS, and the floor of the machine.

The real ones are what `scripts/peers` installs; their address space is limited, because Fast DDS
sizes its memory by the machine's. All take turns in one run.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from benchmarks import floors
from benchmarks.figures import Figure, Row, printed, printed_by_pair
from benchmarks.rivals import rclpy_programs

TITLE = "real: rclpy of turtlewire, Jazzy and Kilted, and the machine's floor"
PEERS = Path(__file__).parents[1] / "build" / "peers"
ROUNDS = 4
ADDRESS_SPACE_KB = 6_000_000
ENVIRONMENT = {
    "HOME": os.environ["HOME"],
    "PATH": "/usr/bin:/bin",
    "ROS_DOMAIN_ID": "102",
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
}
#: Programs that need a second process, which serves them.
SERVED = ("latency", "service", "images")
ALONE = ("start", "timer")
#: What is printed, by the name of the figure in the programs.
WHAT = {
    "p50": "publish to callback, two processes, 1 kHz, p50",
    "p99": "the same, p99",
    "sender_cpu": "CPU of the publisher and its timer for each message",
    "receiver_cpu": "CPU of the receiver for each message",
    "timer_cpu": "CPU of a tick of a timer, 100 Hz",
    "call": "call of a service and its answer, mean",
    "call_p50": "the same, p50",
    "client_cpu": "CPU of the client for each call",
    "server_cpu": "CPU of the server for each call",
    "image": "an image of 6.2 MB, reliable and nothing lost: time for each",
    "image_cpu": "CPU of the sender for each",
    "imported": "import rclpy",
    "node": "import, init and a node",
}


def rows() -> Iterator[Row]:
    pythons = _pythons()
    measured: dict[str, dict[str, list[float]]] = {name: {} for name in pythons}
    for _ in range(ROUNDS):
        for name, command in pythons.items():
            for figure, value in measure(command).items():
                measured[name].setdefault(figure, []).append(value)
    floor = _floors()
    for figure, what in WHAT.items():
        figures = {name: Figure.of(values[figure]) for name, values in measured.items()}
        yield Row(what, figures.pop("ours"), figures, floor=floor.get(figure))


def _pythons() -> dict[str, list[str]]:
    pythons = {"ours": [sys.executable]}
    for distribution in ("jazzy", "kilted"):
        python = PEERS / distribution / "bin" / "python"
        if python.exists():
            limited = f'ulimit -v {ADDRESS_SPACE_KB}; exec "$@"'
            pythons[f"real {distribution.title()}"] = ["sh", "-c", limited, "sh", str(python)]
        else:
            print(f"real: no rclpy of {distribution} (run scripts/peers)", file=sys.stderr)
    return pythons


def _floors() -> dict[str, Figure]:
    found = {
        "timer_cpu": floors.sleep_cpu(rclpy_programs.TICK_S),
        "image": floors.transfer(rclpy_programs.IMAGE_SIZE),
    }
    if (wire := floors.one_way()) is not None:
        found |= {"p50": wire["p50"], "p99": wire["p99"]}
    if (wire := floors.one_way("")) is not None:
        for figure, kind in {"call": "mean", "call_p50": "p50"}.items():
            found[figure] = Figure(wire[kind].minimum * 2, wire[kind].median * 2)
    return found


def measure(python: list[str]) -> dict[str, float]:
    """Run each program once and return its figures [ns]."""
    program = [*python, rclpy_programs.__file__]
    figures: dict[str, float] = {}
    for name in ALONE:
        figures |= {
            {"cpu": "timer_cpu"}.get(figure, figure): value
            for figure, value in printed([*program, name], ENVIRONMENT).items()
        }
    for name in SERVED:
        figures |= printed_by_pair(program, f"{name}_serve", f"{name}_ask", ENVIRONMENT)
    return figures
