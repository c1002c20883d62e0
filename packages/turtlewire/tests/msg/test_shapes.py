"""Definitions shaped as those of test_msgs, nav2_msgs, control_msgs and geographic_msgs.

Texts of our own with the same constructs; rosbags reads them, too, and is the oracle of type hashes
and of bytes.
"""

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from turtlewire import msg
from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.registry import define

SHAPES = {
    "Basics": "bool b\nbyte y\nchar c\nfloat32 f\nfloat64 d\nint8 i8\nuint64 u64\nstring s\n",
    "Arrays": (
        "# arrays of all kinds\nbool[3] flags\nstring[3] texts\nBasics[3] parts\n"
        "bool[3] flags_given [false, true, false]\nbyte[3] bytes_given [0, 1, 255]\n"
        "char[3] letters_given [0, 1, 127]\nfloat32[3] floats_given [1.125, 0.0, -1.125]\n"
        "int64[3] ints_given [0, 9223372036854775807, -9223372036854775808]\n"
        'string[3] texts_given ["", "max value", "min value"]\nint32 alignment_check\n'
    ),
    "Sequences": (
        "bool[] flags\nfloat64[] floats [0.5, 1]\nBasics[] parts\nstring[] texts\n"
        "bool[<=3] few_flags\nBasics[<=3] few_parts\nuint16[<=3] few_numbers [0, 1, 65535]\n"
        "string<=22[<=2] short_texts\nint32 alignment_check\n"
    ),
    "Texts": (
        'string plain\nstring given "Hello world!"\nstring other \'Hello"world!\'\n'
        "string<=22 bounded\nstring<=22 with_quote 'Hello\\'world!'\n"
    ),
    "Constants": (
        "bool YES=true\nbyte BYTE=50\nchar LETTER=100\nfloat32 HALF=0.5\nint8 LOW=-50\n"
        "uint16 UNKNOWN=100  # with a comment\nstring NAME=foo bar\n"
    ),
    "Nested": "Arrays[2] arrays\nSequences[<=3] sequences\nConstants[] constants\nTexts texts\n",
    "Keyed": "string key\nuint32 number\nBasics value\n",
    "Error": (
        "# a state, as controllers publish it\nstd_msgs/Header header\n\nstring[] joint_names\n"
        "trajectory_msgs/JointTrajectoryPoint reference\n"
        "builtin_interfaces/Duration time_from_start\ngeometry_msgs/Pose2D[] poses\n"
    ),
    "Place": "unique_identifier_msgs/UUID id\n\n# NaN if it is not known\nfloat64 altitude\n",
}

ACTION = """
# goal definition
geometry_msgs/PoseStamped[] goals
string planner_id
---
# result definition

# error codes
uint16 NONE=0
uint16 UNKNOWN=200

nav_msgs/Path path
uint16 error_code
---
# feedback definition
uint8 corner 3
"""


@pytest.fixture(scope="module")
def rosbags_store():
    """rosbags' types with those of this module, which are made known here, too."""
    store = get_typestore(Stores.ROS2_JAZZY)
    for name, text in SHAPES.items():
        define(f"shape_msgs_of_tests/msg/{name}", text)
        # rosbags hashes char as a distinct type; ROS 2's .msg files mean uint8 by it.
        known = text.replace("char", "uint8")
        store.register(get_types_from_msg(known, f"shape_msgs_of_tests/msg/{name}"))
    return store


def filled(message):
    """A message with something in each sequence of messages."""
    for name, type_ in message.get_fields_and_field_types().items():
        if type_.startswith("sequence<shape_msgs_of_tests"):
            inner = type_.removeprefix("sequence<").split(",")[0].rstrip(">")
            package, last = inner.split("/")
            cls = msg.get_message(f"{package}/msg/{last}")
            setattr(message, name, [filled(cls()), filled(cls())])
        elif type_.startswith("sequence<string"):
            setattr(message, name, ["a", "bc"])
    return message


@pytest.mark.parametrize("name", SHAPES)
def test_hash_and_bytes_are_those_of_rosbags(rosbags_store, name):
    full_name = f"shape_msgs_of_tests/msg/{name}"
    assert msg.type_hash(full_name) == rosbags_store.hash_rihs01(full_name)
    message = filled(msg.get_message(full_name)())
    data = msg.serialize(message)
    assert msg.deserialize(type(message), data) == message
    theirs = rosbags_store.deserialize_cdr(data, full_name)
    assert bytes(rosbags_store.serialize_cdr(theirs, full_name)) == bytes(data)


def test_defaults_and_constants(rosbags_store):
    arrays = msg.get_message("shape_msgs_of_tests/msg/Arrays")()
    assert arrays.bytes_given == [b"\x00", b"\x01", b"\xff"]
    assert arrays.ints_given.tolist() == [0, 2**63 - 1, -(2**63)]
    assert arrays.texts_given == ["", "max value", "min value"]
    sequences = msg.get_message("shape_msgs_of_tests/msg/Sequences")()
    assert list(sequences.floats) == [0.5, 1.0]
    assert list(sequences.few_numbers) == [0, 1, 65535]
    texts = msg.get_message("shape_msgs_of_tests/msg/Texts")()
    assert (texts.other, texts.with_quote) == ('Hello"world!', "Hello'world!")
    constants = msg.get_message("shape_msgs_of_tests/msg/Constants")
    assert (constants.BYTE, constants.LETTER, constants.NAME) == (b"2", 100, "foo bar")


def test_an_action_with_codes_and_defaults():
    define("shape_msgs_of_tests/action/Follow", ACTION)
    follow = msg.get_action("shape_msgs_of_tests/action/Follow")
    assert follow.Result.UNKNOWN == 200
    assert follow.Feedback().corner == 3
    assert follow.Result().path.poses == []


def test_keys_of_idl_change_nothing(rosbags_store):
    text = (
        "module p { module msg { struct Keyed { @key string key; @key uint32 number;"
        " shape_msgs_of_tests::msg::Basics value; }; }; };"
    )
    define("keyed_msgs_of_tests/msg/Keyed", idl_to_text("keyed_msgs_of_tests/msg/Keyed", text))
    ours = msg.get_message("keyed_msgs_of_tests/msg/Keyed")()
    same = msg.get_message("shape_msgs_of_tests/msg/Keyed")()
    assert msg.serialize(ours) == msg.serialize(same)
