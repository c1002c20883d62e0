"""ROS 2's checks at assignment, asked for by check_fields=True or by the environment."""

import math
from array import array

import numpy as np
import pytest
from tests.programs import run_python

from turtlewire import msg

Vector3 = msg.get_message("geometry_msgs/msg/Vector3")
Twist = msg.get_message("geometry_msgs/msg/Twist")


def _make(name, **fields):
    return msg.get_message(name)(check_fields=True, **fields)


@pytest.mark.parametrize(
    ("name", "fields", "text"),
    [
        ("geometry_msgs/msg/Vector3", {"x": 1}, "The 'x' field must be of type 'float'"),
        (
            "std_msgs/msg/Float32",
            {"data": 1e300},
            "The 'data' field must be a float in [-3.402823466e+38, 3.402823466e+38]",
        ),
        (
            "geometry_msgs/msg/Twist",
            {"linear": 3},
            "The 'linear' field must be a sub message of type 'Vector3'",
        ),
        ("std_msgs/msg/String", {"data": b"x"}, "The 'data' field must be of type 'str'"),
        ("std_msgs/msg/Bool", {"data": 1}, "The 'data' field must be of type 'bool'"),
        ("std_msgs/msg/UInt8", {"data": 1.0}, "The 'data' field must be of type 'int'"),
        (
            "std_msgs/msg/UInt8",
            {"data": 256},
            "The 'data' field must be an unsigned integer in [0, 255]",
        ),
        ("std_msgs/msg/Int8", {"data": -129}, "The 'data' field must be an integer in [-128, 127]"),
        (
            "std_msgs/msg/Byte",
            {"data": b"ab"},
            "The 'data' field must be of type 'bytes' or 'ByteString' with length 1",
        ),
        (
            "rmw_dds_common/msg/NodeEntitiesInfo",
            {"node_name": "x" * 257},
            "The 'node_name' field must be string value not longer than 256",
        ),
        (
            "std_msgs/msg/MultiArrayLayout",
            {"dim": [3]},
            (
                "The 'dim' field must be a set or sequence and each value of type "
                "'MultiArrayDimension'"
            ),
        ),
        (
            "turtlesim/srv/Spawn_Event",
            {"request": [msg.get_service("turtlesim/srv/Spawn").Request()] * 2},
            (
                "The 'request' field must be a set or sequence with length <= 1 and each value of "
                "type 'Spawn_Request'"
            ),
        ),
        (
            "unique_identifier_msgs/msg/UUID",
            {"uuid": [1, 2]},
            "The 'uuid' numpy.ndarray() must have a size of 16",
        ),
        ("std_msgs/msg/UInt8MultiArray", {"data": array("B", [1]), "layout": None}, ""),
    ],
)
def test_unsuitable_values_are_assertion_errors(name, fields, text):
    if not text:
        assert _make(name, **fields) == msg.get_message(name)(**fields)
        return
    with pytest.raises(AssertionError) as caught:
        _make(name, **fields)
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ("name", "field", "value"),
    [
        ("std_msgs/msg/Float32", "data", 3.402823466e38),
        ("std_msgs/msg/Float32", "data", -3.402823466e38),
        ("std_msgs/msg/Float32", "data", math.inf),
        ("std_msgs/msg/UInt8", "data", 0),
        ("std_msgs/msg/UInt8", "data", 255),
        ("std_msgs/msg/Int8", "data", -128),
        ("std_msgs/msg/Int8", "data", 127),
        ("rmw_dds_common/msg/NodeEntitiesInfo", "node_name", "x" * 256),
        (
            "turtlesim/srv/Spawn_Event",
            "request",
            [msg.get_service("turtlesim/srv/Spawn").Request()],
        ),
        ("shape_msgs/msg/SolidPrimitive", "dimensions", array("d", [1.0] * 3)),
        ("shape_msgs/msg/SolidPrimitive", "dimensions", [1.0] * 3),
    ],
)
def test_values_at_the_limits_are_taken(name, field, value):
    message = _make(name, **{field: value})
    assert message == msg.get_message(name)(**{field: value})


def test_every_later_assignment_is_checked():
    message = _make("geometry_msgs/msg/Twist")
    with pytest.raises(
        AssertionError, match="The 'linear' field must be a sub message of type 'Vector3'"
    ):
        message.linear = None
    message.linear = Vector3(x=2.0)
    assert message == Twist(linear=Vector3(x=2.0))
    assert msg.serialize(message) == msg.serialize(Twist(linear=Vector3(x=2.0)))
    assert isinstance(message, Twist)
    assert repr(message) == repr(Twist(linear=Vector3(x=2.0)))


def test_sequences_are_checked_before_they_are_converted():
    scan = _make("sensor_msgs/msg/LaserScan")
    scan.ranges = [1.0]
    with pytest.raises(AssertionError) as caught:
        scan.ranges = [1]
    assert str(caught.value) == (
        "The 'ranges' field must be a set or sequence and each value of type 'float' and each "
        "float in "
        "[-340282346600000016151267322115014000640.000000, "
        "340282346600000016151267322115014000640.000000]"
    )
    with pytest.raises(
        AssertionError, match=r"The 'ranges' array.array\(\) must have the type code of 'f'"
    ):
        scan.ranges = array("d", [1.0])
    shape = _make("shape_msgs/msg/SolidPrimitive")
    with pytest.raises(
        AssertionError, match=r"The 'dimensions' array.array\(\) must have a size <= 3"
    ):
        shape.dimensions = array("d", [1.0] * 4)
    uuid = _make("unique_identifier_msgs/msg/UUID")
    with pytest.raises(
        AssertionError, match=r"The 'uuid' numpy.ndarray\(\) must have the dtype of 'numpy.uint8'"
    ):
        uuid.uuid = np.zeros(16)
    with pytest.raises(
        AssertionError,
        match="a set or sequence with length 16 and each value of type 'int' and each unsigned "
        "integer",
    ):
        uuid.uuid = [0] * 15
    with pytest.raises(AssertionError, match="The 'uuid' field must be a set or sequence"):
        uuid.uuid = 3
    names = _make("sensor_msgs/msg/JointState")
    with pytest.raises(
        AssertionError,
        match="The 'name' field must be a set or sequence and each value of type 'str'",
    ):
        names.name = "abc"


def test_without_checks_anything_can_be_assigned():
    assert Vector3(x="far", check_fields=False).x == "far"


@pytest.mark.parametrize(("value", "status"), [("1", 1), ("0", 0), ("", 0)])
def test_the_environment_turns_checks_on(value, status):
    program = "from turtlewire import msg; msg.get_message('std_msgs/msg/String')().data = 3"
    environment = {"ROS_PYTHON_CHECK_FIELDS": value, "PATH": ""}
    done = run_python(program, check=False, env=environment)
    assert done.returncode == status
    assert ("AssertionError: The 'data' field must be of type 'str'" in done.stderr) == bool(status)
