"""The cost of an idle node: starting it, and keeping it running."""

from __future__ import annotations

import json
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.figures import Figure, Row, on_loopback, printed

TITLE = "rclpy: start-up, and an idle node"
ROUNDS = 9
IDLE_S = 5.0


def rows() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as cache:
        environment = on_loopback(103, PYTHONPYCACHEPREFIX=cache, PYTHONDONTWRITEBYTECODE="")
        started = [sys.executable, "-c", START]
        printed(started, environment)  # fills the cache of compiled modules
        runs = [printed(started, environment) for _ in range(ROUNDS)]
        budgets = {
            "import rclpy": "<= 50 ms (rclpy: 65 ms, the interpreter's 11 included)",
            "import, init, node": "<= 100 ms (rclpy: 153 ms, likewise)",
            "the same, CPU": "",
            "… and a String publisher and subscription": "(rclpy: 160 ms, likewise)",
        }
        for number, (what, budget) in enumerate(budgets.items()):
            yield Row(what, Figure.of([run[number] for run in runs], factor=1e9), {}, budget)
        switches, cpu = printed([sys.executable, "-m", __name__], environment)
        what = "idle node: context switches each second, all threads"
        yield Row(what, Figure.of([switches], "/s"), {}, "< 5 /s")
        yield Row("idle node: CPU", Figure.of([cpu], "%"))


#: Prints the seconds since the interpreter was ready: after the import, after the node (wall and
#: CPU), after two endpoints. No module is loaded before.
START = """
import time
begin, cpu = time.perf_counter(), time.process_time()
import rclpy
moments = [time.perf_counter() - begin]
from rclpy.node import Node
rclpy.init(args=[])
node = Node("started")
moments.append(time.perf_counter() - begin)
moments.append(time.process_time() - cpu)
from std_msgs.msg import String
node.create_publisher(String, "chatter", 10)
node.create_subscription(String, "chatter", lambda _: None, 10)
moments.append(time.perf_counter() - begin)
print(moments)
rclpy.shutdown()
"""


def measure_idle() -> None:
    """Context switches a second and CPU percent of a node that spins with nothing to do."""
    import threading

    import rclpy
    from rclpy.executors import ExternalShutdownException

    rclpy.init(args=[])
    node = rclpy.create_node("idle")

    def spin() -> None:
        try:
            rclpy.spin(node)
        except ExternalShutdownException:
            return

    spinning = threading.Thread(target=spin)
    spinning.start()
    time.sleep(2.0)
    switches, cpu = _context_switches(), time.process_time()
    time.sleep(IDLE_S)
    figures = (
        (_context_switches() - switches) / IDLE_S,
        (time.process_time() - cpu) / IDLE_S * 100,
    )
    rclpy.shutdown()
    spinning.join()
    print(json.dumps(figures))


def _context_switches() -> int:
    total = 0
    for status in Path("/proc/self/task").glob("*/status"):
        total += sum(
            int(line.split()[1])
            for line in status.read_text().splitlines()
            if "ctxt_switches" in line
        )
    return total


if __name__ == "__main__":
    measure_idle()
