"""The compiled decoder and the readable one agree on what broken bytes are, and on what they
say.
"""

from __future__ import annotations

import random

import pytest
from tests.needs import COMPILED_CORE

from turtlewire import errors, msg
from turtlewire.tf import faults, plain

ROUNDS = 4000


def good_message() -> bytes:
    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")
    message = msg.get_message("tf2_msgs/msg/TFMessage")()
    for number in range(3):
        transform = stamped(child_frame_id=f"kind{number}ä")
        transform.header.frame_id = "eltern"
        transform.header.stamp.sec = 1 + number
        transform.transform.translation.x = number + 0.5
        message.transforms.append(transform)
    return msg.serialize(message)


def mutate(good: bytes, chance: random.Random) -> bytes:
    data = bytearray(good)
    for _ in range(chance.randrange(1, 4)):
        data[chance.randrange(len(data))] = chance.choice(
            [0, 1, 0x7F, 0x80, 0xFF, chance.randrange(256)]
        )
    del data[chance.choice([len(data), len(data), chance.randrange(len(data))]) :]
    return bytes(data)


def ingest(buffer, data: bytes) -> tuple[str, object]:
    try:
        return "accepted", buffer.add_tf_message(data)
    except errors.CdrError as error:
        return "refused", str(error)


def test_both_decoders_say_the_same_of_mutated_messages():
    native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    chance = random.Random(20)
    good = good_message()
    answers = {"accepted": 0, "refused": 0}
    for _ in range(ROUNDS):
        data = mutate(good, chance)
        fast, readable = native.Buffer(), plain.Buffer()
        answer = ingest(fast, data)
        assert answer == ingest(readable, data), data.hex(" ")
        assert fast.frames() == readable.frames(), data.hex(" ")
        assert fast.to_yaml(now_ns=10**18) == readable.to_yaml(now_ns=10**18), data.hex(" ")
        assert faults.malformed(fast) == faults.malformed(readable), data.hex(" ")
        answers[answer[0]] += 1
    assert min(answers.values()) > 500, answers
