"""The files of the lesson in the browser, unchanged, by `ros2 launch` and on the wire."""

from __future__ import annotations

import shutil
import signal

import pytest
from tests.places import LESSONS, ROOT, ROS2

from turtle_lesson.lesson import load_lesson

VERBATIM = ROOT / "tests" / "tutorial" / "verbatim" / "learning_tf2_py"
SPAWN = "{x: 4.0, y: 2.0, theta: 0.0, name: 'turtle2'}"


@pytest.mark.slow
def test_a_solution_of_the_lesson_does_the_same_when_it_is_launched(
    run, workspace, turtles, tmp_path
):
    package = tmp_path / "learning_tf2_py"
    shutil.copytree(VERBATIM, package, ignore=shutil.ignore_patterns("__pycache__"))
    for name, text in load_lesson(LESSONS / "listener").solution().items():
        (package / "learning_tf2_py" / name).write_text(text, encoding="utf-8")
    launch = run(
        ROS2, "launch", package.name, "turtle_tf2_demo.launch.py", environment=workspace(package)
    )
    launch.wait_for("Spawning turtle")
    spawn = run(ROS2, "service", "call", "/spawn", "turtlesim/srv/Spawn", SPAWN)
    assert spawn.wait() == 0, spawn.text

    def keeps_its_distance():
        follower = turtles.poses.get("turtle2")
        return (
            follower is not None
            and abs(turtles.distance() - 1.0) < 0.15
            and abs(follower.linear_velocity) < 0.1
        )

    turtles.wait_for(keeps_its_distance)
    launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0
    assert "Traceback" not in launch.text
