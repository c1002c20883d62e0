"""Each type of ROS 1, read by the definition in its bag; `rosbags` is the oracle.

Bags of ROS 1, written by `rosbags`.
"""

import random
from collections import defaultdict

import pytest
from rosbags.convert.converter import migrate_bytes
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tests.bags import SECOND, START
from tests.rosbags_messages import as_mcap, random_message, write_ros1

from turtlewire import Buffer
from turtlewire.bag import copy_bag, describe_bag, open_bag
from turtlewire.cli.main import main
from turtlewire.errors import BagError, InterfaceError
from turtlewire.msg import deserialize, missing_fields, serialize
from turtlewire.trajectory import Trajectory

TF = "tf2_msgs/msg/TFMessage"
ROS1 = get_typestore(Stores.ROS1_NOETIC)
ROS1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TF))
JAZZY = get_typestore(Stores.ROS2_JAZZY)
#: The types of ROS 2, and those of ROS 1 that it does not have.
BOTH = get_typestore(Stores.ROS2_JAZZY)
BOTH.register({k: ([], v[1]) for k, v in ROS1.fielddefs.items() if k not in JAZZY.fielddefs})


def test_each_type_becomes_what_rosbags_makes_of_it(tmp_path):
    names = sorted(ROS1.fielddefs)
    raw = write_ros1(tmp_path / "all.bag", ROS1, names)
    found = defaultdict(list)
    with open_bag(tmp_path / "all.bag") as bag:
        assert bag.problems == []
        for message in bag:
            found[message.topic].append(message)
    counts = {"migrated": 0, "kept": 0}
    for topic, messages in found.items():
        name = messages[0].type
        is_known = name in JAZZY.fielddefs
        for message, data in zip(messages, raw[topic], strict=True):
            expected = migrate_bytes(ROS1, BOTH, name, name, {}, data, src_is2=False, dst_is2=True)
            assert message.data == bytes(expected), name
            assert serialize(message.decode()) == message.data, name
            counts["migrated" if is_known else "kept"] += 1
    assert set(found) == set(raw)
    assert counts["migrated"] > 300
    assert counts["kept"] > 30


@pytest.mark.parametrize(
    ("name", "missing"),
    [
        ("sensor_msgs/msg/Range", ("variance",)),
        ("shape_msgs/msg/SolidPrimitive", ("polygon",)),
        ("sensor_msgs/msg/Image", ()),
    ],
)
def test_a_message_says_what_ros1_does_not_have(tmp_path, name, missing):
    write_ros1(tmp_path / "one.bag", ROS1, [name], each=1)
    with open_bag(tmp_path / "one.bag") as bag:
        (message,) = bag
        plain = deserialize(name, message.data)
        assert missing_fields(plain) == ()
        assert plain == message.decode()
        assert missing_fields(message.decode()) == missing


CUSTOM = """# A type that only the bag knows
Header header
time began
duration took
uint8 idle=0
byte LOW = -1 # a byte has a sign
string HINT = a "b" # no comment
float64[2] X
byte level
char letter
Part[] parts   # with its own
bool class
================================================================================
MSG: my_robot/Part
string child_frame_id
int16[] counts
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
"""


def packed(frame="/base"):
    name = frame.encode()
    head = (7).to_bytes(4, "little") + (5).to_bytes(4, "little") + (6).to_bytes(4, "little")
    text = len(name).to_bytes(4, "little") + name
    times = b"".join(n.to_bytes(4, "little") for n in (1, 2, 3, 4))
    numbers = b"\0" * 8 + (0x3FF0 << 48).to_bytes(8, "little")
    part = text + (1).to_bytes(4, "little") + (9).to_bytes(2, "little")
    return head + text + times + numbers + b"\1\2" + (1).to_bytes(4, "little") + part + b"\1"


def write_custom(path, text=CUSTOM, data=None, latching=None, name="my_robot/msg/status"):
    with Writer(path) as writer:
        connection = writer.add_connection(
            "/status", name, msgdef=text, md5sum="0" * 32, latching=latching
        )
        for number, content in enumerate(data or [packed()]):
            writer.write(connection, START + number, content)


