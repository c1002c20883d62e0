"""The programs as separate processes over DDS.

The simulator with its page, and teleop on a pseudo-terminal.
"""

from __future__ import annotations

import json
import os
import pty
import re
import signal
import subprocess
import sys
import termios
import threading
import time
from pathlib import Path

import pytest
from tests.places import GOLDEN
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from turtlesim.msg import Pose

TELEOP = json.loads((GOLDEN / "tutorial" / "teleop.json").read_text())
HEADINGS = set("gtredcvb")
LINE = re.compile(r"\[(INFO|WARN|ERROR)\] \[\d+\.\d{9}\] \[[a-z0-9_.]+\]: (.*)")


class Process:
    """A program of ours, with what it printed."""

    def __init__(
        self, module: str, *args: str, stdin: int = subprocess.DEVNULL, **env: str
    ) -> None:
        self.popen = subprocess.Popen(
            [sys.executable, "-m", module, *args],
            stdin=stdin,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, "TURTLEWIRE_BROWSER": "0", "TURTLEWIRE_PORT": "0", **env},
        )
        self.output = ""
        self._more = threading.Condition()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        for line in self.popen.stdout:
            with self._more:
                self.output += line
                self._more.notify_all()
        with self._more:
            self._more.notify_all()

    def wait_for(self, pattern: str) -> re.Match:
        with self._more:
            assert self._more.wait_for(lambda: re.search(pattern, self.output), 120), self.output
        return re.search(pattern, self.output)

    def interrupt(self) -> int:
        """Ctrl-C; the exit code."""
        self.popen.send_signal(signal.SIGINT)
        return self.join()

    def join(self) -> int:
        try:
            return self.popen.wait(60)
        finally:
            self.popen.kill()
            self._reader.join()
            self.popen.stdout.close()


class Ear:
    """A node that listens, spun by the test."""

    def __init__(self) -> None:
        rclpy.init(args=[])
        self.node = Node("ear")
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)

    def listen(self, kind, topic: str) -> list:
        heard: list = []
        self.node.create_subscription(kind, topic, heard.append, 10_000)
        return heard

    def spin_until(self, is_done) -> None:
        deadline = time.monotonic() + 60
        while not is_done():
            assert time.monotonic() < deadline, "nothing happened"
            self._executor.spin_once(timeout_sec=0.1)

    def close(self) -> None:
        self.node.destroy_node()
        self._executor.shutdown()
        rclpy.try_shutdown()


@pytest.fixture
def ear():
    ear = Ear()
    yield ear
    ear.close()


def test_ctrl_c_ends_the_simulator_cleanly(ear):
    poses = ear.listen(Pose, "/turtle1/pose")
    simulator = Process("turtlesim.turtlesim_node", "--headless")
    ear.spin_until(lambda: poses)
    assert simulator.interrupt() == 0
    assert [LINE.fullmatch(line).groups() for line in simulator.output.splitlines()] == [
        ("INFO", "Starting turtlesim with node name /turtlesim"),
        ("INFO", "Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]"),
    ]


def test_ctrl_c_ends_it_with_a_browser_open_too():
    simulator = Process("turtlesim.turtlesim_node", "--ros-args", "-r", "__node:=sim")
    url = simulator.wait_for(r"The field is shown at (http://127\.0\.0\.1:\d+/)")[1]
    with connect(url.replace("http", "ws") + "live", close_timeout=0.2) as browser:
        assert json.loads(browser.recv(timeout=60))["node"] == "/sim"
        assert simulator.interrupt() == 0
    assert "Traceback" not in simulator.output


