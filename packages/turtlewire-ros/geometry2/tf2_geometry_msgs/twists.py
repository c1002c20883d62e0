"""Velocities, and forces with torques, in another frame. Nothing changes its arguments.

A twist says how the origin of its frame moves, as a point of the body, and how the body turns; a
wrench says which force acts at the origin of its frame, and which torque about it. In another frame
the point of reference is another one, so the distance of the frames counts::

    v' = R v + t x (R w)    w' = R w          velocity
    f' = R f                m' = R m + t x (R f)          force and torque

Power, ``f . v + m . w``, is the same in both. To turn the axes only, give the parts to
``do_transform_vector3``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import (
    Twist,
    TwistStamped,
    TwistWithCovariance,
    TwistWithCovarianceStamped,
    Vector3,
    VelocityStamped,
    Wrench,
    WrenchStamped,
)
from tf2_geometry_msgs.motion import Motion
from tf2_geometry_msgs.vectors import header_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geometry_msgs.msg import TransformStamped


def do_transform_twist(twist: Twist, transform: TransformStamped | Any) -> Twist:
    """Return the same motion, stated for the origin of the target frame and in its axes."""
    motion = Motion(transform)
    return Twist(
        linear=_vector3(motion.moment(twist.linear, twist.angular)),
        angular=_vector3(motion.vector(twist.angular)),
    )


def do_transform_twist_stamped(twist: TwistStamped, transform: TransformStamped) -> TwistStamped:
    """:func:`do_transform_twist` with stamp and frame of the transform."""
    return TwistStamped(
        header=header_of(transform), twist=do_transform_twist(twist.twist, transform)
    )


def do_transform_velocity_stamped(
    velocity: VelocityStamped, transform: TransformStamped
) -> VelocityStamped:
    """:func:`do_transform_twist` with stamp and frame of the transform.

    Whose velocity it is, and relative to what, stays.
    """
    return VelocityStamped(
        header=header_of(transform),
        body_frame_id=velocity.body_frame_id,
        reference_frame_id=velocity.reference_frame_id,
        velocity=do_transform_twist(velocity.velocity, transform),
    )


def do_transform_twist_with_covariance(
    twist: TwistWithCovariance, transform: TransformStamped | Any
) -> TwistWithCovariance:
    """Return an uncertain motion at the origin of the target frame, in its axes."""
    moved = do_transform_twist(twist.twist, transform)
    return TwistWithCovariance(
        twist=moved, covariance=transform_twist_covariance(twist.covariance, transform)
    )


def do_transform_twist_with_covariance_stamped(
    twist: TwistWithCovarianceStamped, transform: TransformStamped
) -> TwistWithCovarianceStamped:
    """:func:`do_transform_twist_with_covariance` with stamp and frame of the transform."""
    return TwistWithCovarianceStamped(
        header=header_of(transform),
        twist=do_transform_twist_with_covariance(twist.twist, transform),
    )


def do_transform_wrench(wrench: Wrench, transform: TransformStamped | Any) -> Wrench:
    """Return the same load, stated for the origin of the target frame and in its axes."""
    motion = Motion(transform)
    return Wrench(
        force=_vector3(motion.vector(wrench.force)),
        torque=_vector3(motion.moment(wrench.torque, wrench.force)),
    )


def do_transform_wrench_stamped(
    wrench: WrenchStamped, transform: TransformStamped
) -> WrenchStamped:
    """:func:`do_transform_wrench` with stamp and frame of the transform."""
    return WrenchStamped(
        header=header_of(transform), wrench=do_transform_wrench(wrench.wrench, transform)
    )


def transform_twist_covariance(
    cov_in: ArrayLike, transform: TransformStamped | Any
) -> NDArray[Any]:
    """Return the covariance of a twist in the frame of a transform that is certain.

    Args:
        cov_in: 36 numbers, row by row: the linear velocity [m/s], then the angular one [rad/s].
        transform: ``TransformStamped`` or ``Transform``.

    Returns:
        Shape ``(36,)``. An uncertain angular velocity makes the velocity of a distant point
        uncertain as well.
    """
    import numpy as np

    motion = Motion(transform)
    turn = np.reshape(motion.rows, (3, 3))
    x, y, z = motion.translation
    # The adjoint of the transform: it takes (v, w) to the other origin.
    target_from_source = np.zeros((6, 6))
    target_from_source[:3, :3] = target_from_source[3:, 3:] = turn
    target_from_source[:3, 3:] = np.array([(0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)]) @ turn
    covariance = np.reshape(np.asarray(cov_in, dtype=float), (6, 6))
    moved: NDArray[Any] = (target_from_source @ covariance @ target_from_source.T).reshape(36)
    return moved


def _vector3(values: tuple[float, float, float]) -> Vector3:
    x, y, z = values
    return Vector3(x=x, y=y, z=z)