def test_a_type_that_only_the_bag_knows(tmp_path):
    write_custom(tmp_path / "custom.bag", latching=1)
    with open_bag(tmp_path / "custom.bag") as bag:
        (message,) = bag
        status = message.decode()
        assert [qos.durability.name for qos in bag.topics["/status"].qos] == ["TRANSIENT_LOCAL"]
        text = bag.definitions()["my_robot/msg/status"][1]
    assert (status.header.frame_id, status.header.stamp.sec) == ("base", 5)
    assert (status.began.sec, status.began.nanosec, status.took.nanosec) == (1, 2, 4)
    assert (status.X.tolist(), status.level, status.letter) == ([0.0, 1.0], b"\1", 2)
    assert (status.parts[0].child_frame_id, list(status.parts[0].counts)) == ("base", [9])
    assert (status.class_, status.IDLE, status.HINT) == (True, 0, 'a "b" # no comment')
    assert status.LOW == b"\xff"
    assert "builtin_interfaces/Time began" in text
    assert "MSG: my_robot/Part" in text
    assert "MSG: std_msgs/Header" in text
    assert get_types_from_msg(text, "my_robot/msg/status")  # others parse it, too


def test_one_bad_message_does_not_end_the_others(tmp_path):
    good = packed()
    write_custom(tmp_path / "bad.bag", data=[good, good[:-1], good + b"\0", good])
    found = []
    first = f"my_robot/msg/status: its {len(good) - 1} bytes do not follow"
    with (
        open_bag(tmp_path / "bad.bag") as bag,
        pytest.raises(BagError, match=f"left out 2 messages of /status: {first}"),
    ):
        found.extend(bag.messages())
    assert len(found) == 2


def test_a_topic_without_a_readable_definition_is_named(tmp_path):
    write_custom(tmp_path / "odd.bag", text="not a definition\n", name="odd/msg/Thing")

    with open_bag(tmp_path / "odd.bag") as bag:
        assert bag.topics["/status"].serialization_format == "ros1"
        assert "/status is not converted" in bag.problems[0]
        (message,) = bag
        assert message.data == packed()
        with pytest.raises(InterfaceError, match="/status"):
            message.decode()


def test_each_topic_that_loses_messages_is_a_problem_of_the_copy(tmp_path):
    with Writer(tmp_path / "in.bag") as writer:
        for name in ("/one", "/two"):
            text = writer.add_connection(name, "std_msgs/msg/String", typestore=ROS1)
            writer.write(text, START, b"\2\0\0\0hi")
            writer.write(text, START + 1, b"\3\0\0\0hi")
    problems = copy_bag(tmp_path / "in.bag", tmp_path / "out").problems
    assert [each.split(":")[1] for each in problems] == [
        " left out 1 message of /one", " left out 1 message of /two"
    ]  # fmt: skip


def test_messages_of_ros1_in_an_mcap(tmp_path):
    names = ["sensor_msgs/msg/Range", TF, "std_msgs/msg/Empty"]
    write_ros1(tmp_path / "old.bag", ROS1, names)
    path = as_mcap(tmp_path / "old.bag", tmp_path / "old.mcap")
    with open_bag(path) as bag, open_bag(tmp_path / "old.bag") as old:
        assert [tuple(each) for each in bag] == [tuple(each) for each in old]
        assert {each.serialization_format for each in bag.topics.values()} == {"cdr"}
        first = next(bag.messages("/sensor_msgs/Range")).decode()
        assert missing_fields(first) == ("variance",)
        assert bag.definitions() == old.definitions()
    cut = as_mcap(tmp_path / "old.bag", tmp_path / "cut.mcap", lambda data: data[:-1])
    with (
        open_bag(cut) as bag,
        pytest.raises(BagError, match=r"left out 3 messages of /sensor_msgs/Range"),
    ):
        list(bag)