@pytest.mark.parametrize("asked", ["option", "environment"])
def test_another_device_needs_the_token(asked):
    options, env = (["--lan"], {}) if asked == "option" else ([], {"TURTLEWIRE_LAN": "1"})
    simulator = Process("turtlesim.turtlesim_node", *options, **env)
    url = simulator.wait_for(r"The field is shown at (http://127\.0\.0\.1:\d+/\w{16}/)")[1]
    simulator.wait_for("no other device reaches the page|On another device of this network: http")
    with connect(url.replace("http", "ws") + "live", close_timeout=0.2) as browser:
        assert json.loads(browser.recv(timeout=60))["node"] == "/turtlesim"
    with (
        pytest.raises(InvalidStatus) as refused,
        connect(re.sub(r"^http(.*/)\w+/$", r"ws\1live", url)),
    ):
        pass
    assert refused.value.response.status_code == 403
    assert simulator.interrupt() == 0


def test_sigterm_ends_it_too(ear):
    poses = ear.listen(Pose, "/turtle1/pose")
    simulator = Process("turtlesim.turtlesim_node")
    ear.spin_until(lambda: poses)
    simulator.popen.terminate()
    assert simulator.join() == 0
    assert "Traceback" not in simulator.output


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_a_program_that_waits_for_the_simulator_ends_cleanly(ear, end):
    waiting = Process("turtlesim.draw_square")
    ear.spin_until(lambda: "draw_square" in ear.node.get_node_names())
    waiting.popen.send_signal(end)
    assert waiting.join() == 0
    assert "Traceback" not in waiting.output


def test_the_page_drives_the_turtle_on_its_topic(ear):
    simulator = Process("turtlesim.turtlesim_node")
    try:
        url = simulator.wait_for(r"The field is shown at (http://127\.0\.0\.1:\d+/)")[1]
        poses = ear.listen(Pose, "/turtle1/pose")
        commands = ear.listen(Twist, "/turtle1/cmd_vel")
        ear.spin_until(lambda: poses)
        with connect(url.replace("http", "ws") + "live", close_timeout=0.2) as browser:
            for _ in range(2):
                browser.send(
                    '{"type": "drive", "turtle": "turtle1", "linear": 2.0, "angular": 0.0}'
                )
                ear.spin_until(lambda: poses[-1].linear_velocity == 2.0)
                ear.spin_until(lambda: poses[-1].linear_velocity == 0.0)
        assert (
            6.0 < poses[-1].x < 9.7
        )  # two commands of a second at 2 m/s, less the ticks that a busy machine skipped
        assert [command.linear.x for command in commands][
            -1
        ] == 2.0  # the first may be older than the match with this node
    finally:
        assert simulator.interrupt() == 0


def test_the_page_rotates_the_turtle_by_its_action(ear):
    simulator = Process("turtlesim.turtlesim_node")
    try:
        url = simulator.wait_for(r"The field is shown at (http://127\.0\.0\.1:\d+/)")[1]
        poses = ear.listen(Pose, "/turtle1/pose")
        with connect(url.replace("http", "ws") + "live", close_timeout=0.2) as browser:
            browser.send('{"type": "cancel", "turtle": "turtle1"}')  # there is nothing to cancel
            browser.send('{"type": "rotate", "turtle": "turtle1", "theta": 0.3}')
            simulator.wait_for("Rotation goal completed successfully")
            ear.spin_until(lambda: poses and poses[-1].theta == pytest.approx(0.3, abs=0.03))
            browser.send('{"type": "rotate", "turtle": "turtle1", "theta": 3.1416}')
            ear.spin_until(lambda: poses[-1].theta > 0.4)
            browser.send('{"type": "cancel", "turtle": "turtle1"}')
            simulator.wait_for("Rotation goal canceled")
            browser.send('{"type": "rotate", "turtle": "turtle1", "theta": 3.1416}')
            browser.send('{"type": "kill", "turtle": "turtle1"}')
            browser.send('{"type": "rotate", "turtle": "turtle1", "theta": 0.0}')  # it is gone
            browser.send('{"type": "reset"}')
            simulator.wait_for("Resetting turtlesim")
            browser.send('{"type": "rotate", "turtle": "turtle1", "theta": -0.2}')
            simulator.wait_for(
                r"Rotation goal completed successfully(?s:.*)Rotation goal completed successfully"
            )
    finally:
        assert simulator.interrupt() == 0
    assert "Traceback" not in simulator.output


