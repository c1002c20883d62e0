"""The robots in examples/ drive and walk; the examples of the how-to page about joints run."""

import importlib
import math
import re
import shutil
import time
from functools import partial

import pytest
from tests.how_to import blocks, wait_until_printed
from tests.places import EXAMPLES, HOW_TO, PATH, ROS2

from joint_state_publisher.description import JointOptions, read_joints

ROBOTS = EXAMPLES / "robots"
PAGE = HOW_TO / "robots.md"
#: Commands that the page shows without running them.
ONLY_SHOWN = ("ros2 launch urdf_tutorial", "ros2 launch examples/robots/walker")


@pytest.fixture(autouse=True)
def _import_the_examples(monkeypatch):
    monkeypatch.syspath_prepend(str(ROBOTS))


@pytest.fixture
def robots(tmp_path):
    """A copy of the robots in a folder with a space."""
    return shutil.copytree(ROBOTS, tmp_path / "my robots")


def test_the_walker_walks(run, robots):
    launch = run(ROS2, "launch", robots / "walker.launch.py")
    launch.wait_for(r"\[robot_state_publisher\]: Robot initialized")
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "odom", "left_front_foot")
    echo.wait_for(r"^- Translation: \[", count=2)
    echo.kill()
    launch.end()


def test_the_rover_drives(run, robots):
    launch = run(ROS2, "launch", robots / "rover.launch.py")
    launch.wait_for(r"\[robot_state_publisher\]: Robot initialized")
    twist = "{linear: {x: 1.0}}"
    teleop = run(ROS2, "topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/msg/Twist", twist)
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "odom", "right_wheel")
    echo.wait_for(r"^- Translation: \[0\.[2-9]|^- Translation: \[[1-9]")
    for program in (teleop, echo):
        program.kill()
    launch.end()


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


@pytest.mark.slow
def test_the_page_does_what_it_says(run, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", PATH)
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    folder = tmp_path / "my lamp"
    folder.mkdir()
    monkeypatch.chdir(folder)
    names = iter(re.findall(r"^Save this as `(\S+)`:$", PAGE.read_text(), re.MULTILINE))
    background = []
    checked = 0
    for kind, text in blocks(PAGE.read_text()):
        if kind in {"xml", "python"}:
            (folder / next(names)).write_text(text)
        elif kind == "sh":
            for line in text.splitlines():
                if line.endswith(" &"):
                    background.append(run("bash", "-c", f"exec {line.removesuffix(' &')}"))
                else:
                    printed(run, line)
        elif not text.startswith(ONLY_SHOWN):
            wait_until_printed(text, partial(printed, run, line))
            checked += 1
    assert checked == 2
    background[-1].wait_for(r"The joints' sliders are at http://127\.0\.0\.1:\d+/")
    assert not list(names)


def printed(run, line: str) -> str:
    program = run("bash", "-c", f"exec {line}")
    assert program.wait() == 0, program.text
    return "".join(f"{text}\n" for text in program.text.splitlines() if "[INFO]" not in text)


def test_the_table_names_every_parameter(run, tmp_path):
    model = tmp_path / "one.urdf"
    model.write_text("<robot name='a'><joint name='j' type='continuous'/></robot>")
    assert read_joints(model.read_text(), JointOptions({}, {}), print).order == ["j"]
    node = run(ROS2, "run", "joint_state_publisher", "joint_state_publisher", model)
    limit = time.monotonic() + 60
    while (listing := run(ROS2, "param", "list", "/joint_state_publisher")).wait() != 0:
        assert time.monotonic() < limit, node.text  # until the node is there
    table = PAGE.read_text().replace("`_velocities`", "`publish_default_velocities`")
    table = table.replace("`_efforts`", "`publish_default_efforts`")
    own = {name.strip() for name in listing.text.splitlines()} - {
        "use_sim_time",
        "start_type_description_service",
    }
    assert own
    assert all(f"`{name}`" in table for name in own), own
