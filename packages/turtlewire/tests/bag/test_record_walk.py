"""The native walk over a chunk's records and its plain twin do the same, whatever the bytes."""

import random
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.bags import START, transform
from tests.needs import COMPILED_CORE

from turtlewire import msg
from turtlewire.tf import plain
from turtlewire.tf.faults import malformed, refusals
from turtlewire.tf.links import links

_native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)

FOREVER = (1 << 64) - 1
CHANNELS = {1: ("/tf", False), 2: ("/tf_static", True), 3: ("/robot/tf", False)}


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def message(channel, log_time, data):
    return record(5, struct.pack("<HIQQ", channel, 0, log_time, log_time) + data)


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
            parts.append(record(dice.randrange(1, 15), dice.randbytes(dice.randrange(40))))
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
    assert outcome(_native, records, window) == outcome(plain, records, window)


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 2**32))
def test_flipped_bytes(seed):
    dice = random.Random(seed)
    records = bytearray(chunk(seed))
    for _ in range(dice.randrange(1, 5)):
        if records:
            records[dice.randrange(len(records))] = dice.randrange(256)
    assert outcome(_native, [bytes(records)]) == outcome(plain, [bytes(records)])


def test_the_place_of_the_damage():
    whole = message(1, 5, msg.serialize(transform(1)))
    for core in (_native, plain):
        damage, messages, *_ = outcome(core, [whole + whole[:40]])
        assert (damage, messages) == ([len(whole)], 1)
        damage, messages, *_ = outcome(core, [whole + record(5, b"short")])
        assert (damage, messages) == ([len(whole)], 1)
        bomb = struct.pack("<BQ", 5, 2**64 - 1)
        assert outcome(core, [whole + bomb])[0] == [len(whole)]


def test_listeners_hear_of_it_and_views_are_taken():
    heard = []
    for core in (_native, plain):
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
    assert outcome(_native, records) == outcome(plain, records)
    assert outcome(plain, records)[1] == 2


@pytest.mark.parametrize("core", [_native, plain])
@pytest.mark.parametrize(("steps", "jumps"), [(100, []), (101, [(2, "base", 1_010_000_000)])])
def test_only_more_than_a_second_back_is_a_jump(core, steps, jumps):
    buffer, walk = core.Buffer(None), core.RecordWalk(0, FOREVER)
    parts = [
        message(1, time, several(transform(i, "odom", "base")))
        for time, i in ((1, 200), (2, 200 - steps))
    ]
    walk.walk(buffer, b"".join(parts), CHANNELS)
    assert [tuple(each) for each in walk.jumps] == jumps