TELEOP_MAIN = "import sys; from turtlesim.turtle_teleop_key import main; sys.exit(main())"
TELEOP_BROKEN = f"""
from turtlesim.turtle_teleop_key import TeleopTurtle

TeleopTurtle.press = lambda self, key: 1 / 0
{TELEOP_MAIN}
"""


class Terminal:
    """A pseudo-terminal with teleop on it."""

    def __init__(self, code: str = TELEOP_MAIN) -> None:
        self.master, slave = pty.openpty()
        self.before = termios.tcgetattr(self.master)
        self.popen = subprocess.Popen(
            [sys.executable, "-c", code],
            stdin=slave,
            stdout=slave,
            stderr=slave,
            start_new_session=True,
        )
        self._slave = slave
        self.output = ""

    def read_until(self, text: str) -> None:
        while text not in self.output:
            self.output += os.read(self.master, 1024).decode("latin-1")

    def close(self) -> None:
        self.popen.kill()
        self.popen.wait()
        os.close(self.master)
        os.close(self._slave)


@pytest.fixture
def terminal():
    terminal = Terminal()
    yield terminal
    terminal.close()


def follows(command, poses):
    """Return True if the turtle moved as commanded; poses show the speed, not its sign."""
    wanted = (abs(command.linear.x), command.angular.z)
    return any((pose.linear_velocity, pose.angular_velocity) == wanted for pose in poses)


def introduce(terminal, ear, poses, commands):
    """Press a key until the turtle moves: the simulator, the teleop and the ear know each other."""
    while not (commands and any(pose.linear_velocity for pose in poses)):
        os.write(terminal.master, b"\x1b[A")
        more = len(poses) + 100
        ear.spin_until(lambda more=more: len(poses) > more)
    ear.spin_until(lambda: poses[-1].linear_velocity == 0)
    commands.clear()


def test_teleop_does_what_the_original_did(ear, terminal):
    """Every key of the capture, on a real simulator that hurries.

    The same commands, and the same heading after each rotation.
    """
    simulator = Process("turtlesim.turtlesim_node", "--headless", "--speed", "4")
    poses = ear.listen(Pose, "/turtle1/pose")
    commands = ear.listen(Twist, "/turtle1/cmd_vel")
    banner, *events = TELEOP["events"]
    terminal.read_until("to quit.\r\n")
    assert terminal.output == banner["output"]
    assert termios.tcgetattr(terminal.master)[3] & (termios.ICANON | termios.ECHO) == 0
    ear.spin_until(lambda: poses)
    introduce(terminal, ear, poses, commands)
    headings = 0
    for event in events:
        shown, wanted = len(poses), len(commands) + len(event["cmd_vel"])
        os.write(terminal.master, bytes.fromhex(event["sent"]))
        ear.spin_until(lambda wanted=wanted: len(commands) >= wanted)
        if event["cmd_vel"]:  # the simulator has it, too: later it would abort the next rotation
            ear.spin_until(lambda shown=shown: follows(commands[-1], poses[shown:]))
        if event["key"] in HEADINGS:
            headings += 1
            simulator.wait_for(headings * r"(?s:.*)Rotation goal completed successfully")
            ear.spin_until(lambda theta=event["theta_after"]: abs(poses[-1].theta - theta) < 0.04)
    assert terminal.popen.wait(60) == TELEOP["exit_code_after_q"] == 0
    got = [
        [m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z]
        for m in commands
    ]
    expected = [command for event in events for command in event["cmd_vel"]]
    assert (len(events), len(expected), headings) == (17, 5, 8)
    assert got == expected
    assert termios.tcgetattr(terminal.master) == terminal.before
    assert simulator.interrupt() == 0
    assert simulator.output.count("Rotation goal completed successfully") == 8


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT])
def test_the_terminal_is_put_back_after_a_signal(terminal, end):
    terminal.read_until("to quit.\r\n")
    assert termios.tcgetattr(terminal.master) != terminal.before
    terminal.popen.send_signal(end)
    assert terminal.popen.wait(60) == 0
    assert termios.tcgetattr(terminal.master) == terminal.before
    assert "Traceback" not in terminal.output


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads the threads in /proc")
def test_only_the_thread_that_reads_keys_gets_the_signals_of_the_terminal(terminal):
    """One to another thread would not wake it."""
    terminal.read_until("to quit.\r\n")
    pid = terminal.popen.pid
    blocked = {
        int(folder.name): int(re.search(r"SigBlk:\s*(\w+)", (folder / "status").read_text())[1], 16)
        for folder in Path(f"/proc/{pid}/task").iterdir()
    }
    assert len(blocked) > 2
    for number in (signal.SIGHUP, signal.SIGQUIT, signal.SIGTSTP, signal.SIGCONT):
        assert {pid} == {tid for tid, mask in blocked.items() if not mask >> (number - 1) & 1}


