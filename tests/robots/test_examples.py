"""The robots in examples/: they drive and walk."""

import importlib
import math
import re
import signal

import pytest
from tests.places import EXAMPLES, ROS2

ROBOTS = EXAMPLES / "robots"


@pytest.fixture(autouse=True)
def _import_the_examples(monkeypatch):
    monkeypatch.syspath_prepend(str(ROBOTS))


def test_the_walker_walks(run):
    launch = run(ROS2, "launch", ROBOTS / "walker.launch.py")
    launch.wait_for(r"\[robot_state_publisher\]: Robot initialized")
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "odom", "left_front_foot")
    echo.wait_for(r"^- Translation: \[", count=2)
    echo.kill()
    launch.signal_group(signal.SIGINT)
    launch.wait()
    assert "Traceback" not in launch.text
    assert launch.survivors() == []


def test_the_rover_drives(run):
    launch = run(ROS2, "launch", ROBOTS / "rover.launch.py")
    launch.wait_for(r"\[robot_state_publisher\]: Robot initialized")
    twist = "{linear: {x: 1.0}}"
    teleop = run(ROS2, "topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/msg/Twist", twist)
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "odom", "right_wheel")
    echo.wait_for(r"^- Translation: \[0\.[2-9]|^- Translation: \[[1-9]")
    for program in (teleop, echo):
        program.kill()
    launch.signal_group(signal.SIGINT)
    launch.wait()
    assert "Traceback" not in launch.text
    assert launch.survivors() == []


@pytest.mark.parametrize("robot", ["walker", "rover"])
def test_all_joint_states_are_published(robot):
    """robot_state_publisher's default, 20 a second, would drop some and log that it does."""
    period = importlib.import_module(robot).PERIOD
    text = (ROBOTS / f"{robot}.launch.py").read_text()
    frequency = re.search(r'"publish_frequency": ([\d.]+)', text)
    assert frequency is not None
    assert float(frequency[1]) >= 2 / period


def test_a_rover_that_turns_drives_a_circle():
    from rover import Place

    place = Place()
    for _ in range(100):
        place = place.driven(math.pi / 100, 2 * math.pi / 100)
    assert place.x == pytest.approx(0, abs=1e-12)
    assert place.y == pytest.approx(0, abs=1e-12)
    assert place.heading == pytest.approx(2 * math.pi)
    assert Place().driven(2.0, 0.0) == (2.0, 0.0, 0.0)


def test_three_feet_of_the_walker_are_always_on_the_ground():
    from walker import LEGS, LIFT, gait, joint_angles

    for k in range(100):
        angles = joint_angles(k / 100)
        standing = [name for name in LEGS if angles[f"{name}_knee"] == 0]
        assert len(standing) >= 3
        assert all(-LIFT <= angles[f"{name}_knee"] <= 0 for name in LEGS)
    assert gait(0.0) == (1, 0.0)
    assert gait(0.5) == pytest.approx((-1, 0.0))
