"""The types as tf2_ros.Buffer.transform takes them."""

import copy

import pytest
from tests.programs import run_python

import tf2_geometry_msgs as tf2
import tf2_ros
from geometry_msgs import msg as geometry
from nav_msgs.msg import Odometry, Path
from rclpy.duration import Duration
from rclpy.time import Time

STAMPED = [
    geometry.PointStamped,
    geometry.Vector3Stamped,
    geometry.QuaternionStamped,
    geometry.PoseStamped,
    geometry.PoseArray,
    geometry.PoseWithCovarianceStamped,
    geometry.PolygonStamped,
    geometry.PolygonInstanceStamped,
    geometry.TransformStamped,
    geometry.TwistStamped,
    geometry.TwistWithCovarianceStamped,
    geometry.VelocityStamped,
    geometry.WrenchStamped,
    Path,
    Odometry,
]
CONTENTS = {
    geometry.PoseArray: {"poses": [geometry.Pose()]},
    geometry.PolygonStamped: {"polygon": geometry.Polygon(points=[geometry.Point32()])},
    geometry.TransformStamped: {"child_frame_id": "gripper"},
    geometry.VelocityStamped: {"body_frame_id": "body", "reference_frame_id": "world"},
    Path: {"poses": [geometry.PoseStamped()]},
}


@pytest.fixture
def buffer(quarter_turn):
    buffer = tf2_ros.Buffer()
    for second in (10, 20):
        quarter_turn.message.header.stamp.sec = second
        buffer.set_transform(quarter_turn.message, "test")
    return buffer


@pytest.mark.parametrize("kind", STAMPED, ids=lambda kind: kind.__name__)
def test_a_buffer_transforms_it_at_the_time_of_its_stamp(buffer, kind):
    message = kind()
    message.header.frame_id, message.header.stamp.sec = "source", 15
    moved = buffer.transform(message, "target")
    assert type(moved) is kind
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("target", 15)
    full = buffer.transform_full(message, "target", Time(seconds=16), "target")
    assert (full.header.frame_id, full.header.stamp.sec) == ("target", 16)


@pytest.mark.parametrize("kind", STAMPED, ids=lambda kind: kind.__name__)
def test_arguments_stay_and_headers_are_copies(some_world, kind):
    message = kind(**CONTENTS.get(kind, {}))
    if hasattr(message, "pose") and hasattr(message.pose, "covariance"):
        message.pose.covariance[:] = [float(number) for number in range(36)]
    message.header.frame_id, message.header.stamp.sec = "source", 99
    before = copy.deepcopy((message, some_world.message))
    result = tf2_ros.TransformRegistration().get(kind)(message, some_world.message)
    assert type(result) is kind
    assert result.header == some_world.message.header
    result.header.frame_id, result.header.stamp.sec = "changed", 1
    assert (message, some_world.message) == before


def test_stamp_0_gets_the_time_of_the_answer(buffer):
    point = geometry.PointStamped()
    point.header.frame_id = "source"
    assert buffer.transform(point, "target").header.stamp.sec == 20
    assert point.header.stamp.sec == 0


def test_every_type_converts_to_itself():
    for kind in STAMPED:
        message = kind()
        assert tf2_ros.ConvertRegistration().get_to_msg(kind)(message) is message
        assert tf2_ros.convert(message, kind) == message
    assert tf2.from_msg_msg(message) is message


def test_no_type_passes_for_another(buffer):
    point = geometry.PointStamped()
    with pytest.raises(
        tf2_ros.TypeException, match=r"No conversion from .*PointStamped.* to .*PoseStamped"
    ):
        tf2_ros.convert(point, geometry.PoseStamped)
    point.header.frame_id = "source"
    with pytest.raises(tf2_ros.TypeException):
        buffer.transform(point, "target", new_type=geometry.PoseStamped)


def test_a_buffer_says_when_it_cannot(buffer):
    point = geometry.PointStamped()
    point.header.frame_id = "nowhere"
    with pytest.raises(tf2_ros.LookupException):
        buffer.transform(point, "target", Duration())


def test_importing_it_is_light():
    program = (
        "import sys, tf2_geometry_msgs; print('numpy' in sys.modules); "
        "tf2_geometry_msgs.array_from_pose; print('numpy' in sys.modules)"
    )
    printed = run_python(program).stdout
    assert printed.split() == ["False", "True"]


def test_the_package_lists_what_it_has():
    assert len(tf2.__all__) == len(set(tf2.__all__)) == 49
    for name in tf2.__all__:
        assert callable(getattr(tf2, name))
        assert getattr(tf2, name).__doc__
    assert set(tf2.__all__) <= set(dir(tf2))
    with pytest.raises(AttributeError, match="has no attribute 'nonsense'"):
        tf2.nonsense  # noqa: B018


def test_ros_2s_module_path_has_ros_2s_functions():
    from tf2_geometry_msgs import tf2_geometry_msgs as module

    assert len(module.__all__) == 9
    assert all(getattr(module, name) is getattr(tf2, name) for name in module.__all__)
