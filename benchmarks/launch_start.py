"""`ros2 launch` of two nodes: wall time from the command until another process sees both.

The floor starts the two interpreters by hand, side by side and without a launch. The CPU time of a
launch without nodes depends less on the load of the machine.
"""

from __future__ import annotations

import contextlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.figures import Figure, Row, on_loopback
from benchmarks.ros2_command import ROS2
from turtlewire_ros.executables import argv_for, executable_paths

TITLE = "ros2 launch: from the command to its nodes"
ROUNDS = 15
#: Executables of demo_nodes_py, which are also the names of their nodes.
NODES = ("talker", "listener")
LAUNCH_FILE = f"""
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription(
        [Node(package="demo_nodes_py", executable=name) for name in {NODES}]
    )
"""
EMPTY_FILE = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([])
"""
#: Tells when all nodes are there, and when none is left; ends with its input.
OBSERVER = f"""
import sys
import rclpy
rclpy.init(args=[])
node = rclpy.create_node("observer")
wanted = set({NODES})
wait_for_graph = node.context.wait_for_graph
print("none", flush=True)
for _ in sys.stdin:
    wait_for_graph(lambda: wanted <= set(node.get_node_names()), None)
    print("all", flush=True)
    wait_for_graph(lambda: not wanted & set(node.get_node_names()), None)
    print("none", flush=True)
rclpy.shutdown()
"""


def rows() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as folder:
        two_nodes, empty = Path(folder, "two_nodes.launch.py"), Path(folder, "empty.launch.py")
        two_nodes.write_text(LAUNCH_FILE)
        empty.write_text(EMPTY_FILE)
        environment = on_loopback(
            104, ROS_LOG_DIR=folder, PYTHONPYCACHEPREFIX=folder, PYTHONDONTWRITEBYTECODE=""
        )
        launch = [[sys.executable, *ROS2, "launch", str(two_nodes)]]
        by_hand = [argv_for(path) for path in executables()]
        with observer(environment) as watching:
            # The first round fills the cache of compiled modules.
            rounds = [
                [time_of(commands, watching, environment) for commands in (launch, by_hand)]
                for _ in range(ROUNDS + 1)
            ][1:]
        cpu = [
            cpu_of([sys.executable, *ROS2, "launch", str(empty)], environment)
            for _ in range(ROUNDS)
        ]
    ours, floor = (Figure.of(times) for times in zip(*rounds, strict=True))
    yield Row("until another process sees both nodes", ours, {}, "<= 200 ms", floor)
    yield Row("CPU of a launch without nodes", Figure.of(cpu))


def executables() -> list[str]:
    paths = executable_paths("demo_nodes_py") or []
    return [path for path in paths if Path(path).name in NODES]


@contextlib.contextmanager
def observer(environment: dict[str, str]) -> Iterator[subprocess.Popen[str]]:
    """A process that tells when it sees the nodes; it ends with its input, which `Popen` closes."""
    with subprocess.Popen(
        [sys.executable, "-c", OBSERVER],
        env=environment,
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as process:
        expect(process, "none")
        yield process


def time_of(
    commands: list[list[str]], watching: subprocess.Popen[str], environment: dict[str, str]
) -> int:
    """Time [ns] from the start of some processes until all nodes are seen; then they are ended."""
    watching.stdin.write("\n")
    watching.stdin.flush()
    begin = time.perf_counter_ns()
    with contextlib.ExitStack() as stack:
        for command in commands:
            process = stack.enter_context(
                subprocess.Popen(
                    command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
                )
            )
            stack.callback(process.send_signal, signal.SIGINT)
        expect(watching, "all")
        spent = time.perf_counter_ns() - begin
    expect(watching, "none")
    return spent


def cpu_of(command: list[str], environment: dict[str, str]) -> int:
    """CPU time [ns] of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return round(spent * 1e9)


def expect(watching: subprocess.Popen[str], word: str) -> None:
    line = watching.stdout.readline().strip()
    if line != word:
        raise RuntimeError(f"the observer said '{line}' instead of '{word}'")
