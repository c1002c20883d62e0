"""The compiled core and plain Python do the same with the records of chunks, whatever the bytes.

They read the same messages, convert them to the same bytes, and walk to the same transforms.
"""

import random
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_typestore
from tests.bags import START, transform
from tests.needs import COMPILED_CORE
from tests.rosbags_messages import random_message, write_ros1

from turtlewire import msg
from turtlewire.bag.record_messages import plain_mcap_messages, plain_ros1_messages
from turtlewire.bag.ros1_file import Ros1File
from turtlewire.bag.ros1_steps import conversion_steps
from turtlewire.bag.ros1_storage import Ros1Messages
from turtlewire.errors import CdrError
from turtlewire.tf import plain
from turtlewire.tf.faults import malformed, refusals
from turtlewire.tf.links import links

native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)

ROS1 = get_typestore(Stores.ROS1_NOETIC)

u32, u64 = (st.integers(0, 2**bits - 1) for bits in (32, 64))


def mcap_record(opcode, body):
    return struct.pack("<BQ", opcode, len(body)) + body


mcap_records = st.one_of(
    st.builds(
        lambda *fields: mcap_record(5, struct.pack("<HIQQ", *fields[:4]) + fields[4]),
        st.integers(0, 3),
        u32,
        u64,
        u64,
        st.binary(max_size=9),
    ),
    st.builds(mcap_record, st.integers(0, 255), st.binary(max_size=30)),
    st.binary(max_size=12),
)


def ros1_record(fields, data):
    head = b"".join(
        struct.pack("<I", len(name) + 1 + len(value)) + name + b"=" + value
        for name, value in fields
    )
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data


ros1_fields = st.permutations(
    [(b"op", b"\x02"), (b"conn", b"\1\0\0\0"), (b"time", b"\1\0\0\0\2\0\0\xff"), (b"more", b"=x")]
)
ros1_records = st.one_of(
    st.builds(ros1_record, ros1_fields, st.binary(max_size=9)),
    st.builds(
        lambda fields, count, data: ros1_record(fields[:count], data),
        ros1_fields,
        st.integers(0, 3),
        st.binary(max_size=9),
    ),
    st.builds(ros1_record, st.just([(b"op", b"\x07")]), st.binary(max_size=9)),
    st.binary(max_size=12),
)


@pytest.mark.parametrize(
    ("compiled", "plain", "record"),
    [
        (native.mcap_messages, plain_mcap_messages, mcap_records),
        (native.ros1_messages, plain_ros1_messages, ros1_records),
    ],
    ids=["mcap", "ros1"],
)
def test_both_read_the_same_messages(compiled, plain, record):
    wanted = st.none() | st.sets(st.integers(0, 3)) | st.just({})

    @given(st.lists(record, max_size=6).map(b"".join), wanted)
    def check(records, channels):
        position = 0
        while position < len(records):
            found, expected = [], []
            end = compiled(records, position, channels, found)
            expected_end = plain(memoryview(records), position, channels, expected)
            assert (end, found) == (expected_end, expected)
            position = max(end, position) + 1  # also from places that are no record

    check()


def test_a_wrong_argument_is_refused():
    with pytest.raises(TypeError):
        native.mcap_messages(5, 0, None, [])
    with pytest.raises(TypeError):
        native.mcap_messages(mcap_record(5, bytes(22)), 0, 7, [])
    for step in [(10, 1, 1, 0), (0, 1, 0, 0), (0, 1, 9, 0), (6, 0, 1, 1)]:
        with pytest.raises((ValueError, RuntimeError)):
            native.Ros1ToCdr([step])


def test_messages_are_converted_up_to_the_first_that_needs_python():
    text = native.Ros1ToCdr([(3, 0, 1, 0)])
    whole, wrong = b"\2\0\0\0hi", b"\3\0\0\0hi"
    messages = [(1, 7, 2, whole), (3, 8, 4, b"other"), (5, 7, 6, wrong), (7, 7, 8, whole)]
    cdr = b"\0\1\0\0\3\0\0\0hi\0"
    into = []
    assert native.convert_messages(messages, 0, {7: text}, into) == 2
    assert into == [(1, 7, 2, cdr), (3, 8, 4, b"other")]
    assert native.convert_messages(messages, 3, {7: text}, into) == 4
    assert into[2:] == [(7, 7, 8, cdr)]
    assert native.convert_messages(messages, 0, {7: None}, into) == 0
    assert native.convert_messages(messages, 4, {7: text}, into) == 4
    with pytest.raises(ValueError, match="a message is a tuple"):
        native.convert_messages([(1, 7)], 0, {7: text}, into)


def test_the_steps_make_the_bytes_that_message_objects_make(tmp_path):
    names = sorted(ROS1.fielddefs)
    generator = random.Random(3)
    write_ros1(tmp_path / "all.bag", ROS1, names, each=1)
    file = Ros1File(str(tmp_path / "all.bag"))
    compared = 0
    for connection in file.connections.values():
        kind = Ros1Messages(connection.type, connection.definition)
        if kind.conversion is None:
            continue
        for _ in range(6):
            message = random_message(ROS1, kind.name, generator)
            data = bytes(ROS1.serialize_ros1(message, kind.name))
            fast = kind.conversion.convert(data)
            if fast is not None:
                compared += 1
                assert fast == kind._cdr_of_message(data), kind.name
            for wrong in (data[:-1], data + b"\0") if data else ():
                assert kind.conversion.convert(wrong) is None
                with pytest.raises(CdrError):
                    kind.cdr(wrong)
    file.close()
    assert compared > 4 * len(names)  # the others have text beyond ASCII


