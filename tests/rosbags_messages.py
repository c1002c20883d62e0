"""Bags and messages as `rosbags` reads them; random messages of all types that it knows."""

import random

import numpy as np
from mcap.writer import Writer as McapWriter
from rosbags.highlevel import AnyReader
from rosbags.interfaces import Nodetype
from rosbags.rosbag1 import Reader, Writer
from rosbags.typesys.base import normalize_fieldname
from tests.bags import START

__all__ = ["as_mcap", "assert_contains", "contents", "random_message", "write_ros1"]

_INTEGERS = {f"{sign}int{bits}": (bits, not sign) for sign in ("", "u") for bits in (8, 16, 32, 64)}


def random_message(store, name, generator):
    """A message of `rosbags` with random values in all of its fields."""
    fields = store.fielddefs[name][1]
    if fields and fields[0][0] == "structure_needs_at_least_one_member":
        return store.types[name](0)
    return store.types[name](
        **{normalize_fieldname(f): _value(store, type_, generator) for f, type_ in fields}
    )


def _value(store, type_, generator):
    kind, detail = type_
    if kind == Nodetype.NAME:
        return random_message(store, detail, generator)
    if kind == Nodetype.BASE:
        value = _scalar(detail[0], generator)
        return value[: detail[1]] if detail[1] else value
    inner, size = detail
    count = size if kind == Nodetype.ARRAY else generator.randrange(min(size or 3, 3) + 1)
    values = [_value(store, inner, generator) for _ in range(count)]
    if inner[0] == Nodetype.NAME or inner[1][0] == "string":
        return values
    dtype = {"byte": "uint8", "char": "uint8"}.get(inner[1][0], inner[1][0])
    return np.array(values, dtype=dtype)


def _scalar(name, generator):
    if name == "string":
        return generator.choice(["", "odom", "käfer", "a b/c#'\"\\"])
    if name == "bool":
        return generator.random() < 0.5
    if name.startswith("float"):
        return float(np.float32(generator.uniform(-1e6, 1e6)))
    bits, is_signed = _INTEGERS.get(name, (7, False))  # a byte is signed in ROS 1
    low = -(2 ** (bits - 1)) if is_signed else 0
    return generator.randrange(low, low + 2**bits)


def write_ros1(path, store, names, *, seed=1, each=3):
    """Write random messages of the types, ``each`` on its own topic; return the raw bytes."""
    generator = random.Random(seed)
    raw = {}
    with Writer(path) as writer:
        for name in names:
            topic = "/" + name.replace("/msg/", "/")
            connection = writer.add_connection(topic, name, typestore=store)
            raw[topic] = [
                bytes(store.serialize_ros1(random_message(store, name, generator), name))
                for _ in range(each)
            ]
            for number, data in enumerate(raw[topic]):
                writer.write(connection, START + number, data)
    return raw


def as_mcap(bag_path, path, change=lambda data: data):
    """Write the messages of a ROS 1 bag as MCAP tools do that keep its bytes."""
    with Reader(bag_path) as reader, path.open("wb") as file:
        writer = McapWriter(file)
        writer.start("ros1", "another tool")
        channels = {}
        for connection in reader.connections:
            name = connection.msgtype.replace("/msg/", "/")
            text = connection.msgdef.data.encode()
            schema = writer.register_schema(name, "ros1msg", text)
            channels[connection.id] = writer.register_channel(connection.topic, "ros1", schema)
        for connection, time, data in reader.messages():
            writer.add_message(channels[connection.id], time, change(bytes(data)), time)
        writer.finish()
    return path


def contents(path):
    """All messages of a bag as `rosbags` decodes them by the bag's own definitions."""
    with AnyReader([path]) as reader:
        return [
            (connection.topic, time, reader.deserialize(data, connection.msgtype))
            for connection, time, data in sorted(
                reader.messages(), key=lambda each: (each[1], each[0].topic)
            )
        ]


def assert_contains(found, expected, where=""):
    """Compare the fields that ROS 1 has, at any depth."""
    if isinstance(expected, (list, tuple)):
        assert len(found) == len(expected), where
        for one, other in zip(found, expected, strict=True):
            assert_contains(one, other, f"{where}[]")
    elif hasattr(expected, "__dataclass_fields__"):
        for name in expected.__dataclass_fields__:
            if name not in ("seq", "__msgtype__") and not name.isupper():
                other = name if hasattr(found, name) else name.lower()
                assert_contains(getattr(found, other), getattr(expected, name), f"{where}.{name}")
    elif isinstance(expected, np.ndarray):
        assert np.array_equal(found, expected), where
    else:
        assert found == expected, where
