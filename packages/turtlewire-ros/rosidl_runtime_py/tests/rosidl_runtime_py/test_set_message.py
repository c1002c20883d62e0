"""Messages from dictionaries, with the errors that `ros2 topic pub` shows."""

from array import array

import numpy as np
import pytest

from rosidl_runtime_py import message_to_ordereddict, set_message_fields
from rosidl_runtime_py.utilities import get_message, get_service


def test_nested_fields_are_set_and_the_rest_stays():
    twist = get_message("geometry_msgs/msg/Twist")()
    set_message_fields(twist, {"linear": {"x": 0}, "angular": {"z": 0.25}})
    assert repr(twist.linear) == "geometry_msgs.msg.Vector3(x=0.0, y=0.0, z=0.0)"
    assert twist.angular.z == 0.25


def test_echo_output_sets_the_same_message_again():
    message = get_message("visualization_msgs/msg/Marker")(text="hi", id=3)
    message.points = [get_message("geometry_msgs/msg/Point")(x=1.0)]
    twin = type(message)()
    set_message_fields(twin, message_to_ordereddict(message))
    assert twin == message


@pytest.mark.parametrize(
    ("type_", "values", "error", "text"),
    [
        (
            "geometry_msgs/msg/Twist",
            {"linear": {"x": "abc"}},
            ValueError,
            "could not convert string to float: 'abc'",
        ),
        (
            "turtlesim/msg/Pose",
            {"nope": 4.0},
            AttributeError,
            "'Pose' object has no attribute 'nope'",
        ),
        (
            "geometry_msgs/msg/Twist",
            {"linear": 3},
            TypeError,
            "Value '3' is expected to be a dictionary but is a int",
        ),
        (
            "geometry_msgs/msg/Twist",
            "hello",
            TypeError,
            "Value 'hello' is expected to be a dictionary but is a str",
        ),
        (
            "std_msgs/msg/Float64MultiArray",
            {"data": 3},
            TypeError,
            "Value '3' is expected to be a list but is a int",
        ),
        (
            "std_msgs/msg/Int32",
            {"data": "1.5"},
            ValueError,
            "invalid literal for int() with base 10: '1.5'",
        ),
    ],
)
def test_unsuitable_values_are_named(type_, values, error, text):
    with pytest.raises(error) as caught:
        set_message_fields(get_message(type_)(), values)
    assert str(caught.value) == text


def test_service_requests_name_their_class_in_errors():
    with pytest.raises(AttributeError, match="'Spawn_Request' object has no attribute 'nope'"):
        set_message_fields(get_service("turtlesim/srv/Spawn").Request(), {"nope": 4.0})


def test_sequences_and_arrays_take_lists():
    state = get_message("sensor_msgs/msg/JointState")()
    set_message_fields(state, {"name": ["a", "b"], "position": [1, 2]})
    assert state.position == array("d", [1.0, 2.0])
    pose = get_message("geometry_msgs/msg/PoseWithCovariance")()
    set_message_fields(pose, {"covariance": list(range(36))})
    assert pose.covariance.dtype == np.float64


def test_bytes_are_taken_from_numbers_and_characters():
    multi = get_message("std_msgs/msg/ByteMultiArray")()
    set_message_fields(multi, {"data": [1, "ÿ", b"a"]})
    assert multi.data == [b"\x01", b"\xff", b"a"]
    byte = get_message("std_msgs/msg/Byte")()
    set_message_fields(byte, {"data": 7})
    assert byte.data == b"\x07"


def test_auto_and_now_await_the_time_of_publishing():
    stamped = get_message("geometry_msgs/msg/PoseStamped")()
    stamps = set_message_fields(stamped, {"header": "auto"}, expand_header_auto=True)
    assert stamps == [stamped.header.stamp]
    assert stamps[0] is stamped.header.stamp
    transforms = get_message("tf2_msgs/msg/TFMessage")()
    values = {"transforms": [{"header": {"stamp": "now", "frame_id": "map"}}, {"header": "auto"}]}
    stamps = set_message_fields(transforms, values, expand_header_auto=True, expand_time_now=True)
    assert [
        stamp is transform.header.stamp
        for stamp, transform in zip(stamps, transforms.transforms, strict=True)
    ] == [True, True]
    assert transforms.transforms[0].header.frame_id == "map"


def test_auto_and_now_are_words_when_not_asked_for():
    with pytest.raises(TypeError, match="Value 'auto' is expected to be a dictionary"):
        set_message_fields(get_message("geometry_msgs/msg/PoseStamped")(), {"header": "auto"})
