"""Replays the captured command lines against this implementation and compares what is not volatile.

As a script: ``python -m tests.golden.cli.replay [first [last]]`` prints the differences and the count.
"""

from __future__ import annotations

import argparse
import contextlib
import difflib
import itertools
import os
import pty
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, TYPE_CHECKING

from tests.golden.cli.captures import Case, captures, inputs

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

HERE = Path(__file__).parent
#: A container on a computer without demo_nodes_cpp, as the captured one was.
CONTAINER = """
import sys
sys.modules["demo_nodes_cpp"] = None
from rclpy_components.component_container import main
main()
"""
ROOT = HERE.parents[2]
#: Exit codes that the real tool gives for a verb ended by Ctrl-C, depending on which thread is faster.
INTERRUPTED = {0, 1, 2, 15, 124}


@dataclass(frozen=True)
class Result:
    """What a command did here."""

    exit_code: int
    stdout: str
    stderr: str


def run(case: Case, timeout: float = 30.0, environment: Mapping[str, str] | None = None) -> Result:
    """Run the command as the capture did: no input, pipes, a process group of its own, Ctrl-C after the same time."""
    env = os.environ | (environment or {}) | {"LANG": "C.UTF-8", "COLUMNS": "80", "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    env.pop("PYTHONDONTWRITEBYTECODE", None)
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    words = ["bash", "-c", case.command] if "|" in case.command else shlex.split(case.command)
    process = subprocess.Popen(words, cwd=inputs(), env=env, start_new_session=True, **pipes)
    stdout, stderr = _Reader(process.stdout), _Reader(process.stderr)
    suffix = b""
    try:
        if case.interrupt_after is None or not _ends_before_interrupt(process, case, stdout):
            process.wait(timeout)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        suffix = b"\nTIMEOUT"
    return Result(process.returncode, stdout.text(), stderr.text(suffix))


def _ends_before_interrupt(process: subprocess.Popen[bytes], case: Case, output: _Reader) -> bool:
    """Interrupt it after the captured time, on a busy machine not before it has said what the captured one had until then."""
    try:
        process.wait(case.interrupt_after)
    except subprocess.TimeoutExpired:
        said = {line for line in masked(case, case.stdout) if not _AFTER_INTERRUPT.search(line)}
        output.wait_for(lambda text: said <= set(masked(case, text)), 20.0)
        os.killpg(process.pid, signal.SIGINT)
        return False
    return True


class _Reader:
    """Collects what comes out of a pipe, in a thread of its own."""

    def __init__(self, pipe: IO[bytes]) -> None:
        self._parts: list[bytes] = []
        self._more = threading.Condition()
        self._thread = threading.Thread(target=self._read, args=(pipe,), daemon=True)
        self._thread.start()

    def _read(self, pipe: IO[bytes]) -> None:
        for line in pipe:
            with self._more:
                self._parts.append(line)
                self._more.notify_all()
        pipe.close()

    def wait_for(self, wanted: Callable[[str], bool], limit_s: float) -> None:
        """Wait until what has come out so far is as wanted, or the time is over."""
        with self._more:
            self._more.wait_for(lambda: wanted(b"".join(self._parts).decode(errors="replace")), limit_s)

    def text(self, suffix: bytes = b"") -> str:
        """All of it, once the pipe is closed."""
        self._thread.join(10.0)  # a process left behind may hold the pipe
        return (b"".join(self._parts) + suffix).decode(errors="replace")


def replay(case: Case, environment: Mapping[str, str] | None = None) -> Result:
    """Run the command in the situation of its capture."""
    if case.number == 298:  # a command before it, which is not among the captures here, had set it
        subprocess.run(_ros2("param", "set", "/sim", "background_r", "150"), check=True, stdout=subprocess.DEVNULL)
    if _INSTALLED_PACKAGES.search(case.name):  # the last ones of all are others where more are installed
        case = replace(case, command=case.command.partition(" | tail")[0])
    if case.number in {332, 629}:  # the daemon ran, too
        with process([sys.executable, "-c", _DAEMON]):
            _wait_for("node", "/_ros2cli_daemon_0_0")
            return run(case)
    return _run_disturbed(case) if case.number == 338 else run(case, environment=environment)


def _run_disturbed(case: Case) -> Result:
    """Run with what the note of the capture says: a command for turtle1 arrives during the rotation."""
    move = _ros2("topic", "pub", "--rate", "5", "/turtle1/cmd_vel", "geometry_msgs/msg/Twist", "{linear: {x: 0.1}}")
    with subprocess.Popen(move, stdout=subprocess.PIPE, text=True) as mover:
        mover.stdout.readline()  # it is about to begin
        try:
            return run(case)
        finally:
            mover.terminate()


def differences(case: Case, result: Result) -> list[str]:
    """Lines that say how the result differs from the capture, when volatile parts are masked; empty when it agrees."""
    found = []
    interrupted = case.interrupt_after is not None or case.exit_code == 124
    if result.exit_code != case.exit_code and not (interrupted and {case.exit_code, result.exit_code} <= INTERRUPTED):
        found.append(f"exit code: captured {case.exit_code}, here {result.exit_code}")
    for stream in ("stdout", "stderr"):
        captured, here = getattr(case, stream), getattr(result, stream)
        if stream == "stdout" and case.cut_to is not None and not _INSTALLED_PACKAGES.search(case.name):
            here = "".join(here.splitlines(keepends=True)[: case.cut_to])
        left, right = masked(case, captured), masked(case, here)
        if _INSTALLED_PACKAGES.search(case.name):  # whichever are installed: those of the capture have to be among them
            left = [line for line in left if "ros2cli_test_interfaces" not in line]
            right = [line for line in right if line in left]
        if left != right:
            found += difflib.unified_diff(left, right, f"captured {stream}", f"here {stream}", lineterm="", n=1)
    return found


_MASKS = [
    (r"\[\d{10}\.\d{9}\]", "[STAMP]"),
    (r"\b(sec|nanosec)(: |=)\d+", r"\1\2N"),
    (r"\bpid \[?\d+\]?", "pid N"),
    (r"_ros2cli_(daemon_)?\d+(_[0-9a-f]+)?", "_ros2cli_N"),
    (r"\S*/\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d-\d{6}-\S+", "LOGDIR"),
    (r"/tmp/launch_params_\w+", "PARAMS"),
    (r"GID: [0-9a-f.]+", "GID: N"),
    (r"\b[0-9a-f]{32}\b", "ID"),
    (r"object at 0x[0-9a-f]+", "object at 0xN"),
    (r"searching: \[.*\]", "searching: [PATHS]"),
    (r"(/home/user/ros2_ws/install/\w+|/opt/ros/jazzy)", "PREFIX"),
    (r"\(choose from .*\)", "(choose from THESE)"),
    (r", at /\S+/\w+\.c:\d+", ""),
    (r"(?m)( are required: .*), (argv|launch_arguments)$", r"\1"),  # newer argparse does not name what may be empty
    (r"static_transform_publisher_\w+", "static_transform_publisher_N"),
    (r"(?<![\d.])\d{19}\b", "NANOSECONDS"),
    (r"(?m)^([rgb]): \d+$", r"\1: N"),  # what the sensor sees depends on the way of the turtle
]
# Values that depend on the moment: positions, rates, progress of actions, the order of log lines of several processes.
_NUMBERS_VARY = re.compile(r"topic_(hz|bw|delay)|echo_pose|echo_csv|echo_i_|echo_cmd_vel|echo_continuous|send_goal|echo_field_list")
_ORDER_VARIES = re.compile(r"info_v|launch|interface_package|rosargs_rclcpp|param_load")
_INSTALLED_PACKAGES = re.compile(r"interface_list|interface_packages|pkg_list")
#: Where it breaks the usage depends on the version of argparse.
_USAGE = re.compile(r"(?m)^usage: .*(\n {7,}\S.*)*")
#: How many there are depends on how fast the reader of the topic is.
_FEEDBACK = re.compile(r"(Feedback:\n    remaining: F\n\n)+")
#: Lines of ours that help, and one of the capture's environment.
_OUR_HINTS = ("QStandardPaths", "[WARN] [STAMP] [turtlewire.wire]: topic ", "[WARN] [STAMP] [turtlewire.wire]: service ", "Did you mean:", "  raised in ", "The topic '", "The service '", "The action '", "Known ", "No node offers ", "If it is in a workspace of yours", "This computer has nodes on domain ", "No node publishes ", "No node subscribes to ")
_AFTER_INTERRUPT = re.compile(r"^Canceling goal|Process exited")
#: A node as the daemon of a real ROS 2 has one.
_DAEMON = "import rclpy; rclpy.init(); rclpy.spin(rclpy.create_node('_ros2cli_daemon_0_0', start_parameter_services=False))"
_FLOAT = re.compile(r"-?\d+\.\d+(e-?\d+)?")


def masked(case: Case, text: str) -> list[str]:
    """The lines of a stream without what varies from run to run."""
    text = _without_traceback(text)
    for prefix in _prefixes():
        text = text.replace(prefix, "PREFIX")
    for pattern, replacement in _MASKS:
        text = re.sub(pattern, replacement, text)
    if _NUMBERS_VARY.search(case.name):
        text = _FLOAT.sub("F", re.sub(r"(window: |from )\d+", r"\1N", text))
    text = _USAGE.sub(lambda usage: " ".join(usage[0].split()), text)
    text = _FEEDBACK.sub(r"\1", text)
    if "topic_bw" in case.name:  # the unit depends on the rate, and that on how busy the machine is; test_topic_statistics.py has the units
        text = re.sub(r"\S+ K?B\b", "N B", text)
    lines = [line for line in text.splitlines() if not line.startswith(_OUR_HINTS)]
    if case.interrupt_after is not None:  # how often something happened until then
        lines = sorted({re.sub(r"#\d+", "#N", line) for line in lines})
    return sorted(lines) if _ORDER_VARIES.search(case.name) else lines


def _without_traceback(text: str) -> str:
    """Of a Python traceback, only the exception."""
    kept, inside = [], False
    for line in text.splitlines(keepends=True):
        if line.startswith("Traceback (most recent call last)"):
            inside = True
        elif inside and line.startswith("  "):
            continue
        else:
            inside = False
            kept.append(line)
    return "".join(kept)


def _prefixes() -> list[str]:
    return [os.environ.get("AMENT_PREFIX_PATH", "PREFIX"), str(Path(sys.prefix)), str(ROOT)]


@contextlib.contextmanager
def terminal_process(command: list[str]) -> Iterator[None]:
    """A process with a terminal of its own, as turtle_teleop_key needs one."""
    controller, terminal = pty.openpty()
    process = subprocess.Popen(command, stdin=terminal, stdout=terminal, stderr=terminal, start_new_session=True)
    os.close(terminal)
    try:
        yield
    finally:
        os.killpg(process.pid, signal.SIGINT)
        process.wait(10)
        os.close(controller)


@contextlib.contextmanager
def process(command: list[str]) -> Iterator[None]:
    """A process that runs meanwhile and is ended by Ctrl-C."""
    running = subprocess.Popen(
        command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    )
    try:
        yield
    finally:
        os.killpg(running.pid, signal.SIGINT)
        try:
            running.wait(15)
        except subprocess.TimeoutExpired:
            os.killpg(running.pid, signal.SIGKILL)
            running.wait()


def _ros2(*words: str) -> list[str]:
    return [str(Path(sys.executable).parent / "ros2"), *words]


def _wait_for(kind: str, *names: str) -> None:
    """Wait for nodes ("node") or topics ("topic") to appear, as often as they are named."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        hidden = {"node": "-a", "topic": "--include-hidden-topics"}[kind]
        listed = subprocess.run(_ros2(kind, "list", hidden), capture_output=True, text=True, check=True).stdout.split()
        if Counter(names) <= Counter(listed):
            return
    raise AssertionError(f"{names} did not all appear; there are {listed}")


@contextlib.contextmanager
def workspace() -> Iterator[None]:
    """The tutorial's package as it is printed, laid out as colcon lays it out, and sourced."""
    verbatim = ROOT / "tests/tutorial/verbatim/learning_tf2_py"
    static = ROOT / "examples/learning_tf2_py/learning_tf2_py/static_turtle_tf2_broadcaster.py"
    with tempfile.TemporaryDirectory() as folder:
        prefix = Path(folder, "install", "learning_tf2_py")
        shutil.copytree(verbatim / "launch", prefix / "share/learning_tf2_py/launch")
        marker = prefix / "share/ament_index/resource_index/packages/learning_tf2_py"
        library = prefix / "lib/learning_tf2_py"
        for made in (marker.parent, library):
            made.mkdir(parents=True)
        marker.touch()
        for module in (*(verbatim / "learning_tf2_py").glob("turtle_*.py"), static):
            script = library / module.stem
            script.write_text(f"#!/usr/bin/env python3\n{module.read_text(encoding='utf-8')}", encoding="utf-8")
            script.chmod(0o755)
        sourced = {"AMENT_PREFIX_PATH": str(prefix), "TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
        before = dict(os.environ)
        os.environ.update(sourced)
        try:
            yield
        finally:
            os.environ.clear()
            os.environ.update(before)


@contextlib.contextmanager
def surroundings(number: int) -> Iterator[None]:
    """What was running when a case was captured."""
    with contextlib.ExitStack() as stack:
        stack.enter_context(workspace())
        if 174 <= number <= 326 or 333 <= number <= 344:
            stack.enter_context(process(_ros2("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")))
            _wait_for("node", "/sim", "/broadcaster1", "/broadcaster2", "/listener")
        if 174 <= number <= 326:
            stack.enter_context(process([sys.executable, str(HERE / "static_broadcaster.py")]))
            stack.enter_context(terminal_process(_ros2("run", "turtlesim", "turtle_teleop_key")))
            spawn = "{x: 4.0, y: 2.0, theta: 0.0, name: 'turtle2'}"
            subprocess.run(_ros2("service", "call", "/spawn", "turtlesim/srv/Spawn", spawn), check=True, stdout=subprocess.DEVNULL)
            _wait_for("node", "/static_turtle_tf2_broadcaster", "/teleop_turtle")
        if 339 <= number <= 340:
            stack.enter_context(process(_ros2("run", "turtlesim", "turtlesim_node", "--ros-args", "-r", "__node:=sim")))
            _wait_for("node", "/sim", "/sim")
        if 341 <= number <= 344:
            remaps = ["-r", "__node:=sim2", "-r", "__ns:=/robot1", "-r", "turtle1/cmd_vel:=cmd"]
            stack.enter_context(process(_ros2("run", "turtlesim", "turtlesim_node", "--ros-args", *remaps)))
            _wait_for("node", "/robot1/sim2")
        if number >= 500:
            for words in (
                ("run", "turtlesim", "turtlesim_node"),
                ("run", "tf2_ros", "static_transform_publisher", "--x", "1", "--frame-id", "world", "--child-frame-id", "cam"),
            ):
                stack.enter_context(process(_ros2(*words)))
            stack.enter_context(process([sys.executable, "-c", CONTAINER]))
            stack.enter_context(process([sys.executable, str(HERE / "servers.py")]))
            _wait_for("node", "/turtlesim", "/ComponentManager", "/minimal_action_server", "/lc_talker")
            _wait_for("topic", "/tf_static", "/hidden_chatter")
        elif number >= 345:
            stack.enter_context(process([sys.executable, "-m", "tests.golden.cli.wire_talker"]))
            _wait_for("topic", "/w/wstring_empty")  # the last one that it makes
        yield


def blocks(cases: list[Case]) -> list[list[Case]]:
    """Cases that share their surroundings, in order."""
    bounds = [0, 174, 327, 333, 339, 341, 345, 500, 1000]
    return [[case for case in cases if low <= case.number < high] for low, high in itertools.pairwise(bounds)]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("last", type=int, nargs="?")
    args = parser.parse_args()
    last = args.last if args.last is not None else (args.first or 999)
    cases = [case for case in captures() if args.first <= case.number <= last]
    agreed = 0
    for block in blocks(cases):
        if not block:
            continue
        with surroundings(block[0].number):
            for case in block:
                found = differences(case, replay(case))
                agreed += not found
                if found:
                    print(f"=== {case.name}: {case.command}", *found, sep="\n", flush=True)
    print(f"{agreed} of {len(cases)} agree")


if __name__ == "__main__":
    main()
