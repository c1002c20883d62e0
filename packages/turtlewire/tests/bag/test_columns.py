"""Fields of a topic as arrays, against a plain loop over messages that `rosbags` decodes."""

import random

import numpy as np
import pytest
from mcap.writer import Writer as McapWriter
from rosbags.convert.converter import migrate_bytes
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from tests.bags import SECOND, START
from tests.rosbags_messages import as_mcap, random_message, write_ros1

from turtlewire import msg
from turtlewire.bag import BagWriter, columns, open_bag
from turtlewire.bag.column_fields import ColumnKind, find_field
from turtlewire.errors import BagError, CdrError, InterfaceError
from turtlewire.msg.registry import load_message

JAZZY = get_typestore(Stores.ROS2_JAZZY)
ROS1 = get_typestore(Stores.ROS1_NOETIC)
NAMES = sorted(
    name
    for name in JAZZY.fielddefs
    if name.count("/msg/") and not name.startswith(("std_msgs/msg/Char", "gps_msgs"))
)


def write(path, plugin, names, each=4):
    """Write random messages, each type on its topic; return them as objects of `rosbags`."""
    dice = random.Random(5)
    written = {}
    with Writer(path, version=9, storage_plugin=plugin) as writer:
        for name in names:
            connection = writer.add_connection(f"/{name}", name, typestore=JAZZY)
            written[name] = [random_message(JAZZY, name, dice) for _ in range(each)]
            for number, message in enumerate(written[name]):
                data = JAZZY.serialize_cdr(message, name)
                writer.write(connection, START + number, bytes(data))
    return written


def paths_of(name, prefix=""):
    """The fields of a type that can be columns, at any depth."""
    for field in load_message(name).fields:
        path = prefix + field.name
        inner = getattr(field.type, "full_name", None)
        if inner and inner not in (
            "builtin_interfaces/msg/Time",
            "builtin_interfaces/msg/Duration",
        ):
            yield from paths_of(inner, path + ".")
        yield path


def usable(name):
    found = []
    for path in paths_of(name):
        try:
            found.append(find_field(name, path))
        except BagError as error:
            assert "cannot be a column" in str(error), path  # noqa: PT017
    return found


def loop(messages, field):
    """The values of a field by a loop over the messages of `rosbags`."""
    values = []
    for message in messages:
        value = message
        for part in field.path.split("."):
            value = (
                getattr(value, part, None) if hasattr(value, part) else getattr(value, part + "_")
            )
        if field.kind == ColumnKind.TIME:
            value = value.sec * SECOND + value.nanosec
        elif field.kind == ColumnKind.CLOUD_FIELDS:
            value = [(each.name, each.offset, each.datatype, each.count) for each in value]
        elif field.labels and field.labels[0].startswith("."):
            rows = value if field.kind == ColumnKind.SEQUENCE else [value]
            value = [[_inside(row, label) for label in field.labels] for row in rows]
            value = value if field.kind == ColumnKind.SEQUENCE else value[0]
        values.append(value)
    return values


def _inside(row, label):
    for part in label[1:].split("."):
        row = getattr(row, part)
    return row


def same(array, values):
    assert len(array) == len(values)
    for ours, theirs in zip(array, values, strict=True):
        np.testing.assert_array_equal(np.asarray(ours), np.asarray(theirs).reshape(np.shape(ours)))
    return True


