"""An MCAP file of JSON or Protobuf is not opened as if it were empty: its channels are named.

Messages that a bag defines otherwise than we do, as other releases of ROS 2 did.
"""

import copy
import pickle
import random
import sqlite3
import sys
from types import SimpleNamespace

import pytest
from rosbags.convert.converter import migrate_bytes
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from tests.bags import START
from tests.needs import only_first_is_fast
from tests.rosbags_messages import random_message

import turtlewire
from ros2cli.main import main as ros2
from rosbag2_py import PlayOptions, SequentialReader
from rosbag2_transport.play_filter import mistakes, played_topics
from turtlewire import msg
from turtlewire.bag import open_bag
from turtlewire.bag.definitions import has_interface
from turtlewire.bag.metadata import TopicInfo, is_cdr, not_in_cdr
from turtlewire.cli.main import main
from turtlewire.errors import BagError, CdrError, InterfaceError
from turtlewire_view.bag_source import BagSource

NAMED = (
    "Not in ROS 2's encoding, CDR, and therefore neither decoded nor shown: "
    "/log (protobuf foxglove.Log), /pose (json demo.Pose)."
)


@pytest.fixture
def foreign(tmp_path):
    return written(tmp_path / "foreign.mcap")


def written(path, **types):
    """An MCAP file as programs write it that are not of ROS."""
    writer_module = pytest.importorskip("mcap.writer", reason="pip install mcap")
    with path.open("wb") as file:
        writer = writer_module.Writer(file)
        writer.start("", "test")
        for topic, encoding, kind in (
            ("/pose", "json", "demo.Pose"),
            ("/log", "protobuf", "foxglove.Log"),
            *((f"/{name}", "json", kind) for name, kind in types.items()),
        ):
            schema = writer.register_schema(kind, "jsonschema", b"{}")
            channel = writer.register_channel(topic, encoding, schema)
            writer.add_message(channel, log_time=10**18, publish_time=1, data=b'{"x": 1}')
        writer.finish()
    return str(path)


def test_the_sentence_names_topics_encodings_and_types():
    topics = [TopicInfo("/a", "x.A", "json"), TopicInfo("/b", "std_msgs/msg/String")]
    assert [is_cdr(topic) for topic in topics] == [False, True]
    assert not_in_cdr(topics).endswith(": /a (json x.A).")
    assert not_in_cdr(topics[1:]) == ""
    assert not_in_cdr([TopicInfo("/c", "", ""), TopicInfo("/b", "", "cdr")]).endswith(
        "Without a type in the bag, and therefore neither decoded nor shown: /b, /c."
    )
    many = [TopicInfo(f"/t{number:02}", "x", "json") for number in range(12)]
    assert not_in_cdr(many).endswith("/t09 (json x) and 2 more.")
    assert not_in_cdr(many[:10]).endswith("/t09 (json x).")


def test_the_bytes_are_read_and_decoding_says_why_not(foreign):
    with open_bag(foreign) as bag:
        message = next(bag.messages("/pose"))
        assert (message.data, bag.topics["/pose"].serialization_format) == (b'{"x": 1}', "json")
        with pytest.raises(
            InterfaceError, match=r"/pose: 'demo\.Pose' is not a type of ROS 2"
        ) as e:
            message.decode()
    assert "its messages are in json" in str(e.value)


def test_the_doctor_names_them(foreign, capsys):
    assert main(["doctor", foreign]) == 0
    assert NAMED in capsys.readouterr().out


def test_transforms_are_missed_with_the_reason(foreign, tmp_path, capsys):
    with pytest.raises(BagError, match="none of the topics") as caught:
        turtlewire.Buffer.from_bag(foreign)
    assert NAMED in caught.value.hint
    assert main(["bag", "tf", foreign]) == 2
    assert NAMED in capsys.readouterr().err
    other = written(tmp_path / "other.mcap", tf="tf2_msgs/msg/TFMessage")
    with pytest.raises(BagError, match="no transforms that can be read") as caught:
        turtlewire.Buffer.from_bag(other)
    assert "/tf (json tf2_msgs/msg/TFMessage)" in caught.value.hint


def test_ros2_bag_info_keeps_its_text_and_says_more_on_stderr(foreign, capsys):
    assert ros2(["bag", "info", foreign]) in (0, None)
    out, err = capsys.readouterr()
    assert "Topic: /pose | Type: demo.Pose | Count: 1 | Serialization Format: json" in out
    assert err == f"{NAMED}\n"
    assert NAMED not in out


def test_a_reader_warns(foreign, capfd):
    SequentialReader().open_uri(foreign)
    assert f"[rosbag2_storage]: {NAMED}" in capfd.readouterr().err


def test_the_view_says_what_it_does_not_show(tmp_path):
    source = BagSource(written(tmp_path / "x.mcap", tf="tf2_msgs/msg/TFMessage"))
    try:
        assert source.topics() == []
        assert "/tf (json tf2_msgs/msg/TFMessage)" in source.problem
    finally:
        source.close()


def test_a_player_names_them_once_and_plays_the_rest(tmp_path):
    path = written(tmp_path / "x.mcap")
    with open_bag(path) as foreign_bag:
        topics = {**foreign_bag.topics, "/text": TopicInfo("/text", "std_msgs/msg/String")}
        bag = SimpleNamespace(topics=topics, start_ns=0, end_ns=1)
        assert played_topics(bag, PlayOptions()) == ["/text"]
        (warning,) = mistakes(bag, PlayOptions())
        assert warning == NAMED.replace("neither decoded nor shown", "not played")
        assert mistakes(bag, PlayOptions(topics_to_filter=["/text"])) == []
        (warning,) = mistakes(bag, PlayOptions(topics_to_filter=["/pose"]))
        assert warning.endswith("not played: /pose (json demo.Pose).")


def test_ros2_bag_play_warns_and_goes_on(foreign, run):
    program = "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))"
    player = run(sys.executable, "-c", program, "bag", "play", foreign)
    assert player.wait() == 0, player.text
    assert (
        player.text.count("not played: /log (protobuf foxglove.Log), /pose (json demo.Pose).") == 1
    )
    assert "[ERROR]" not in player.text


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
@pytest.mark.parametrize("release", only_first_is_fast(*OTHERS))
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
float32 became_text
int32 became_list
uint32 exact
uint32 inexact
float64 narrowed
int8[] widened
uint8[4] resized
float32[3] fixed
bool flag
byte octet
uint8 number
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
string became_text
int32[] became_list
float64 exact
float32 inexact
float32 narrowed
int16[] widened
uint8[5] resized
float64[3] fixed
int8 flag
uint8 octet
byte number
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
    assert msg.missing_fields(decoded) == (
        "pair.new_flag",
        "large",
        "became_number",
        "became_text",
        "became_list",
        "inexact",
        "narrowed",
        "resized",
        "added",
    )
    assert (decoded.count, decoded.share, decoded.names) == (
        message.count,
        message.share,
        message.names,
    )
    assert [each.x for each in decoded.pair] == [each.x for each in message.pair]
    assert list(decoded.raw) == list(message.raw)
    assert (decoded.large, decoded.became_text, decoded.added) == (0, "", 2.5)
    assert (decoded.exact, decoded.flag) == (message.exact, message.flag)
    assert list(decoded.widened) == list(message.widened)
    assert list(decoded.fixed) == list(message.fixed)
    assert (decoded.octet, decoded.number) == (message.octet, bytes((message.number,)))
