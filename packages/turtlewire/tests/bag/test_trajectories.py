"""Odometry and poses of a bag as trajectories.

The examples of the how-to pages about bags and trajectories, run.
"""

import doctest
import re
import shlex

import numpy as np
import pytest
from tests.bags import SECOND, START, write_bag
from tests.places import HOW_TO

from turtlewire import msg
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.trajectories import pose_topics
from turtlewire.cli.main import main
from turtlewire.errors import BagError
from turtlewire.trajectory import Trajectory

PLACES = {
    "nav_msgs/msg/Odometry": lambda m: (m.pose.pose.position, m.pose.pose.orientation),
    "geometry_msgs/msg/PoseStamped": lambda m: (m.pose.position, m.pose.orientation),
    "geometry_msgs/msg/PoseWithCovarianceStamped": lambda m: (
        m.pose.pose.position,
        m.pose.pose.orientation,
    ),
    "geometry_msgs/msg/TransformStamped": lambda m: (m.transform.translation, m.transform.rotation),
}


def stamped(kind, i):
    message = msg.get_message(kind)()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(
        START + i * 10_000_000 + 7, SECOND
    )
    message.header.frame_id = "odom"
    if hasattr(message, "child_frame_id"):
        message.child_frame_id = "base"
    position, orientation = PLACES[kind](message)
    position.x, position.z = 0.5 * i, 3.0
    orientation.w, orientation.z = 0.8, 0.6
    return message


@pytest.fixture
def path(tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
        for kind in PLACES:
            topic = f"/{kind.rpartition('/')[2].lower()}"
            writer.add_topic(topic, kind)
            for i in (*range(50), 49, 30, *range(200, 250)):
                writer.write(topic, stamped(kind, i), START + i)
    return tmp_path / "made"


@pytest.mark.parametrize("kind", PLACES)
def test_every_type_with_a_pose(path, kind):
    with pytest.warns(UserWarning, match="2 of 102 messages of .* repeat a stamp"):
        trajectory = Trajectory.from_bag(path, f"/{kind.rpartition('/')[2].lower()}")
    assert len(trajectory) == 100
    assert trajectory.stamps_ns[49] == START + 490_000_007
    assert trajectory.poses[49].tolist() == [24.5, 0, 3, 0, 0, 0.6, 0.8]
    assert trajectory.target_frame == "odom"
    assert trajectory.source_frame == ("base" if "Odom" in kind or "Transform" in kind else "")
    assert trajectory.gaps == ((START + 490_000_007, START + 2 * SECOND + 7),)


def test_a_window_and_progress(path):
    shares = []
    part = Trajectory.from_bag(
        path, "/odometry", start_ns=START + 10, end_ns=START + 19, progress=shares.append
    )
    assert part.positions[:, 0].tolist() == [0.5 * i for i in range(10, 20)]
    assert shares[-1] == 1.0


def test_wrong_topics(path):
    with open_bag(path) as bag:
        assert pose_topics(bag) == [
            "/odometry",
            "/posestamped",
            "/posewithcovariancestamped",
            "/transformstamped",
        ]
    with pytest.raises(BagError, match="has no topic /odometri") as error:
        Trajectory.from_bag(path, "/odometri")
    assert "Did you mean: /odometry" in error.value.hint
    with pytest.raises(BagError, match="which has no poses") as error:
        Trajectory.from_bag(path, "/chatter")
    assert "Topics with poses: /odometry" in error.value.hint
    with pytest.raises(BagError, match="no message of /odometry in that time"):
        Trajectory.from_bag(path, "/odometry", end_ns=START - 5)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The files that the pages use: a bag, a circle and two estimates of it."""
    monkeypatch.chdir(tmp_path)
    write_bag(tmp_path / "my_bag")
    angle = np.linspace(0, 2 * np.pi, 500)
    half = angle / 2
    poses = np.zeros((500, 7))
    poses[:, 0], poses[:, 1] = 5 * np.cos(angle), 5 * np.sin(angle)
    poses[:, 5], poses[:, 6] = np.sin(half), np.cos(half)
    stamps = START + np.arange(500) * SECOND // 10
    Trajectory(stamps, poses).save(tmp_path / "truth.tum")
    dice = np.random.default_rng(1)
    for name, size in (("slam_a", 0.02), ("slam_b", 0.06)):
        moved = poses.copy()
        moved[:, :3] += dice.normal(size=(500, 3)) * size + (1, 2, 0)
        Trajectory(stamps, moved).save(tmp_path / f"{name}.tum")
    return tmp_path


@pytest.mark.parametrize(
    ("page", "examples"), [("bags.md", 18), ("notebook.md", 4), ("trajectories.md", 9)]
)
def test_the_examples(folder, page, examples):
    found = doctest.testfile(str(HOW_TO / page), module_relative=False)
    assert found.attempted >= examples
    assert found.failed == 0


@pytest.mark.parametrize(("page", "commands"), [("bags.md", 2), ("trajectories.md", 2)])
def test_the_commands(folder, page, commands, capsys):
    text = (HOW_TO / page).read_text()
    found = []
    for block in re.findall(r"```console\n(.*?)```", text, re.DOTALL):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, expected = part.partition("\n")
            assert main(shlex.split(command)[1:]) == 0
            assert capsys.readouterr().out == expected
            found.append(command)
    assert len(found) == commands
    assert all((folder / name).exists() for name in re.findall(r"\S+\.svg", " ".join(found)))
