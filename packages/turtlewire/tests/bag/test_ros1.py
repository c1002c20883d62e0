"""Bags of ROS 1, written by `rosbags`."""

from __future__ import annotations

import pytest
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tests.bags import SECOND, START

from turtlewire import Buffer
from turtlewire.bag import copy_bag, open_bag
from turtlewire.cli.main import main
from turtlewire.errors import BagError
from turtlewire.trajectory import Trajectory

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


def test_both_ends_of_a_window_belong_to_it(path):
    first, last = START + 10_000_000, START + 30_000_000
    with open_bag(path) as bag:
        for start, end, count in (
            (first, last, 3),
            (first + 1, last - 1, 1),
            (first, first, 1),
            (first - 1, last + 1, 3),
        ):
            times = [m.log_time_ns for m in bag.messages("/tf", start_ns=start, end_ns=end)]
            assert len(times) == count
            assert all(start <= time <= end for time in times)


def test_transforms_and_poses(path):
    buffer = Buffer.from_bag(path)
    assert buffer.lookup_transform("odom", "laser", START + 505_000_000).x == pytest.approx(5.55)
    assert buffer.bag_report.messages == 101
    assert Trajectory.from_bag(path, "/pose").positions[:, 0].tolist() == [
        0.5 * i for i in range(100)
    ]


def test_a_cut_bag_is_read_to_its_last_whole_chunk(path, tmp_path):
    """Without its end, as a killed recorder leaves it, and cut at any byte."""
    whole = path.read_bytes()
    cut, counts = tmp_path / "cut.bag", []
    with open_bag(path) as bag:
        everything = list(bag)
    cut.write_bytes(whole[:100])  # not even the header of the bag
    with pytest.raises(BagError, match="is not a bag of ROS 1"):
        open_bag(cut)
    for length in [*range(5000, len(whole), len(whole) // 40), len(whole) - 1]:
        cut.write_bytes(whole[:length])
        with open_bag(cut) as bag:
            found = list(bag)
            assert len(found) == len(bag)
            assert bag.problems, length
        assert found == everything[: len(found)]
        counts.append(len(found))
    assert counts == sorted(counts)
    assert len(set(counts)) > 20  # of one chunk, as far as whole messages lie in it
    assert counts[-1] == len(everything)
    offset = whole.index(b"index_pos=") + len(b"index_pos=")
    cut.write_bytes(whole[:offset] + bytes(8) + whole[offset + 8 :])
    with open_bag(cut) as bag:  # a recorder fills this in when it closes the bag
        assert list(bag) == everything
        assert bag.problems == []


@pytest.mark.parametrize("kind", [Writer.CompressionFormat.BZ2, Writer.CompressionFormat.LZ4])
def test_compressed_chunks(tmp_path, kind):
    writer = Writer(tmp_path / "packed.bag")
    writer.set_compression(kind)
    with writer:
        connection = writer.add_connection("/text", "std_msgs/msg/String", typestore=STORE)
        text = STORE.types["std_msgs/msg/String"]("a" * 5000)
        for number in range(300):
            data = STORE.serialize_ros1(text, "std_msgs/msg/String")
            writer.write(connection, START + number, data)
    with open_bag(tmp_path / "packed.bag") as bag:
        assert [message.log_time_ns - START for message in bag] == list(range(300))
        assert next(iter(bag)).decode().data == "a" * 5000
    damaged = bytearray((tmp_path / "packed.bag").read_bytes())
    assert len(damaged) < 200_000
    at = damaged.index(b"compression=") + 200
    damaged[at : at + 8] = bytes(8)
    (tmp_path / "packed.bag").write_bytes(damaged)
    with open_bag(tmp_path / "packed.bag") as bag, pytest.raises(BagError, match="chunk at byte"):
        list(bag)


@pytest.mark.parametrize("words", [("trajectory",), ("compare", "reference.tum")])
def test_commands_that_need_a_topic_list_those_with_poses(
    path, tmp_path, monkeypatch, capsys, words
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "reference.tum").write_text("1 0 0 0 0 0 0 1\n")
    assert main([*words, str(path)]) == 2
    assert "name a topic, or a target and a source frame. It has topics with poses: /pose;" in (
        capsys.readouterr().err
    )


def test_a_part_is_written_as_a_bag_of_ros2(path, tmp_path):
    copy_bag(path, tmp_path / "out", start="500ms", tf_at_start=True)
    with open_bag(path) as before, open_bag(tmp_path / "out") as after:
        expected = [each for each in before if each.log_time_ns >= START + SECOND // 2]
        assert [tuple(each)[:3] for each in after][1:] == [tuple(each)[:3] for each in expected]
        assert [each.data for each in after][1:] == [each.data for each in expected]
        first = next(iter(after))
        assert first.topic == "/tf_static"
        assert first.decode().transforms[0].child_frame_id == "laser"