def test_damaged_messages_never_leave_the_bytes(tmp_path):
    generator = random.Random(4)
    for name in ("sensor_msgs/msg/JointState", "nav_msgs/msg/Path"):
        steps = conversion_steps(name, {})
        convert = native.Ros1ToCdr(steps).convert
        for _ in range(2000):
            convert(generator.randbytes(generator.randrange(80)))
        assert convert(b"\xff" * 60) is None


FOREVER = (1 << 64) - 1
CHANNELS = {1: ("/tf", False), 2: ("/tf_static", True), 3: ("/robot/tf", False)}


def message(channel, log_time, data):
    return mcap_record(5, struct.pack("<HIQQ", channel, 0, log_time, log_time) + data)


def several(*transforms):
    kind = msg.get_message("tf2_msgs/msg/TFMessage")
    return msg.serialize(kind(transforms=[one.transforms[0] for one in transforms]))


def chunk(seed):
    """Records of all kinds: wanted and other channels, two byte orders, nonsense, loops in time."""
    dice = random.Random(seed)
    parts = []
    for log_time in range(dice.choice([0, 1, 3, 40])):
        i = dice.choice([log_time, log_time, dice.randrange(500)])
        names = dice.choice(
            [("odom", "base"), ("map", "odom"), ("odom", "ä"), ("", "x"), ("a", "a")]
        )
        data = several(*(transform(i + k, *names) for k in range(dice.choice([1, 1, 1, 0, 2, 5]))))
        if dice.random() < 0.1:
            data = data[: dice.randrange(len(data))]
        kind = dice.random()
        if kind < 0.1:
            parts.append(mcap_record(dice.randrange(1, 15), dice.randbytes(dice.randrange(40))))
        else:
            parts.append(message(dice.choice([1, 1, 1, 2, 3, 4, 70]), log_time, data))
    return b"".join(parts)


def rounded(poses):
    """To six digits: the cores round differently; a flipped exponent makes any size."""
    return [[float(f"{number:.6g}") for number in pose] for pose in poses]


def outcome(core, records, window=(0, FOREVER)):
    """Return the content of a buffer after the walk, and the walk's report."""
    buffer, walk = core.Buffer(None), core.RecordWalk(*window)
    damage = [walk.walk(buffer, part, CHANNELS) for part in records]
    history = {
        frame: [(p, s.tolist(), rounded(poses)) for p, s, poses in buffer.samples(frame)]
        for frame in buffer.frames()
    }
    described = [link._replace(memory_bytes=0) for link in links(buffer)]
    return (
        damage,
        walk.messages,
        walk.jumps,
        walk.steps_back,
        history,
        described,
        refusals(buffer),
        malformed(buffer),
    )


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 2**32), st.booleans(), st.data())
def test_both_walks_do_the_same(seed, damaged, data):
    records = [chunk(seed), chunk(seed + 1)]
    if damaged and records[0]:
        cut = data.draw(st.integers(0, len(records[0])))
        records[0] = records[0][:cut]
    window = data.draw(st.sampled_from([(0, FOREVER), (3, 20), (FOREVER, FOREVER)]))
    assert outcome(native, records, window) == outcome(plain, records, window)


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 2**32))
def test_flipped_bytes(seed):
    dice = random.Random(seed)
    records = bytearray(chunk(seed))
    for _ in range(dice.randrange(1, 5)):
        if records:
            records[dice.randrange(len(records))] = dice.randrange(256)
    assert outcome(native, [bytes(records)]) == outcome(plain, [bytes(records)])


def test_the_place_of_the_damage():
    whole = message(1, 5, msg.serialize(transform(1)))
    for core in (native, plain):
        damage, messages, *_ = outcome(core, [whole + whole[:40]])
        assert (damage, messages) == ([len(whole)], 1)
        damage, messages, *_ = outcome(core, [whole + mcap_record(5, b"short")])
        assert (damage, messages) == ([len(whole)], 1)
        bomb = struct.pack("<BQ", 5, 2**64 - 1)
        assert outcome(core, [whole + bomb])[0] == [len(whole)]


def test_listeners_hear_of_it_and_views_are_taken():
    heard = []
    for core in (native, plain):
        buffer = core.Buffer(None)
        buffer.on_change(lambda: heard.append(1))
        records = memoryview(message(1, 5, msg.serialize(transform(1))))
        core.RecordWalk(0, FOREVER).walk(buffer, records, CHANNELS)
        assert buffer.lookup_transform("odom", "base_link", START + 10_000_000).x == 0.01
    assert heard == [1, 1]


def test_no_transforms_but_more_bytes_and_names_that_are_no_text():
    empty = bytes.fromhex("00010000 00000000") + b"\xff" * 100
    odd = bytearray(msg.serialize(transform(1, "", "x")))
    odd[odd.index(b"x\0")] = 0xFF
    records = [message(1, 5, empty) + message(1, 6, bytes(odd))]
    assert outcome(native, records) == outcome(plain, records)
    assert outcome(plain, records)[1] == 2


@pytest.mark.parametrize("core", [native, plain])
@pytest.mark.parametrize(("steps", "jumps"), [(100, []), (101, [(2, "base", 1_010_000_000)])])
def test_only_more_than_a_second_back_is_a_jump(core, steps, jumps):
    buffer, walk = core.Buffer(None), core.RecordWalk(0, FOREVER)
    parts = [
        message(1, time, several(transform(i, "odom", "base")))
        for time, i in ((1, 200), (2, 200 - steps))
    ]
    walk.walk(buffer, b"".join(parts), CHANNELS)
    assert [tuple(each) for each in walk.jumps] == jumps
