"""Transforms messages of geometry_msgs, also types that ROS 2 transforms only in C++.

Importing it makes ``tf2_ros.Buffer.transform`` take these stamped types: points, vectors,
quaternions, poses, arrays of poses, paths, poses with covariance, odometry, twists (with
covariance), velocities, wrenches, polygons and transforms.

The functions named ``X_from_Y`` turn messages into NumPy arrays and back; they, and NumPy, are
loaded when they are first used.

============================  ==========================================
module                        contents
============================  ==========================================
`vectors`, `poses`, `twists`  the transforms, by kind of message
`motion`                      a transform applied to plain floats
`numpy_bridge`                ``X_from_Y``: messages as arrays, and back
`tf2_geometry_msgs`           ROS 2's module of this name
============================  ==========================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

import tf2_ros
from geometry_msgs import msg as geometry
from nav_msgs.msg import Odometry, Path
from tf2_geometry_msgs.poses import (
    do_transform_odometry,
    do_transform_path,
    do_transform_pose,
    do_transform_pose_array,
    do_transform_pose_stamped,
    do_transform_pose_with_covariance,
    do_transform_pose_with_covariance_stamped,
    do_transform_transform,
    do_transform_transform_stamped,
    transform_covariance,
)
from tf2_geometry_msgs.twists import (
    do_transform_twist,
    do_transform_twist_stamped,
    do_transform_twist_with_covariance,
    do_transform_twist_with_covariance_stamped,
    do_transform_velocity_stamped,
    do_transform_wrench,
    do_transform_wrench_stamped,
    transform_twist_covariance,
)
from tf2_geometry_msgs.vectors import (
    do_transform_point,
    do_transform_point32,
    do_transform_polygon,
    do_transform_polygon_instance,
    do_transform_polygon_instance_stamped,
    do_transform_polygon_stamped,
    do_transform_quaternion,
    do_transform_quaternion_stamped,
    do_transform_vector3,
)

if TYPE_CHECKING:
    from tf2_geometry_msgs.numpy_bridge import (
        array_from_point,
        array_from_points,
        array_from_pose,
        array_from_poses,
        array_from_quaternion,
        array_from_transform,
        array_from_vector3,
        euler_from_quaternion,
        matrix_from_pose,
        matrix_from_transform,
        point_from_array,
        points_from_array,
        pose_from_array,
        pose_from_matrix,
        poses_from_array,
        quaternion_from_array,
        quaternion_from_euler,
        transform_from_array,
        transform_from_matrix,
        vector3_from_array,
    )

__all__ = [
    "array_from_point",
    "array_from_points",
    "array_from_pose",
    "array_from_poses",
    "array_from_quaternion",
    "array_from_transform",
    "array_from_vector3",
    "do_transform_odometry",
    "do_transform_path",
    "do_transform_point",
    "do_transform_point32",
    "do_transform_polygon",
    "do_transform_polygon_instance",
    "do_transform_polygon_instance_stamped",
    "do_transform_polygon_stamped",
    "do_transform_pose",
    "do_transform_pose_array",
    "do_transform_pose_stamped",
    "do_transform_pose_with_covariance",
    "do_transform_pose_with_covariance_stamped",
    "do_transform_quaternion",
    "do_transform_quaternion_stamped",
    "do_transform_transform",
    "do_transform_transform_stamped",
    "do_transform_twist",
    "do_transform_twist_stamped",
    "do_transform_twist_with_covariance",
    "do_transform_twist_with_covariance_stamped",
    "do_transform_vector3",
    "do_transform_velocity_stamped",
    "do_transform_wrench",
    "do_transform_wrench_stamped",
    "euler_from_quaternion",
    "from_msg_msg",
    "matrix_from_pose",
    "matrix_from_transform",
    "point_from_array",
    "points_from_array",
    "pose_from_array",
    "pose_from_matrix",
    "poses_from_array",
    "quaternion_from_array",
    "quaternion_from_euler",
    "to_msg_msg",
    "transform_covariance",
    "transform_from_array",
    "transform_from_matrix",
    "transform_twist_covariance",
    "vector3_from_array",
]

_M = TypeVar("_M")


def to_msg_msg(msg: _M) -> _M:
    """Return a message as a message: itself."""
    return msg


def from_msg_msg(msg: _M) -> _M:
    """Return a message of a message: itself."""
    return msg


for _message_type, _do_transform in (
    (geometry.PointStamped, do_transform_point),
    (geometry.Vector3Stamped, do_transform_vector3),
    (geometry.QuaternionStamped, do_transform_quaternion_stamped),
    (geometry.PolygonStamped, do_transform_polygon_stamped),
    (geometry.PolygonInstanceStamped, do_transform_polygon_instance_stamped),
    (geometry.PoseStamped, do_transform_pose_stamped),
    (geometry.PoseArray, do_transform_pose_array),
    (geometry.PoseWithCovarianceStamped, do_transform_pose_with_covariance_stamped),
    (geometry.TransformStamped, do_transform_transform_stamped),
    (Path, do_transform_path),
    (Odometry, do_transform_odometry),
    (geometry.TwistStamped, do_transform_twist_stamped),
    (geometry.TwistWithCovarianceStamped, do_transform_twist_with_covariance_stamped),
    (geometry.VelocityStamped, do_transform_velocity_stamped),
    (geometry.WrenchStamped, do_transform_wrench_stamped),
):
    tf2_ros.TransformRegistration().add(_message_type, _do_transform)
    tf2_ros.ConvertRegistration().add_to_msg(_message_type, to_msg_msg)
    tf2_ros.ConvertRegistration().add_from_msg(_message_type, from_msg_msg)
del _message_type, _do_transform


#: Messages that ROS 2's package has because it imports them; programs take them from here.
_MESSAGES = {
    *("PointStamped", "PolygonStamped", "Pose", "PoseStamped", "PoseWithCovarianceStamped"),
    *("TransformStamped", "Vector3Stamped", "WrenchStamped"),
}


def __getattr__(name: str) -> Any:
    if name not in __all__ and name not in _MESSAGES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    home = "geometry_msgs.msg" if name in _MESSAGES else "tf2_geometry_msgs.numpy_bridge"
    value = globals()[name] = getattr(import_module(home), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
