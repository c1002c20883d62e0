"""Messages that a bag defines otherwise than we do, as other releases of ROS 2 did."""

from __future__ import annotations

import copy
import pickle
import random
import sqlite3

import pytest
from rosbags.convert.converter import migrate_bytes
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tests.bags import START
from tests.rosbags_messages import random_message

from turtlewire import msg
from turtlewire.bag import open_bag
from turtlewire.bag.definitions import has_interface
from turtlewire.errors import CdrError

JAZZY = get_typestore(Stores.ROS2_JAZZY)
OTHERS = [each for each in Stores if each.name.startswith("ROS2_") and each.name != "ROS2_JAZZY"]
RANGE = "sensor_msgs/msg/Range"
MARKERS = "visualization_msgs/msg/MarkerArray"
TEXTURES = tuple(
    f"markers.{name}" for name in ("texture_resource", "texture", "uv_coordinates", "mesh_file")
)


def write_bag(path, store, messages, storage=StoragePlugin.MCAP):
    """Write messages of `rosbags`, each on a topic named after its type; return the bytes."""
    written = {}
    with Writer(path, version=9, storage_plugin=storage) as writer:
        for number, (name, message) in enumerate(messages):
            topic = "/" + name.replace("/msg/", "/")
            connection = writer.add_connection(topic, name, typestore=store)
            written[topic] = bytes(store.serialize_cdr(message, name))
            writer.write(connection, START + number, written[topic])
    return written


@pytest.mark.parametrize("storage", list(StoragePlugin))
@pytest.mark.parametrize("release", OTHERS)
def test_each_type_of_each_release(tmp_path, release, storage):
    store = get_typestore(release)
    generator = random.Random(release.name)
    names = [
        name for name in sorted(store.fielddefs) if name in JAZZY.fielddefs and has_interface(name)
    ]
    messages = [(name, random_message(store, name, generator)) for name in names]
    written = write_bag(tmp_path / "bag", store, messages, storage)
    count = 0
    with open_bag(tmp_path / "bag") as bag:
        for message in bag:
            data = written[message.topic]
            assert message.data == data
            if message.type.startswith("rmw_dds_common/"):  # their Gid has another size
                continue
            expected = migrate_bytes(
                store, JAZZY, message.type, message.type, {}, data, src_is2=True, dst_is2=True
            )
            decoded = message.decode()
            if message.type == "lifecycle_msgs/msg/TransitionEvent":  # its time has another type
                decoded.timestamp = JAZZY.deserialize_cdr(expected, message.type).timestamp
            else:
                assert message.upgraded_data() == bytes(expected), message.type
            assert msg.serialize(decoded) == bytes(expected), message.type
            count += 1
    assert count > 100


def foxy(name, seed=3):
    store = get_typestore(Stores.ROS2_FOXY)
    generator = random.Random(seed)
    message = random_message(store, name, generator)
    while name == MARKERS and len(message.markers) != 2:
        message = random_message(store, name, generator)
    return store, message


@pytest.mark.parametrize(("name", "missing"), [(RANGE, ("variance",)), (MARKERS, TEXTURES)])
@pytest.mark.parametrize("storage", list(StoragePlugin))
def test_the_object_says_which_fields_were_missing(tmp_path, name, missing, storage):
    store, message = foxy(name)
    write_bag(tmp_path / "bag", store, [(name, message)], storage)
    with open_bag(tmp_path / "bag") as bag:
        (found,) = bag
    decoded = found.decode()
    assert isinstance(decoded, msg.get_message(name))
    assert msg.missing_fields(decoded) == missing
    assert copy.deepcopy(decoded) == decoded == pickle.loads(pickle.dumps(found)).decode()
    if name == MARKERS:
        assert msg.missing_fields(decoded.markers[1]) == tuple(each[8:] for each in missing)
    assert msg.missing_fields(msg.get_message(name)()) == ()


def without_definitions(path):
    """Make a sqlite3 bag one of Foxy, which has no definitions."""
    database = sqlite3.connect(next(path.glob("*.db3")))
    database.execute("DROP TABLE message_definitions")
    database.execute("DROP TABLE schema")
    database.commit()
    database.close()


@pytest.mark.parametrize("name", [RANGE, MARKERS, "shape_msgs/msg/SolidPrimitive"])
def test_a_bag_without_definitions(tmp_path, name):
    store, message = foxy(name)
    data = write_bag(tmp_path / "bag", store, [(name, message)], StoragePlugin.SQLITE3)
    without_definitions(tmp_path / "bag")
    with open_bag(tmp_path / "bag") as bag:
        (found,) = bag
        assert bag.definitions() == {}
    assert msg.missing_fields(found.decode())
    (raw,) = data.values()
    expected = migrate_bytes(store, JAZZY, name, name, {}, raw, src_is2=True, dst_is2=True)
    assert found.upgraded_data() == bytes(expected)


def test_bytes_that_are_neither_ours_nor_older_are_refused():
    data = msg.serialize(msg.get_message(RANGE)(range=5.0))
    with pytest.raises(CdrError, match="field 'variance' at offset"):
        msg.deserialize(RANGE, data[:-1])
    assert msg.missing_fields(msg.deserialize(RANGE, data[:-4])) == ("variance",)
    with pytest.raises(CdrError, match="field 'range' at offset"):
        msg.deserialize(RANGE, data[:-5])


CHANGED = """int32 count
float32 share
string[] names
Old[2] pair
uint8[4] raw
int64 large
string only_theirs
string became_number
================================================================================
MSG: evolved_msgs/Old
int16 x
"""
OURS = """int64 count
float64 share
string[] names
Old[2] pair
uint8[] raw
int32 large
float32 became_number
float64 added 2.5
"""


def test_the_rule_for_each_kind_of_change(tmp_path):
    from turtlewire.bag.definitions import learn_types

    name = "evolved_msgs/msg/Thing"
    learn_types(name, f"{OURS}{'=' * 80}\nMSG: evolved_msgs/Old\nint16 x\nbool new_flag\n")
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(CHANGED, name))
    message = random_message(store, name, random.Random(5))
    write_bag(tmp_path / "bag", store, [(name, message)])
    with open_bag(tmp_path / "bag") as bag:
        (found,) = bag
    decoded = found.decode()
    assert msg.missing_fields(decoded) == ("pair.new_flag", "large", "became_number", "added")
    assert (decoded.count, decoded.share, decoded.names) == (
        message.count,
        message.share,
        message.names,
    )
    assert [each.x for each in decoded.pair] == [each.x for each in message.pair]
    assert list(decoded.raw) == list(message.raw)
    assert (decoded.large, decoded.added) == (0, 2.5)
