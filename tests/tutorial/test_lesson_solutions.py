"""The solutions of the lessons in the tab: the same files, launched for real on the wire."""

from __future__ import annotations

import json
import math
import signal
import sys
from pathlib import Path

import pytest

from turtle_lesson.lesson import load_lesson
from turtlewire import Buffer
from turtlewire.tf.listener import TransformListener

pytestmark = [pytest.mark.slow, pytest.mark.timeout(300)]
ROOT = Path(__file__).parents[2]
LESSONS = ROOT / "site" / "lesson" / "lessons"
ROS2 = Path(sys.executable).parent / "ros2"
PACKAGE = ROOT / "ros2_ws" / "src" / "learning_tf2_py"
LONG_NS = 60_000_000_000
MIDDLE = 499 / 90  # where turtle1 stands
LAUNCH = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(package="turtlesim", executable="turtlesim_node", name="sim"),
        {actions}
    ])
"""


def launch_file_of(lesson, folder):
    """Write the solution and a launch file that starts what the lesson starts."""
    actions = []
    for turtle in lesson.turtles:
        place = {"x": turtle.x, "y": turtle.y, "theta": turtle.theta, "name": turtle.name}
        call = [str(ROS2), "service", "call", "/spawn", "turtlesim/srv/Spawn", json.dumps(place)]
        actions.append(f"ExecuteProcess(cmd={call})")
    for program in lesson.programs:
        arguments = list(program.arguments)
        if program.source in lesson.files:
            start = f"executable={sys.executable!r}"
            arguments.insert(0, str(folder / program.source))
        else:
            package, executable = program.source.split(".")
            start = f"package={package!r}, executable={executable!r}"
        name = f", name={program.name!r}" if program.name else ""
        parameters = dict(program.parameters)
        actions.append(f"Node({start}{name}, arguments={arguments}, parameters=[{parameters}])")
    for file, source in lesson.sources("solution").items():
        (folder / file).write_text(source, encoding="utf-8")
    path = folder / "lesson.launch.py"
    path.write_text(LAUNCH.format(actions=",\n        ".join(actions)), encoding="utf-8")
    return path


class Scene:
    """What a check looks at: the turtles, and TF."""

    def __init__(self, turtles, buffer):
        self.turtles = turtles
        self.buffer = buffer

    def place(self, target, source):
        """Where `source` is as `target` sees it, as soon as TF knows."""
        return self.buffer.lookup_transform(target, source, 0, LONG_NS)

    def wait_for_gap(self, is_right, other=(MIDDLE, MIDDLE)):
        """Wait until turtle2's distance from a place satisfies a condition."""
        poses = self.turtles.poses

        def gap():
            turtle2 = poses.get("turtle2")
            return math.inf if turtle2 is None else math.dist((turtle2.x, turtle2.y), other)

        self.turtles.wait_for(lambda: is_right(gap()))


def check_static(scene):
    tower = scene.place("world", "tower")
    assert tower.translation == pytest.approx((2.0, 8.0, 0.0))
    assert tower.rotation == pytest.approx((0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))


def check_broadcaster(scene):
    for turtle in ("turtle1", "turtle2"):
        nose = scene.place(turtle, f"{turtle}_nose")
        assert nose.translation == pytest.approx((0.5, 0.0, 0.0), abs=1e-6)
    scene.wait_for_gap(lambda gap: gap < 0.5)


def check_listener(scene):
    scene.wait_for_gap(lambda gap: gap < 2.0)
    still = scene.turtles.poses
    scene.turtles.wait_for(lambda: still["turtle2"].linear_velocity < 0.001)
    scene.wait_for_gap(lambda gap: abs(gap - 1.0) < 0.15)


def check_fixed_carrot(scene):
    assert scene.place("turtle1", "carrot1").translation == pytest.approx((-1.0, 0.0, 0.0))
    scene.wait_for_gap(lambda gap: gap < 0.5, (MIDDLE - 1.0, MIDDLE))


def check_dynamic_carrot(scene):
    first = scene.place("turtle1", "carrot1").translation
    assert math.hypot(*first) == pytest.approx(2.0, abs=0.1)

    def has_turned_left():
        x, y, _ = scene.place("turtle1", "carrot1").translation
        turned = math.atan2(y, x) - math.atan2(first[1], first[0])
        return 0.5 < math.remainder(turned, math.tau) < 2.0

    scene.turtles.wait_for(has_turned_left)


def check_following(scene):
    scene.wait_for_gap(lambda gap: gap < 0.7)


CHECKS = {
    "static": check_static,
    "broadcaster": check_broadcaster,
    "listener": check_listener,
    "fixed_carrot": check_fixed_carrot,
    "dynamic_carrot": check_dynamic_carrot,
    "time_travel": check_following,
    "faults": check_following,
}


def test_each_lesson_has_a_check():
    assert list(CHECKS) == json.loads((LESSONS / "order.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", CHECKS)
def test_a_solution_runs_on_the_wire(name, run, workspace, turtles, tmp_path):
    path = launch_file_of(load_lesson(LESSONS / name), tmp_path)
    launch = run(ROS2, "launch", path, environment=workspace(PACKAGE))
    with TransformListener(buffer := Buffer(), turtles.node, context=turtles.context):
        CHECKS[name](Scene(turtles, buffer))
    launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0
    assert launch.survivors() == []
    assert "Traceback" not in launch.text
