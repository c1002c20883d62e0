"""Bags of ROS 1 through `rosbags`."""

from __future__ import annotations

import sys

import pytest
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tests.bags import SECOND, START

from turtlewire import Buffer
from turtlewire.bag import load_trajectory, open_bag
from turtlewire.errors import BagError

TF = "tf2_msgs/msg/TFMessage"
STORE = get_typestore(Stores.ROS1_NOETIC)
STORE.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TF))


@pytest.fixture
def path(tmp_path):
    types = STORE.types
    header, vector, quaternion, stamp = (
        types[name]
        for name in (
            "std_msgs/msg/Header",
            "geometry_msgs/msg/Vector3",
            "geometry_msgs/msg/Quaternion",
            "builtin_interfaces/msg/Time",
        )
    )

    def head(i, frame):
        return header(i, stamp(*divmod(START + i * 10_000_000, SECOND)), frame)

    def tf(i, parent, child):
        pose = types["geometry_msgs/msg/Transform"](
            vector(0.1 * i, 0, 0), quaternion(0.0, 0.0, 0.0, 1.0)
        )
        one = types["geometry_msgs/msg/TransformStamped"](head(i, parent), child, pose)
        return types[TF]([one])

    path = tmp_path / "old.bag"
    with Writer(path) as writer:
        kinds = {"/tf": TF, "/tf_static": TF}
        kinds |= {"/pose": "geometry_msgs/msg/PoseStamped", "/text": "std_msgs/msg/String"}
        connections = {
            topic: writer.add_connection(topic, kind, typestore=STORE)
            for topic, kind in kinds.items()
        }

        def write(topic, i, message):
            data = STORE.serialize_ros1(message, kinds[topic])
            writer.write(connections[topic], START + i * 10_000_000, data)

        write("/tf_static", 0, tf(5, "base", "laser"))
        for i in range(100):
            write("/tf", i, tf(i, "odom", "base"))
            pose = types["geometry_msgs/msg/Pose"](
                types["geometry_msgs/msg/Point"](0.5 * i, 0, 0), quaternion(0.0, 0.0, 0.0, 1.0)
            )
            write("/pose", i, types["geometry_msgs/msg/PoseStamped"](head(i, "map"), pose))
        write("/text", 100, types["std_msgs/msg/String"]("hello"))
    return path


def test_messages(path):
    with open_bag(path) as bag:
        assert bag.metadata.storage == "ros1"
        assert {name: topic.message_count for name, topic in bag.topics.items()} == {
            "/tf": 100,
            "/tf_static": 1,
            "/pose": 100,
            "/text": 1,
        }
        assert len(list(bag)) == len(bag) == 202
        (text,) = bag.messages("/text")
        assert text.decode().data == "hello"
        assert len(list(bag.messages("/tf", start_ns=START + SECOND // 2))) == 50


def test_transforms_and_poses(path):
    buffer = Buffer.from_bag(path)
    assert buffer.lookup_transform("odom", "laser", START + 505_000_000).x == pytest.approx(5.55)
    assert buffer.bag_report.messages == 101
    assert load_trajectory(path, "/pose").positions[:, 0].tolist() == [0.5 * i for i in range(100)]


def test_a_damaged_bag_and_a_missing_package(path, monkeypatch):
    whole = path.read_bytes()
    for length in range(20, len(whole), len(whole) // 40):
        path.write_bytes(whole[:length])
        try:
            Buffer.from_bag(path)
        except BagError as error:
            said = str(error)
            assert said
    path.write_bytes(whole)
    monkeypatch.setitem(sys.modules, "rosbags.rosbag1", None)
    with pytest.raises(BagError, match="is a bag of ROS 1") as error:
        open_bag(path)
    assert "turtlewire[ros1]" in error.value.hint
