"""Cost of a `ros2` command line: from the shell's start of the process to its end."""

from __future__ import annotations

import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from benchmarks.figures import Figure, Row, on_loopback

TITLE = "ros2: wall time of a command"
ROUNDS = 15
LAUNCHES = 5
DEMO = Path(__file__).parent.parent / "examples" / "one_process.launch.py"

ROS2 = [
    "-c",
    "import sys; from turtlewire_ros.guard import main; sys.argv[0] = 'ros2'; sys.exit(main())",
]

#: A node that others can see, until its input ends.
NODE = """
import sys
import rclpy
from std_msgs.msg import String
rclpy.init(args=[])
node = rclpy.create_node("seen")
node.create_publisher(String, "chatter", 10)
print("ready", flush=True)
sys.stdin.read()
rclpy.shutdown()
"""


def rows() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as cache:
        # Else every command would compile its modules again.
        environment = on_loopback(104, PYTHONPYCACHEPREFIX=cache, PYTHONDONTWRITEBYTECODE="")
        yield Row("the interpreter alone", measured(environment, ["-c", "print('ready')"], "ready"))
        yield Row("ros2 --help", measured(environment, [*ROS2, "--help"], "Commands:"))
        yield Row("ros2 pkg list", measured(environment, [*ROS2, "pkg", "list"], "turtlesim"))
        yield Row(
            "ros2 launch: the demo in one process, to turtle2's spawn", demo_started(environment)
        )
        with node(environment):
            yield Row(
                "ros2 topic list, beside a node",
                measured(environment, [*ROS2, "topic", "list"], "/chatter"),
            )


def measured(environment: dict[str, str], words: list[str], expected: str) -> Figure:
    """Wall time of a command whose output has to hold a text.

    The first run fills the cache of compiled modules.
    """
    spent = [run(environment, words, expected) for _ in range(ROUNDS + 1)][1:]
    return Figure.of(spent)


def demo_started(environment: dict[str, str]) -> Figure:
    """Wall time until the follow demo has spawned turtle2."""
    spent = []
    quiet = {
        **environment,
        "TURTLEWIRE_PORT": "0",
        "TURTLEWIRE_BROWSER": "0",
        "ROS_LOG_DIR": environment["PYTHONPYCACHEPREFIX"],
    }
    for _ in range(LAUNCHES + 1):
        begin = time.perf_counter_ns()
        with subprocess.Popen(
            [sys.executable, *ROS2, "launch", str(DEMO)],
            env=quiet,
            stdout=subprocess.PIPE,
            text=True,
        ) as launch:
            for line in launch.stdout:
                if "Spawning turtle [turtle2]" in line:
                    spent.append(time.perf_counter_ns() - begin)
                    launch.send_signal(signal.SIGINT)
    return Figure.of(spent[1:])


def run(environment: dict[str, str], words: list[str], expected: str) -> int:
    begin = time.perf_counter_ns()
    done = subprocess.run(
        [sys.executable, *words], env=environment, stdout=subprocess.PIPE, text=True, check=True
    )
    spent = time.perf_counter_ns() - begin
    if expected not in done.stdout:
        raise RuntimeError(f"'{expected}' is missing in the output of {words[-2:]}: {done.stdout}")
    return spent


@contextmanager
def node(environment: dict[str, str]) -> Iterator[None]:
    """A node in a separate process; it ends with its input, which `Popen` closes."""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(
        [sys.executable, "-c", NODE], env=environment, text=True, **pipes
    ) as process:
        if process.stdout.readline() != "ready\n":
            raise RuntimeError("the node did not start")
        yield