def test_the_terminal_is_put_back_after_a_fault_of_ours():
    terminal = Terminal(TELEOP_BROKEN)
    try:
        terminal.read_until("to quit.\r\n")
        os.write(terminal.master, b"g")
        terminal.read_until("ZeroDivisionError")
        assert terminal.popen.wait(60) == 1
        assert termios.tcgetattr(terminal.master) == terminal.before
    finally:
        terminal.close()


TELEOP_WITH_A_PIPE = f"true | {sys.executable} -m turtlesim.turtle_teleop_key"


def test_teleop_without_a_terminal_says_so(run):
    teleop = run("sh", "-c", TELEOP_WITH_A_PIPE)  # in a separate session, without a terminal
    assert teleop.wait() == 1
    first, hint = teleop.text.splitlines()
    assert first == "Failed to get old console mode"
    assert "terminal" in hint


def test_teleop_with_piped_input_uses_and_restores_the_terminal(run):
    modes = "stty -g </dev/tty"
    teleop = run("sh", "-c", f"{modes}; {TELEOP_WITH_A_PIPE}; {modes}", terminal=True)
    teleop.wait_for(r"'Q' to quit\.")
    teleop.type("q")
    assert teleop.wait() == 0
    before, after = re.findall(r"(?m)^[0-9a-f]+(?::[0-9a-f]+)+$", teleop.text)
    assert before == after


def test_teleop_reads_keys_again_after_ctrl_z_and_fg(run):
    teleop = f"{sys.executable} -m turtlesim.turtle_teleop_key"
    modes = "echo modes $(stty -g </dev/tty)"
    shell = run("bash", "-c", f"set -m; {modes}; {teleop}; {modes}; fg; {modes}", terminal=True)
    shell.wait_for(r"'Q' to quit\.")
    shell.type("\x1a")
    shell.wait_for("modes", count=2)
    shell.wait_for(f"^{re.escape(teleop)}$")  # the line of `fg`
    shell.type("q")
    assert shell.wait() == 0
    assert (
        len(set(re.findall(r"(?m)modes (\S+)$", shell.text))) == 1
    )  # its own while it was stopped


def test_teleop_in_the_background_leaves_the_terminal_alone(run):
    teleop = run(
        "bash", "-c", f"set -m; {TELEOP_WITH_A_PIPE} & wait $!; echo status $?", terminal=True
    )
    assert teleop.wait() == 0
    assert "Failed to get old console mode" in teleop.text
    assert "status 1" in teleop.text


def test_teleop_ends_when_its_terminal_closes():
    terminal = Terminal()
    terminal.read_until("to quit.\r\n")
    os.close(terminal._slave)
    os.close(terminal.master)
    assert terminal.popen.wait(60) == 0