@pytest.mark.slow
@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_each_field_of_each_type_is_what_a_loop_finds(tmp_path, plugin):
    written = write(tmp_path / "all", plugin, NAMES)
    compared = fast = 0
    with open_bag(tmp_path / "all") as bag:
        for name in NAMES:
            for field in usable(name):
                if (name, field.path) == ("sensor_msgs/msg/PointCloud2", "fields"):
                    continue  # it is how `data` finds the layout
                found = bag.columns(f"/{name}", field.path)
                assert same(found[field.path], loop(written[name], field)), (name, field)
                assert found.log_times_ns.tolist() == [START + n for n in range(4)]
                compared += 1
                at = bag, f"/{name}", [field], 0, 2**64 - 1
                slow = columns._read_one_by_one(*at)
                assert same(slow[1][field.path], loop(written[name], field)), (name, field)
                native = columns._read_natively(*at)
                if native is not None:
                    assert native[1][field.path].dtype == slow[1][field.path].dtype
                    fast += 1
    assert compared > 700
    if columns._native_reader():
        assert fast > 0.95 * compared


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_messages_of_ros1(tmp_path, kind):
    name = "sensor_msgs/msg/Range"
    raw = write_ros1(tmp_path / "old.bag", ROS1, [name])["/sensor_msgs/Range"]
    path = tmp_path / "old.bag"
    if kind == "mcap":
        path = as_mcap(path, tmp_path / "old.mcap")
    with open_bag(path) as bag:
        found = bag.columns("/sensor_msgs/Range", "range", "variance", "header.frame_id")
    cdr = [migrate_bytes(ROS1, JAZZY, name, name, {}, d, src_is2=False, dst_is2=True) for d in raw]
    decoded = [JAZZY.deserialize_cdr(data, name) for data in cdr]
    assert found["range"].tolist() == [message.range for message in decoded]
    assert found["variance"].tolist() == [0.0] * len(raw)  # ROS 1 does not have it
    assert found["header.frame_id"].tolist() == [message.header.frame_id for message in decoded]


