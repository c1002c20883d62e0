"""Bags that others recorded, with `rosbags` and evo as the oracles."""

from contextlib import nullcontext

import numpy as np
import pytest
from evo.tools.file_interface import read_bag_trajectory
from rosbags.highlevel import AnyReader
from rosbags.rosbag1 import Reader as Reader1
from rosbags.rosbag2 import Reader as Reader2
from tests.places import ROOT
from tests.rosbags_messages import assert_contains

from ros2cli.main import main as ros2
from turtlewire import Buffer
from turtlewire.bag import merge_bags, open_bag, split_bag
from turtlewire.trajectory import Trajectory

FOLDER = ROOT / "build" / "corpus" / "bags"
FILES = [path for ending in ("bag", "mcap") for path in FOLDER.rglob(f"*.{ending}")]
BAGS = sorted([*FILES, *(path.parent for path in FOLDER.rglob("metadata.yaml"))])

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not BAGS, reason="needs scripts/corpus"),
    pytest.mark.parametrize("path", BAGS, ids=lambda path: path.name),
]


@pytest.fixture(autouse=True)
def all_bags():
    assert len(BAGS) == 5
    assert {path.suffix for path in BAGS} == {".bag", ".mcap", ""}


def reader_of_evo(path):
    return Reader1(path) if path.suffix == ".bag" else Reader2(path)


def expected_messages(path):
    """Topic, time and message; at equal times in the order of the topics."""
    with AnyReader([path]) as reader:
        found = [
            (connection.topic, time, reader.deserialize(data, connection.msgtype))
            for connection, time, data in reader.messages()
        ]
    return sorted(found, key=lambda each: (each[1], each[0]))


def found_messages(path):
    with open_bag(path) as bag:
        found = [(each.topic, each.log_time_ns, each.decode()) for each in bag]
        assert bag.problems == []
    return sorted(found, key=lambda each: (each[1], each[0]))


def assert_same(found, expected):
    assert [each[:2] for each in found] == [each[:2] for each in expected]
    for (topic, _, message), (_, _, other) in zip(found, expected, strict=True):
        assert_contains(message, other, topic)


def test_messages_and_conversions(path, tmp_path):
    expected = expected_messages(path)
    assert len(expected) > 500
    assert_same(found_messages(path), expected)
    source = path
    for number, storage in enumerate(("mcap", "sqlite3", "mcap")):
        target = tmp_path / str(number)
        options = tmp_path / f"{number}.yaml"
        options.write_text(f"output_bags:\n- {{uri: {target}, storage_id: {storage}, all: true}}\n")
        assert ros2(["bag", "convert", "-i", str(source), "-o", str(options)]) == 0
        assert_same(found_messages(target), expected)
        assert_same(expected_messages(target), expected)
        source = target


def test_pieces_are_the_whole(path, tmp_path):
    with open_bag(path) as bag:
        whole = [tuple(message) for message in bag]
    pieces = split_bag(path, tmp_path / "parts", every="10s")
    assert len(pieces.paths) >= 5
    assert pieces.problems == []
    merge_bags(pieces.paths, tmp_path / "again")
    with open_bag(tmp_path / "again") as bag:
        assert sorted(tuple(message) for message in bag) == sorted(whole)


def test_columns_and_trajectories(path):
    poses = 0
    with open_bag(path) as bag, reader_of_evo(path) as reader:
        for topic in bag.metadata.topics:
            if topic.type == "tf2_msgs/msg/TFMessage":
                continue
            poses += 1
            is_deep = topic.type != "geometry_msgs/msg/PoseStamped"
            where = "pose.pose" if is_deep else "pose"
            columns = bag.columns(topic.name, f"{where}.position", f"{where}.orientation")
            theirs = read_bag_trajectory(reader, topic.name)
            assert len(columns.stamps_ns) == topic.message_count == theirs.num_poses
            assert np.array_equal(columns[f"{where}.position"], theirs.positions_xyz)
            xyzw = np.roll(theirs.orientations_quat_wxyz, -1, axis=1)
            assert np.array_equal(columns[f"{where}.orientation"], xyzw)
            assert np.allclose(columns.stamps_ns / 1e9, theirs.timestamps, rtol=0, atol=1e-6)
            _, first = np.unique(columns.stamps_ns, return_index=True)
            has_twins = len(first) < theirs.num_poses
            warned = pytest.warns(UserWarning, match="repeat a stamp")
            with warned if has_twins else nullcontext():
                ours = Trajectory.from_bag(path, topic.name)
            assert np.array_equal(ours.positions, theirs.positions_xyz[first])
    assert poses or "tf_example" in path.name


def test_frames(path):
    with open_bag(path) as bag:
        transforms = bag.topics.keys() & {"/tf", "/tf_static"}
    frames = set()
    with AnyReader([path]) as reader:
        for connection, _, data in reader.messages():
            if connection.topic in transforms:
                for each in reader.deserialize(data, connection.msgtype).transforms:
                    frames |= {each.child_frame_id.lstrip("/"), each.header.frame_id.lstrip("/")}
    if transforms:
        assert set(Buffer.from_bag(path).frames()) == frames
    else:
        assert frames == set()
