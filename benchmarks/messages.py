"""Messages: encoding and decoding CDR, constructing, and what the first use of a type costs."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from benchmarks.clock import per_call
from benchmarks.figures import Figure, Row
from turtlewire import msg

ROSBAGS = "rosbags"
TITLE = "Messages (CDR of one message; rosbags has dataclasses and NumPy)"

FIRST_USE = """
import time
from turtlewire import msg
import turtlewire.msg.encoder, hashlib
start = time.perf_counter()
services = (
    "DescribeParameters GetParameterTypes GetParameters ListParameters SetParameters "
    "SetParametersAtomically"
).split()
for service in services:
    for part in ("Request", "Response"):
        msg.type_hash(f"rcl_interfaces/srv/{service}_{part}")
for name in (
    "rcl_interfaces/msg/ParameterEvent",
    "rcl_interfaces/msg/Log",
    "geometry_msgs/msg/Twist",
    "turtlesim/msg/Pose",
):
    msg.type_hash(name)
    msg.serialize(msg.get_message(name)())
print((time.perf_counter() - start) * 1e9)
"""


def samples() -> dict[str, Any]:
    """A message of each kind that the demo sends, and two large ones."""
    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")

    def transform() -> Any:
        message = stamped(child_frame_id="turtle1")
        message.header.frame_id = "world"
        return message

    frames = msg.get_message("tf2_msgs/msg/TFMessage")
    return {
        "turtlesim/Pose (24 B)": msg.get_message("turtlesim/msg/Pose")(x=1.0),
        "Twist (52 B)": msg.get_message("geometry_msgs/msg/Twist")(),
        "TransformStamped (92 B)": transform(),
        "TFMessage of 1 (100 B)": frames(transforms=[transform()]),
        "TFMessage of 20 (1852 B)": frames(transforms=[transform() for _ in range(20)]),
        "LaserScan of 1000 rays (8 kB)": msg.get_message("sensor_msgs/msg/LaserScan")(
            ranges=[1.0] * 1000, intensities=[1.0] * 1000
        ),
        "Image of 640x480 rgb8 (0.9 MB)": msg.get_message("sensor_msgs/msg/Image")(
            height=480, width=640, data=bytes(640 * 480 * 3)
        ),
    }


def rows() -> Iterator[Row]:
    """Measure both in this process."""
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(
        get_types_from_msg(
            "float32 x\nfloat32 y\nfloat32 theta\nfloat32 linear_velocity\nfloat32 "
            "angular_velocity\n",
            "turtlesim/msg/Pose",
        )
    )
    for what, message in samples().items():
        cls, data, name = type(message), msg.serialize(message), msg.type_name(type(message))
        theirs = store.deserialize_cdr(data, name)
        names = {
            "msg": msg,
            "m": message,
            "cls": cls,
            "data": data,
            "name": name,
            "store": store,
            "theirs": theirs,
        }
        encode, decode = "store.serialize_cdr(theirs, name)", "store.deserialize_cdr(data, name)"
        yield Row(
            f"encode {what}", _figure("msg.serialize(m)", names), {ROSBAGS: _figure(encode, names)}
        )
        yield Row(
            f"decode {what}",
            _figure("msg.deserialize(cls, data)", names),
            {ROSBAGS: _figure(decode, names)},
        )
    yield Row(
        "construct TransformStamped()",
        _figure("cls()", {"cls": msg.get_message("geometry_msgs/msg/TransformStamped")}),
    )
    yield Row(
        "first use of a node's types (16 hashes, 4 encoders)",
        Figure.of([_first_use() for _ in range(10)]),
    )


def _figure(statement: str, names: dict[str, Any]) -> Figure:
    return Figure(*per_call(statement, names, seconds=0.4))


def _first_use() -> float:
    done = subprocess.run(
        [sys.executable, "-c", FIRST_USE], capture_output=True, text=True, check=True
    )
    return float(done.stdout)
