"""Messages as text: what a real `ros2 topic echo` printed for the same messages."""

import json
import re

import numpy as np
import pytest
import yaml
from tests.golden.cli.captures import captures
from tests.places import GOLDEN

from rosidl_runtime_py import (
    message_to_csv,
    message_to_ordereddict,
    message_to_yaml,
    set_message_fields,
)
from rosidl_runtime_py.utilities import get_message
from turtlewire import msg

CASES = {
    case["name"]: case for case in json.loads((GOLDEN / "wire" / "cdr_cases.json").read_text())
}
OPTIONS = {
    "--flow-style": {"flow_style": True},
    "--no-arr": {"no_arr": True},
    "--full-length": {"truncate_length": None},
}

# Types of the captured messages whose bytes were not captured.
TYPES = {
    "string_empty": "std_msgs/msg/String",
    "string_ctrl": "std_msgs/msg/String",
    "float32": "std_msgs/msg/Float32",
    "twist_special": "geometry_msgs/msg/Twist",
    "image4x4": "sensor_msgs/msg/Image",
    "pointcloud2": "sensor_msgs/msg/PointCloud2",
    "imu": "sensor_msgs/msg/Imu",
    "tf_0": "tf2_msgs/msg/TFMessage",
    "path_0": "nav_msgs/msg/Path",
    "log": "rcl_interfaces/msg/Log",
    "typedesc": "type_description_interfaces/msg/TypeDescription",
    "paramevent_empty": "rcl_interfaces/msg/ParameterEvent",
}


def _echoes(known=CASES):
    """(file name, options, message name, printed text) of every capture whose message we have."""
    for case in captures():
        found = re.fullmatch(r"ros2 topic echo --once (.*)/w/(\w+)", case.command)
        if found and found[2] in known and not {"--field", "--raw"} & set(found[1].split()):
            yield case.name, found[1].split(), found[2], case.stdout


@pytest.mark.parametrize(
    ("options", "name", "printed"),
    [echo[1:] for echo in _echoes()],
    ids=[echo[0] for echo in _echoes()],
)
def test_echo_prints_what_ros_printed(options, name, printed):
    case = CASES[name]
    message = msg.deserialize(get_message(case["type"]), bytes.fromhex(case["bytes"]))
    arguments = {"truncate_length": 128}
    for option in options:
        arguments |= OPTIONS.get(option, {})
    if "--csv" in options:
        assert message_to_csv(message, **arguments) + "\n" == printed
    else:
        assert message_to_yaml(message, **arguments) + "---\n" == printed


@pytest.mark.parametrize(
    ("options", "name", "printed"),
    [echo[1:] for echo in _echoes(TYPES)],
    ids=[echo[0] for echo in _echoes(TYPES)],
)
def test_ros_output_sets_a_message_that_prints_the_same(options, name, printed):
    if "--no-arr" in options:
        assert "data: '<sequence type: uint8, length: 48>'" in printed
        message = get_message(TYPES[name])(data=range(48))
        assert "data: '<sequence type: uint8, length: 48>'" in message_to_yaml(message, no_arr=True)
        return
    message = get_message(TYPES[name])()
    set_message_fields(message, yaml.safe_load(printed.removesuffix("---\n")))
    message = msg.deserialize(type(message), msg.serialize(message))
    assert (
        message_to_yaml(message, truncate_length=128, flow_style="--flow-style" in options)
        + "---\n"
        == printed
    )


def test_enough_captures_were_compared():
    assert len(list(_echoes())) == 18
    assert len(list(_echoes(TYPES))) == 15


def test_long_sequences_and_strings_are_cut():
    message = get_message("sensor_msgs/msg/JointState")(name=["abcdef"], position=[1.0, 2.0, 3.0])
    shown = message_to_ordereddict(message, truncate_length=2)
    assert shown["position"] == [1.0, 2.0, "..."]
    assert shown["name"] == ["ab..."]
    assert message_to_csv(message, truncate_length=2) == "0,0,,ab...,1.0,2.0,...,,"


def test_sequences_and_strings_can_be_left_out():
    message = get_message("shape_msgs/msg/SolidPrimitive")(dimensions=[1.0, 2.0])
    assert (
        message_to_ordereddict(message, no_arr=True)["dimensions"]
        == "<sequence type: double[3], length: 2>"
    )
    path = get_message("nav_msgs/msg/Path")()
    assert message_to_csv(path, no_arr=True, no_str=True) == (
        "0,0,<string length: <0>>,<sequence type: geometry_msgs/msg/PoseStamped, length: 0>"
    )
    assert message_to_ordereddict(path, no_str=True)["header"]["frame_id"] == "<string length: <0>>"


def test_numpy_scalars_and_arrays_become_plain_values():
    message = get_message("geometry_msgs/msg/PoseWithCovariance")(covariance=np.eye(6).ravel())
    message.pose.position.x = np.float64(2.5)
    shown = message_to_ordereddict(message)
    assert type(shown["pose"]["position"]["x"]) is float
    assert shown["covariance"][:8] == [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


def test_bytes_are_shown_as_characters():
    assert message_to_yaml(get_message("std_msgs/msg/Byte")(data=b"\xff")) == "data: ÿ\n"
    assert message_to_csv(get_message("std_msgs/msg/Byte")(data=b"\xff")) == "b'\\xff'"


def test_an_empty_message_is_an_empty_mapping():
    assert message_to_yaml(get_message("std_msgs/msg/Empty")()) == "{}\n"