def test_an_older_definition_is_read_by_its_fields(tmp_path):
    foxy = get_typestore(Stores.ROS2_FOXY)
    name, dice = "visualization_msgs/msg/Marker", random.Random(1)
    with Writer(tmp_path / "foxy", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/marker", name, typestore=foxy)
        messages = [random_message(foxy, name, dice) for _ in range(5)]
        for number, message in enumerate(messages):
            writer.write(connection, START + number, bytes(foxy.serialize_cdr(message, name)))
    with open_bag(tmp_path / "foxy") as bag:
        found = bag.columns("/marker", "text", "scale", "mesh_file.filename", "points")
    assert found["text"].tolist() == [message.text for message in messages]
    assert found["scale"].tolist() == [[m.scale.x, m.scale.y, m.scale.z] for m in messages]
    assert found["mesh_file.filename"].tolist() == [""] * 5
    assert [len(each) for each in found["points"]] == [len(m.points) for m in messages]


@pytest.fixture
def robot(tmp_path):
    """A bag in two files whose times overlap, with IMU, camera, lidar and a text."""
    imu, image, cloud, field, text = (
        msg.get_message(name)
        for name in (
            "sensor_msgs/msg/Imu",
            "sensor_msgs/msg/Image",
            "sensor_msgs/msg/PointCloud2",
            "sensor_msgs/msg/PointField",
            "std_msgs/msg/String",
        )
    )
    path = tmp_path / "robot"
    with BagWriter(path) as writer:
        for k in (0, 2, 1, 3):
            one = imu()
            one.header.stamp.sec, one.header.frame_id = 100 + k, "imu"
            one.linear_acceleration.x, one.orientation.w = float(k), 1.0
            writer.write("/imu", one, START + k * SECOND)
            writer.write("/text", text(data=f"number {k}"), START + k * SECOND)
        picture = image(height=2, width=3, encoding="bgr8", step=12, data=range(24))
        writer.write("/image", picture, START)
        picture.encoding, picture.step, picture.is_bigendian = "16UC1", 12, 1
        writer.write("/image", picture, START + 1)
        picture.encoding = "new"
        writer.write("/image", picture, START + 2)
        points = np.arange(8, dtype="<f4").reshape(2, 4).tobytes()
        layout = [field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("xyz")]
        one = cloud(height=1, width=2, fields=layout, point_step=16, row_step=32, data=points)
        writer.write("/cloud", one, START)
        one.height, one.width, one.row_step = 2, 1, 16
        writer.write("/cloud", one, START + 1)
        one.width = 1000
        writer.write("/cloud", one, START + 2)
    return path


def test_columns_of_numbers(robot):
    with open_bag(robot) as bag:
        imu = bag.columns("/imu", "linear_acceleration.x", "orientation", "orientation_covariance")
    assert imu.stamps_ns.tolist() == [k * SECOND for k in range(100, 104)]
    assert imu.log_times_ns.tolist() == [START + k * SECOND for k in range(4)]
    assert imu["linear_acceleration.x"].tolist() == [0.0, 1.0, 2.0, 3.0]
    assert imu["orientation"].tolist() == [[0.0, 0.0, 0.0, 1.0]] * 4
    assert imu["orientation_covariance"].shape == (4, 9)
    imu["linear_acceleration.x"][0] = 5.0  # it is the caller's own
    assert list(imu) == ["linear_acceleration.x", "orientation", "orientation_covariance"]
    assert repr(imu).startswith("<Columns of /imu, sensor_msgs/msg/Imu: linear_acceleration.x (4,)")
    with pytest.raises(KeyError, match=r"was not read from /imu. Did you mean: orientation"):
        imu["orientatoin"]


def test_a_window_and_types_without_a_header(robot):
    with open_bag(robot) as bag:
        text = bag.columns("/text", "data", start_ns=START + 1, end_ns=START + 2 * SECOND)
        assert text["data"].tolist() == ["number 1", "number 2"]
        assert text.stamps_ns.tolist() == text.log_times_ns.tolist()
        before = START - 1
        assert len(bag.columns("/imu", "header.stamp", end_ns=before)["header.stamp"]) == 0
        assert bag.columns("/imu", "orientation", end_ns=before)["orientation"].shape == (0, 4)
        with pytest.raises(ValueError, match="end_ns is 5, but the bag covers"):
            bag.columns("/imu", "orientation", end_ns=5)


def test_images_and_clouds_share_the_memory_of_their_messages(robot):
    with open_bag(robot) as bag:
        color, deep, unknown = bag.columns("/image", "data")["data"]
        line, organized, wrong = bag.columns("/cloud", "data")["data"]
    assert (color.shape, color[1, 2].tolist()) == ((2, 3, 3), [18, 19, 20])
    assert (deep.shape, int(deep[1, 2])) == ((2, 3), 16 * 256 + 17)
    assert (unknown.shape, unknown.dtype) == ((24,), np.uint8)
    assert (line.shape, line.dtype.names, line["z"].tolist()) == ((2,), ("x", "y", "z"), [2, 6])
    assert (organized.shape, organized["x"].tolist()) == ((2, 1), [[0], [4]])
    assert (wrong.shape, wrong.dtype) == ((32,), np.uint8)
    for array in (color, deep, line, organized):
        assert not array.flags.writeable
        assert array.base is not None


def test_the_names_of_joints_are_lists_of_their_own(tmp_path):
    joint_state = msg.get_message("sensor_msgs/msg/JointState")
    names = [["turn", "s\u00e9"], ["turn", "s\u00e9"], [], [""], ["a", "bcd", "efgh"]]
    with BagWriter(tmp_path / "arm") as writer:
        for number, each in enumerate(names):
            writer.write("/joint_states", joint_state(name=each), START + number)
    with open_bag(tmp_path / "arm") as bag:
        found = bag.columns("/joint_states", "name", "position")["name"]
        native = columns._read_natively(
            bag, "/joint_states", [find_field("sensor_msgs/msg/JointState", "name")], 0, 2**64 - 1
        )
    assert found.tolist() == names
    assert found[0] is not found[1]
    assert (native is not None) == (columns._native_reader() is not None)


def test_a_data_frame(robot):
    with open_bag(robot) as bag:
        frame = bag.columns("/imu", "orientation", "header.frame_id").to_pandas()
    names = [*(f"orientation.{axis}" for axis in "xyzw"), "header.frame_id"]
    assert list(frame.columns) == names
    assert frame.index[0].isoformat() == "1970-01-01T00:01:40+00:00"
    assert frame["header.frame_id"].tolist() == ["imu"] * 4


@pytest.mark.parametrize(
    ("topic", "fields", "error", "text", "hint"),
    [
        ("/imi", ["x"], BagError, "the bag has no topic '/imi'", "/imu"),
        ("/imu", [], ValueError, "sensor_msgs/msg/Imu has header, orientation", ""),
        ("/imu", ["orientaton"], BagError, "has no field 'orientaton'", "orientation"),
        ("/imu", ["orientation.q"], BagError, "Quaternion has no field 'q'", "orientation.w"),
        ("/imu", ["header"], BagError, "which cannot be a column", "header.frame_id"),
        ("/imu", ["header.frame_id.x"], BagError, "has no fields", ""),
        ("/imu", [""], BagError, "has no field ''", "angular_velocity"),
        ("/cloud", ["fields.name"], BagError, "which has no fields", ""),
    ],
)
def test_a_wrong_name_is_explained(robot, topic, fields, error, text, hint):
    with open_bag(robot) as bag, pytest.raises(error, match=text) as found:
        bag.columns(topic, *fields)
    assert hint in getattr(found.value, "hint", "")


def test_damaged_messages_and_other_encodings(tmp_path):
    path = tmp_path / "bad"
    imu = msg.serialize(msg.get_message("sensor_msgs/msg/Imu")())
    with BagWriter(path) as writer:
        writer.add_topic("/imu", "sensor_msgs/msg/Imu")
        writer.write("/imu", imu, START)
        writer.write("/imu", imu[:40], START + 1)
    with open_bag(path) as bag, pytest.raises(CdrError, match="sensor_msgs/msg/Imu"):
        bag.columns("/imu", "linear_acceleration.x")
    with (tmp_path / "json.mcap").open("wb") as file:
        other = McapWriter(file)
        other.start()
        schema = other.register_schema("my/msg/Thing", "jsonschema", b"{}")
        other.add_message(other.register_channel("/json", "json", schema), 5, b"{}", 5)
        other.finish()
    error = pytest.raises(InterfaceError, match="its messages are in json")
    with open_bag(tmp_path / "json.mcap") as bag, error:
        bag.columns("/json", "x")


@pytest.mark.parametrize(
    ("type_name", "field"),
    [("std_msgs/msg/String", "data"), ("sensor_msgs/msg/JointState", "name")],
)
def test_a_text_that_is_not_utf_8_is_named(tmp_path, type_name, field):
    text = "four" if field == "data" else ["four"]
    data = msg.serialize(msg.get_message(type_name)(**{field: text}))
    with BagWriter(tmp_path / "bad") as writer:
        writer.add_topic("/text", type_name)
        writer.write("/text", data.replace(b"four", b"\xff\xfe\xfd\xfc"), START)
    with open_bag(tmp_path / "bad") as bag, pytest.raises(CdrError, match=f"field '{field}"):
        bag.columns("/text", field)


def test_big_endian_messages(tmp_path):
    name = "geometry_msgs/msg/PointStamped"
    message = random_message(JAZZY, name, random.Random(3))
    with BagWriter(tmp_path / "big") as writer:
        writer.add_topic("/p", name)
        writer.write("/p", bytes(JAZZY.serialize_cdr(message, name, little_endian=False)), START)
        writer.write("/p", bytes(JAZZY.serialize_cdr(message, name)), START + 1)
    with open_bag(tmp_path / "big") as bag:
        point = message.point
        assert bag.columns("/p", "point")["point"].tolist() == [[point.x, point.y, point.z]] * 2
