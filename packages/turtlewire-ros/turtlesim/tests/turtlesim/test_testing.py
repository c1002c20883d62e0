"""The lock-step simulation of `turtlesim.testing`.

The same bits every time, faster than real time, and the example exercise that is graded with it.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from tests.places import EXAMPLES
from tests.programs import run_python

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from turtlesim.msg import Pose
from turtlesim.testing import Simulation

if TYPE_CHECKING:
    from pathlib import Path

EXERCISE = EXAMPLES / "graded_exercise"
RUN = """
import sys; sys.path.insert(0, {exercise!r})
from broadcaster import Broadcaster
from follower import Follower
from turtlesim.testing import Simulation

with Simulation() as simulation:
    simulation.spawn("turtle2", x=4.0, y=2.0)
    for turtle in ("turtle1", "turtle2"):
        simulation.start(Broadcaster, name=turtle + "_broadcaster", turtlename=turtle)
    simulation.add(Follower())
    for _ in range(10):
        simulation.drive("turtle1", 2.0, 1.2)
        simulation.run(1.0)
        print(simulation.pose("turtle1"), simulation.pose("turtle2"))
"""


@pytest.fixture
def simulation():
    with Simulation() as simulation:
        yield simulation


def test_time_moves_only_in_steps(simulation):
    assert simulation.now == 0.0
    simulation.step(3)
    assert simulation.now == pytest.approx(0.048)
    assert simulation.node.get_clock().now().nanoseconds == 48_000_000
    simulation.run(1.0)
    assert simulation.now == pytest.approx(1.04)  # 62 ticks


def test_a_command_lasts_as_in_the_real_one(simulation):
    start = simulation.pose("turtle1").x
    simulation.drive("turtle1", linear=2.0)
    simulation.run(3.0)
    assert simulation.pose("turtle1").x == pytest.approx(start + 63 * 0.032)
    assert simulation.distance("turtle1", "turtle1") == 0.0


def test_run_until_stops_at_the_first_tick_or_at_the_limit(simulation):
    simulation.drive("turtle1", linear=2.0)
    assert simulation.run_until(lambda: simulation.pose("turtle1").x > 6.0, within=5.0)
    assert simulation.now == pytest.approx(0.24)  # 0.456 m at 0.032 m a tick
    assert not simulation.run_until(lambda: simulation.pose("turtle1").x > 11.0, within=2.0)
    assert simulation.now == pytest.approx(2.24)


def test_every_callback_of_a_tick_runs_before_the_next(simulation):
    class Echo(Node):
        """Answers each pose with a command, in the same tick."""

        def __init__(self):
            super().__init__("echo")
            self.commands = self.create_publisher(Twist, "/turtle1/cmd_vel", 1)
            self.heard = []
            self.create_subscription(Pose, "/turtle1/pose", self.on_pose, 1)

        def on_pose(self, pose):
            self.heard.append((self.get_clock().now().nanoseconds, pose.linear_velocity))
            command = Twist()
            command.linear.x = 0.25 * len(self.heard)
            self.commands.publish(command)

    echo = simulation.add(Echo())
    simulation.step(4)
    assert echo.heard == [(k * 16_000_000, 0.25 * (k - 1)) for k in (1, 2, 3, 4)]


def test_nodes_are_started_with_names_and_parameters(simulation):
    class Configured(Node):
        def __init__(self):
            super().__init__("default_name")
            self.speed = self.declare_parameter("speed", 1.0).value
            self.label = self.declare_parameter("label", "").value

    node = simulation.start(Configured, name="chosen", speed=2.5, label="a: b")
    assert (node.get_name(), node.speed, node.label) == ("chosen", 2.5, "a: b")
    assert node.get_parameter("use_sim_time").value is True
    plain = simulation.add(Configured())
    assert (plain.get_name(), plain.speed) == ("default_name", 1.0)


def test_mistakes_are_named(simulation):
    with pytest.raises(KeyError, match="no turtle named 'turtle9'; the turtles are: turtle1"):
        simulation.pose("turtle9")
    with pytest.raises(ValueError, match="cannot spawn a turtle named 'turtle1'"):
        simulation.spawn("turtle1", x=1.0, y=1.0)


def test_a_node_that_never_rests_is_reported(simulation, monkeypatch):
    monkeypatch.setattr("turtlesim.testing.stage._MOST_CALLBACKS", 200)

    class Restless(Node):
        def __init__(self):
            super().__init__("restless")
            self.to_itself = self.create_publisher(Twist, "/loop", 1)
            self.create_subscription(Twist, "/loop", self.to_itself.publish, 1)
            self.to_itself.publish(Twist())

    simulation.add(Restless())
    with pytest.raises(RuntimeError, match="200 callbacks and did not come to rest"):
        simulation.step()


def test_consecutive_simulations_leave_the_environment():
    before = dict(os.environ)
    for _ in range(2):
        with Simulation() as simulation:
            simulation.step()
    assert dict(os.environ) == before


def test_one_that_fails_to_begin_leaves_nothing_behind(monkeypatch):
    def fail(*_):
        raise RuntimeError("no clock today")

    with monkeypatch.context() as patch:
        patch.setattr(Simulation, "_publish_time", fail)
        with pytest.raises(RuntimeError, match="no clock today"):
            Simulation()
    assert not rclpy.ok()
    with Simulation() as simulation:
        simulation.step()


def test_the_same_bits_in_every_process():
    digests = set()
    for seed in ("1", "2", "3"):
        run = run_python(
            RUN.format(exercise=str(EXERCISE)), env={**os.environ, "PYTHONHASHSEED": seed}
        )
        assert run.stdout.count("Pose(") == 20
        digests.add(hashlib.sha256(run.stdout.encode()).hexdigest())
    assert len(digests) == 1


@pytest.mark.slow
def test_the_exercise_passes_and_a_wrong_solution_fails(tmp_path):
    def grade(folder: Path) -> tuple[int, str]:
        run = subprocess.run(
            [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(folder)],
            capture_output=True,
            text=True,
            check=False,
        )
        return run.returncode, run.stdout

    code, output = grade(EXERCISE)
    assert (code, "3 passed" in output) == (0, True), output
    wrong = tmp_path / "wrong"
    shutil.copytree(EXERCISE, wrong)
    source = (wrong / "follower.py").read_text()
    (wrong / "follower.py").write_text(
        source.replace(
            'lookup_transform("turtle2", "turtle1"', 'lookup_transform("turtle1", "turtle2"'
        )
    )
    code, output = grade(wrong)
    assert code == 1
    assert "failed" in output
