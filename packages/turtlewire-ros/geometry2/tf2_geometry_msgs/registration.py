"""Tells tf2_ros which function transforms which stamped type."""

from __future__ import annotations

from typing import TypeVar

import tf2_ros
from geometry_msgs import msg as geometry
from nav_msgs.msg import Odometry, Path
from tf2_geometry_msgs import poses, twists, vectors

_M = TypeVar("_M")


def to_msg_msg(msg: _M) -> _M:
    """Return a message as a message: itself."""
    return msg


def from_msg_msg(msg: _M) -> _M:
    """Return a message of a message: itself."""
    return msg


def register() -> None:
    """Make ``Buffer.transform`` and ``tf2_ros.convert`` know the stamped types."""
    transforms, conversions = tf2_ros.TransformRegistration(), tf2_ros.ConvertRegistration()
    for message_type, do_transform in (
        (geometry.PointStamped, vectors.do_transform_point),
        (geometry.Vector3Stamped, vectors.do_transform_vector3),
        (geometry.QuaternionStamped, vectors.do_transform_quaternion_stamped),
        (geometry.PolygonStamped, vectors.do_transform_polygon_stamped),
        (geometry.PolygonInstanceStamped, vectors.do_transform_polygon_instance_stamped),
        (geometry.PoseStamped, poses.do_transform_pose_stamped),
        (geometry.PoseArray, poses.do_transform_pose_array),
        (geometry.PoseWithCovarianceStamped, poses.do_transform_pose_with_covariance_stamped),
        (geometry.TransformStamped, poses.do_transform_transform_stamped),
        (Path, poses.do_transform_path),
        (Odometry, poses.do_transform_odometry),
        (geometry.TwistStamped, twists.do_transform_twist_stamped),
        (geometry.TwistWithCovarianceStamped, twists.do_transform_twist_with_covariance_stamped),
        (geometry.VelocityStamped, twists.do_transform_velocity_stamped),
        (geometry.WrenchStamped, twists.do_transform_wrench_stamped),
    ):
        transforms.add(message_type, do_transform)
        conversions.add_to_msg(message_type, to_msg_msg)
        conversions.add_from_msg(message_type, from_msg_msg)
