"""Poses, paths and transforms in another frame. Nothing changes its arguments."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import (
    Point,
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Transform,
    TransformStamped,
    Vector3,
)
from nav_msgs.msg import Odometry, Path
from tf2_geometry_msgs.motion import Motion
from tf2_geometry_msgs.vectors import copy_of, header_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def do_transform_pose(pose: Pose, transform: TransformStamped | Any) -> Pose:
    """Return a pose in the frame of a transform; its quaternion gets unit length and w >= 0."""
    if hasattr(pose, "pose"):
        raise _wrong_pose(
            "do_transform_pose",
            "Pose",
            pose,
            "do_transform_pose_stamped" if isinstance(pose, PoseStamped) else "its .pose",
        )
    return _moved(pose, Motion(transform))


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """Return a pose in the frame of a transform, with stamp and frame of the transform."""
    if not hasattr(pose, "pose"):
        raise _wrong_pose("do_transform_pose_stamped", "PoseStamped", pose, "do_transform_pose")
    return PoseStamped(header=header_of(transform), pose=_moved(pose.pose, Motion(transform)))


def do_transform_pose_array(poses: PoseArray, transform: TransformStamped) -> PoseArray:
    """Return all poses of an array, with stamp and frame of the transform."""
    return PoseArray(header=header_of(transform), poses=_all_moved(poses.poses, transform))


def do_transform_path(path: Path, transform: TransformStamped) -> Path:
    """Return a path in the frame of a transform.

    One transform takes the whole path, whose header gets stamp and frame of it. The poses get the
    frame and keep their stamps: they are the times at which the poses are reached.

    Raises:
        ValueError: A pose names another frame than the path; it needs its own transform.
    """
    frame = path.header.frame_id
    for index, pose in enumerate(path.poses):
        if pose.header.frame_id not in {"", frame}:
            raise ValueError(
                f"poses[{index}] is in frame {pose.header.frame_id!r}, the path in {frame!r}: one "
                "transform cannot apply to both; transform the poses one by one"
            )
    header = header_of(transform)
    moved = _all_moved([pose.pose for pose in path.poses], transform)
    stamps = [pose.header.stamp for pose in path.poses]
    poses = [
        PoseStamped(header=copy_of(stamp, header.frame_id), pose=pose)
        for stamp, pose in zip(stamps, moved, strict=True)
    ]
    return Path(header=header, poses=poses)


def do_transform_pose_with_covariance(
    pose: PoseWithCovariance, transform: TransformStamped | Any
) -> PoseWithCovariance:
    """Return an uncertain pose in the frame of a transform that is certain."""
    moved = _moved(pose.pose, Motion(transform))
    return PoseWithCovariance(
        pose=moved, covariance=transform_covariance(pose.covariance, transform)
    )


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """Return an uncertain pose in the frame of an exact transform, with its stamp and frame."""
    return PoseWithCovarianceStamped(
        header=header_of(transform), pose=do_transform_pose_with_covariance(pose.pose, transform)
    )


def do_transform_odometry(odometry: Odometry, transform: TransformStamped) -> Odometry:
    """Return an odometry's pose in a transform's frame, with its stamp and frame id.

    Its twist is one in the axes of ``child_frame_id``, the body, and stays as it is.
    """
    pose = do_transform_pose_with_covariance(odometry.pose, transform)
    return Odometry(
        header=header_of(transform),
        child_frame_id=odometry.child_frame_id,
        pose=pose,
        twist=copy.deepcopy(odometry.twist),
    )


def do_transform_transform(inner: Transform, transform: TransformStamped | Any) -> Transform:
    """Return a transform after another: ``target_from_x = target_from_source * source_from_x``."""
    motion = Motion(transform)
    x, y, z = motion.point(inner.translation)
    qx, qy, qz, qw = motion.orientation(inner.rotation)
    return Transform(
        translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)
    )


def do_transform_transform_stamped(
    inner: TransformStamped, transform: TransformStamped
) -> TransformStamped:
    """Return a transform after another, with stamp and frame of the outer one; the child stays."""
    moved = do_transform_transform(inner.transform, transform)
    return TransformStamped(
        header=header_of(transform), child_frame_id=inner.child_frame_id, transform=moved
    )


def transform_covariance(cov_in: ArrayLike, transform: TransformStamped | Any) -> NDArray[Any]:
    """Return the covariance of a pose in the frame of a transform that is certain.

    Args:
        cov_in: 36 numbers, row by row: x, y, z [m], then the rotations about the fixed axes x, y, z
            [rad].
        transform: ``TransformStamped`` or ``Transform``.

    Returns:
        Shape ``(36,)``. Errors of position and of orientation are vectors at the pose itself, so
        both are turned and nothing else: how far the frames are apart does not matter.
    """
    import numpy as np

    turn = np.reshape(Motion(transform).rows, (3, 3))
    blocks = np.reshape(np.asarray(cov_in, dtype=float), (2, 3, 2, 3))
    # R C R^T for each of the four blocks.
    turned: NDArray[Any] = np.einsum("ij,ajbk,lk->aibl", turn, blocks, turn).reshape(36)
    return turned


def _moved(pose: Any, motion: Motion) -> Pose:
    x, y, z = motion.point(pose.position)
    qx, qy, qz, qw = motion.orientation(pose.orientation)
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))


def _all_moved(poses: Sequence[Any], transform: Any) -> list[Pose]:
    motion = Motion(transform)
    return [_moved(pose, motion) for pose in poses]


def _wrong_pose(function: str, expected: str, got: Any, remedy: str) -> TypeError:
    return TypeError(
        f"{function} takes a geometry_msgs.msg.{expected}, got {type(got).__name__}: use {remedy}"
    )
