"""Messages as JSON, and back."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire import msg
from turtlewire.errors import CdrError
from turtlewire.msg.json_messages import cdr_from_json, json_from_message

TF = "geometry_msgs/msg/TransformStamped"
floats = st.floats(allow_nan=True, allow_infinity=True)


def back(type_name, payload):
    return msg.deserialize(msg.get_message(type_name), cdr_from_json(type_name, payload))


@given(
    st.tuples(*[floats] * 7),
    st.text(st.characters(exclude_categories=["Cs"])),
    st.integers(0, 2**31 - 1),
)
def test_a_message_comes_back_from_json_as_it_was(numbers, name, seconds):
    message = msg.get_message(TF)(child_frame_id=name.replace("\0", ""))
    message.header.stamp.sec = seconds
    move, turn = message.transform.translation, message.transform.rotation
    move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w = numbers
    payload = json_from_message(message)
    json.loads(payload, parse_constant=pytest.fail)  # JavaScript reads no NaN
    assert json_from_message(back(TF, payload)) == payload


@pytest.mark.parametrize(
    "type_name", ["sensor_msgs/msg/Imu", "sensor_msgs/msg/PointCloud2", "shape_msgs/msg/Mesh"]
)
def test_arrays_and_sequences_come_back(type_name):
    message = msg.get_message(type_name)()
    for name, value in {"data": [1, 255], "angular_velocity_covariance": [0.5] * 9}.items():
        if hasattr(message, name):
            setattr(message, name, value)
    if hasattr(message, "triangles"):
        message.triangles = [
            msg.get_message("shape_msgs/msg/MeshTriangle")(vertex_indices=[1, 2, 3])
        ]
    again = back(type_name, json_from_message(message))
    assert msg.serialize(again) == msg.serialize(message)


def test_json_of_other_programs_is_understood():
    assert list(back("sensor_msgs/msg/Image", b'{"data": "AAEC"}').data) == [0, 1, 2]
    assert back("std_msgs/msg/Int64", b'{"data": "-9007199254740993"}').data == -9007199254740993
    assert back("std_msgs/msg/Int32", b'{"data": 3.0}').data == 3
    assert back("std_msgs/msg/Float64", b'{"data": "-Infinity"}').data == -math.inf
    assert back("std_msgs/msg/Byte", b'{"data": 7}').data == b"\x07"
    assert back("std_msgs/msg/Empty", b"{}") is not None


@pytest.mark.parametrize(
    ("type_name", "payload", "reason"),
    [
        ("std_msgs/msg/Int8", '{"data": 200}', "data"),
        (
            "std_msgs/msg/Int32",
            '{"data": 1.5}',
            "std_msgs/msg/Int32.data: expected an integer, got 1.5",
        ),
        ("std_msgs/msg/UInt64", '{"data": "12x"}', 'data: expected an integer, got "12x"'),
        ("std_msgs/msg/UInt64", '{"data": "' + "9" * 5000 + '"}', "data"),
        ("std_msgs/msg/Byte", '{"data": 256}', "data: expected a byte, got 256"),
        ("std_msgs/msg/Float64", '{"data": true}', "data: expected a number, got true"),
        ("std_msgs/msg/Float64", '{"data": null}', "data: expected a number, got null"),
        ("std_msgs/msg/Float64", '{"data": "1.5"}', 'data: expected a number, got "1.5"'),
        ("std_msgs/msg/Int32", '{"data": "5"}', 'data: expected an integer, got "5"'),
        ("std_msgs/msg/Bool", '{"data": 1}', "data: expected true or false, got 1"),
        ("sensor_msgs/msg/Imu", '{"orientation_covariance": [1]}', "orientation_covariance"),
        ("sensor_msgs/msg/Image", '{"data": [256]}', "data"),
        ("sensor_msgs/msg/Image", '{"data": "*"}', "data: invalid base64: "),
        ("sensor_msgs/msg/Image", '{"data": {}}', "data: expected a list, got {}"),
        (
            "geometry_msgs/msg/Twist",
            '{"linear": {"w": 1}}',
            "Twist.linear has no field 'w', it has x, y, z",
        ),
        ("geometry_msgs/msg/Twist", '{"linear": 1}', "linear: expected an object, got 1"),
        ("std_msgs/msg/String", '{"data": "\\ud800"}', ""),
        ("std_msgs/msg/String", "[" * 100_000, "no JSON: "),
        ("std_msgs/msg/String", "[]", "std_msgs/msg/String: expected an object, got []"),
    ],
)
def test_wrong_json_names_the_field(type_name, payload, reason):
    with pytest.raises(CdrError) as error:
        cdr_from_json(type_name, payload.encode())
    assert reason in str(error.value)
