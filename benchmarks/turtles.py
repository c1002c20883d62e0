"""CPU and memory per turtle.

The simulator and the swarm of learning_tf2_py in one process, on the wire, as `swarm.launch.py`
starts them.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.figures import Figure, Row, on_loopback, printed

TITLE = (
    "Turtles: a swarm that follows one another through TF, CPU for each turtle and tick of 16 ms"
)
COUNTS = (10, 100, 1000)
ROUNDS = 5
SECONDS = 1.0
ROOT = Path(__file__).parent.parent
PATH = [ROOT / "examples" / "learning_tf2_py", ROOT / "examples" / "graded_exercise"]


def rows() -> Iterator[Row]:
    environment = on_loopback(101)
    environment["PYTHONPATH"] = os.pathsep.join(
        filter(None, (*map(str, PATH), environment.get("PYTHONPATH")))
    )
    for count in COUNTS:
        measured = run(str(count), environment)
        simulator, process, rate, spawning = (
            Figure.of(measured[what], "Hz" if what == "rate" else "ns")
            for what in ("simulator", "process", "rate", "spawning")
        )
        yield Row(f"{count} turtles, the simulator alone", simulator)
        budget = "<= 16 us (one core)" if count == max(COUNTS) else ""
        yield Row(f"{count} turtles, all of the process", process, budget=budget)
        yield Row(f"{count} turtles, ticks per second", rate, budget="62.5 Hz")
        yield Row(f"{count} turtles, spawned one by one through the service", spawning)
    chase = Figure.of(run("chase", environment)["second"])
    yield Row("a simulated second of a chase in lock-step", chase, budget="<= 50 ms (20x)")


def run(what: str, environment: dict[str, str]) -> dict[str, list[float]]:
    return printed([sys.executable, "-m", __name__, what], environment)


def measure(count: int) -> dict[str, list[float]]:
    from learning_tf2_py.swarm import Swarm

    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from turtlesim.turtlesim_node import TurtlesimNode

    rclpy.init(args=["--ros-args", "-p", f"count:={count}", "--log-level", "warn"])
    simulator, executor = TurtlesimNode(headless=True), SingleThreadedExecutor()
    clock = Stopwatch(simulator)
    swarm = Swarm(simulator.pose_of)
    for node in (simulator, swarm):
        executor.add_node(node)
    start = time.monotonic_ns()
    while len(swarm.members) < count:
        executor.spin_once()
    results: dict[str, list[float]] = {
        "simulator": [],
        "process": [],
        "rate": [],
        "spawning": [(time.monotonic_ns() - start) / count],
    }
    spin(executor, 2 * SECONDS)  # the garbage of the beginning, and the first commands
    for _ in range(ROUNDS):
        ticks, tick_ns, cpu, wall = (
            clock.ticks,
            clock.cpu_ns,
            time.process_time_ns(),
            time.monotonic(),
        )
        spin(executor, SECONDS)
        ticks = clock.ticks - ticks
        results["simulator"].append((clock.cpu_ns - tick_ns) / ticks / count)
        results["process"].append((time.process_time_ns() - cpu) / ticks / count)
        results["rate"].append(ticks / (time.monotonic() - wall))
    return results


def measure_chase() -> dict[str, list[float]]:
    """The graded exercise: two broadcasters, a follower and the simulator."""
    from broadcaster import Broadcaster
    from follower import Follower

    from turtlesim.testing import Simulation

    seconds = []
    with Simulation() as simulation:
        simulation.spawn("turtle2", x=4.0, y=2.0)
        for turtle in ("turtle1", "turtle2"):
            simulation.start(Broadcaster, name=f"{turtle}_broadcaster", turtlename=turtle)
        simulation.add(Follower())
        for _ in range(60):
            start = time.monotonic_ns()
            simulation.drive("turtle1", 2.0, 1.2)
            simulation.run(1.0)
            seconds.append(time.monotonic_ns() - start)
    return {"second": seconds}


class Stopwatch:
    """Counts the ticks of a simulator and their CPU time."""

    def __init__(self, simulator: Any) -> None:
        self.ticks = self.cpu_ns = 0
        self._tick = simulator._tick
        simulator._tick = self.tick

    def tick(self, now_ns: int) -> None:
        start = time.thread_time_ns()
        self._tick(now_ns)
        self.cpu_ns += time.thread_time_ns() - start
        self.ticks += 1


def spin(executor: Any, seconds: float) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        executor.spin_once()


if __name__ == "__main__":
    costs = measure_chase() if sys.argv[1] == "chase" else measure(int(sys.argv[1]))
    print(json.dumps(costs), flush=True)
    # A thousand turtles take seconds to leave one by one, which is not what is measured.
    os._exit(0)