@pytest.mark.parametrize("slashes", ["", "/", "//"])
def test_transforms_of_ros1_lose_their_slashes(tmp_path, slashes):
    one = ROS1.types["geometry_msgs/msg/TransformStamped"]
    message = random_message(ROS1, one.__msgtype__, random.Random(2))
    message.header.frame_id, message.child_frame_id = f"{slashes}map", f"{slashes}base"
    turn = message.transform.rotation
    turn.x, turn.y, turn.z, turn.w = 0.0, 0.0, 0.0, 1.0
    with Writer(tmp_path / "tf.bag") as writer:
        connection = writer.add_connection("/tf", TF, typestore=ROS1)
        writer.write(connection, START, ROS1.serialize_ros1(ROS1.types[TF]([message]), TF))
    for path in (tmp_path / "tf.bag", as_mcap(tmp_path / "tf.bag", tmp_path / "tf.mcap")):
        with open_bag(path) as bag:
            (one,) = next(bag.messages("/tf")).decode().transforms
        assert (one.header.frame_id, one.child_frame_id) == ("map", "base")
        assert sorted(Buffer.from_bag(path).frames()) == ["base", "map"]


def test_mutated_bags_are_read_or_refused(tmp_path):
    names = ["sensor_msgs/msg/Range", "visualization_msgs/msg/Marker", "std_msgs/msg/Empty"]
    write_ros1(tmp_path / "old.bag", ROS1, names)
    whole = (tmp_path / "old.bag").read_bytes()
    generator = random.Random(7)
    read = 0
    for _ in range(300):
        data = bytearray(whole)
        for _ in range(generator.randint(1, 3)):
            at = generator.randrange(13, len(data))
            data[at] = generator.randrange(256)
        (tmp_path / "bad.bag").write_bytes(data)
        try:
            with open_bag(tmp_path / "bad.bag") as bag:
                for message in bag:
                    if bag.topics[message.topic].serialization_format == "cdr":
                        message.decode()
            read += 1
        except BagError:
            pass
    assert read > 50


STORE = get_typestore(Stores.ROS1_NOETIC)
STORE.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TF))


@pytest.fixture
def recorded(tmp_path):
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

    recorded = tmp_path / "old.bag"
    with Writer(recorded) as writer:
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
    return recorded


def test_messages(recorded):
    with open_bag(recorded) as bag:
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


def test_both_ends_of_a_window_belong_to_it(recorded):
    first, last = START + 10_000_000, START + 30_000_000
    with open_bag(recorded) as bag:
        for start, end, count in (
            (first, last, 3),
            (first + 1, last - 1, 1),
            (first, first, 1),
            (first - 1, last + 1, 3),
        ):
            times = [m.log_time_ns for m in bag.messages("/tf", start_ns=start, end_ns=end)]
            assert len(times) == count
            assert all(start <= time <= end for time in times)


def test_transforms_and_poses(recorded):
    buffer = Buffer.from_bag(recorded)
    assert buffer.lookup_transform("odom", "laser", START + 505_000_000).x == pytest.approx(5.55)
    assert buffer.bag_report.messages == 101
    assert Trajectory.from_bag(recorded, "/pose").positions[:, 0].tolist() == [
        0.5 * i for i in range(100)
    ]


def test_a_cut_bag_is_read_to_its_last_whole_chunk(recorded, tmp_path):
    """Without its end, as a killed recorder leaves it, and cut at any byte."""
    whole = recorded.read_bytes()
    cut, counts = tmp_path / "cut.bag", []
    with open_bag(recorded) as bag:
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
    found = describe_bag(tmp_path / "packed.bag")
    assert 0 < found.topics[0].count < 300
    assert "chunk at byte" in found.problems[0]


@pytest.mark.parametrize("words", [("trajectory",), ("compare", "reference.tum")])
def test_commands_that_need_a_topic_list_those_with_poses(
    recorded, tmp_path, monkeypatch, capsys, words
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "reference.tum").write_text("1 0 0 0 0 0 0 1\n")
    assert main([*words, str(recorded)]) == 2
    assert "name a topic, or a target and a source frame. It has topics with poses: /pose;" in (
        capsys.readouterr().err
    )


def test_a_part_is_written_as_a_bag_of_ros2(recorded, tmp_path):
    copy_bag(recorded, tmp_path / "out", start="500ms", tf_at_start=True)
    with open_bag(recorded) as before, open_bag(tmp_path / "out") as after:
        expected = [each for each in before if each.log_time_ns >= START + SECOND // 2]
        assert [tuple(each)[:3] for each in after][1:] == [tuple(each)[:3] for each in expected]
        assert [each.data for each in after][1:] == [each.data for each in expected]
        first = next(iter(after))
        assert first.topic == "/tf_static"
        assert first.decode().transforms[0].child_frame_id == "laser"
