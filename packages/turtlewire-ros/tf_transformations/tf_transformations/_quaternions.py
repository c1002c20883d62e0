"""One quaternion at a time, on plain floats: no NumPy is imported here."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from turtlewire.geometry import quaternions

if TYPE_CHECKING:
    from turtlewire.geometry.quaternions import Numbers, Quaternion

    #: ``"sxyz"``, or the numbers (inner axis, parity, repetition, frame) that stand for it.
    Axes = str | Sequence[int]

# The engine's function itself: a call in between would cost 6 % of the product.
quaternion_multiply = quaternions.multiply

#: Below this, rounding decides the quotient of a sine and a cosine, not their angle.
EPSILON = 4.0 * 2.0**-52


def axis_order(axes: Axes) -> tuple[int, int, int, bool]:
    """Read the name of an Euler convention.

    Args:
        axes: ``s`` (static axes) or ``r`` (rotating axes) and three letters of which no two
            neighbours are equal; or the same as numbers ``(first axis, parity, repetition,
            frame)``.

    Returns:
        The three axes as 0, 1, 2 in the order of the angles, and whether they turn along.

    Raises:
        KeyError: The convention does not exist.
    """
    if isinstance(axes, str):
        frame, letters = axes[:1].lower(), axes[1:].lower()
        known = frame in {"s", "r"} and len(letters) == 3 and set(letters) <= set("xyz")
        if known and letters[0] != letters[1] != letters[2]:
            return (
                "xyz".index(letters[0]),
                "xyz".index(letters[1]),
                "xyz".index(letters[2]),
                frame == "r",
            )
    elif len(axes) == 4 and axes[0] in {0, 1, 2} and set(axes[1:]) <= {0, 1}:
        first, parity, repetition, rotating = axes
        second = (first + 1 + parity) % 3
        third = first if repetition else 3 - first - second
        return (third, second, first, True) if rotating else (first, second, third, False)
    raise KeyError(
        f"unknown axes {axes!r}: expected 's' or 'r' and three of x, y, z without equal "
        "neighbours, as in 'sxyz'"
    )


def euler_from_rotation(
    rotation: Sequence[Sequence[float]], axes: Axes = "sxyz"
) -> tuple[float, float, float]:
    """Return the angles of a 3x3 rotation given as three rows.

    The last angle is 0 where only the sum of two is determined.
    """
    i, j, k, rotating = axis_order(axes)
    # About axes that turn along, the same rotation is that about static axes in reverse order.
    if rotating:
        i, k = k, i
    repeated = i == k
    if repeated:
        k = 3 - i - j
    # Against the cyclic order x, y, z the same formulas hold with all angles negated.
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    if repeated:
        sine = math.hypot(rotation[i][j], rotation[i][k])
        determined = sine > EPSILON
        first = math.atan2(rotation[i][j], rotation[i][k])
        second = math.atan2(sine, rotation[i][i])
        third = math.atan2(rotation[j][i], -rotation[k][i])
    else:
        cosine = math.hypot(rotation[i][i], rotation[j][i])
        determined = cosine > EPSILON
        first = math.atan2(rotation[k][j], rotation[k][k])
        second = math.atan2(-rotation[k][i], cosine)
        third = math.atan2(rotation[j][i], rotation[i][i])
    # Gimbal lock: the first and the last axis coincide.
    if not determined:
        first, third = math.atan2(-rotation[j][k], rotation[j][j]), 0.0
    angles = (sign * first, sign * second, sign * third)
    return angles[::-1] if rotating else angles


def rotation_from_quaternion(quaternion: Numbers) -> tuple[tuple[float, float, float], ...]:
    """Return the three rows of the rotation matrix.

    The quaternion need not be normalised; zero means no rotation.
    """
    x, y, z, w = quaternion
    norm = x * x + y * y + z * z + w * w
    if norm < EPSILON / 4.0:
        return (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    rows = quaternions.matrix(quaternion)
    return rows[:3], rows[3:6], rows[6:]


def quaternion_conjugate(quaternion: Numbers) -> Quaternion:
    """Return the opposite rotation of a unit quaternion."""
    return quaternions.conjugate(quaternion)


def quaternion_inverse(quaternion: Numbers) -> Quaternion:
    """Return the quaternion whose product with this one is ``(0, 0, 0, 1)``, normalised or not."""
    x, y, z, w = quaternion
    norm = x * x + y * y + z * z + w * w
    return -x / norm, -y / norm, -z / norm, w / norm


def quaternion_about_axis(angle: float, axis: Numbers) -> Quaternion:
    """Return the rotation by ``angle`` [rad] about ``axis`` (of any length but zero)."""
    x, y, z = axis
    scale = math.sin(angle / 2.0) / math.sqrt(x * x + y * y + z * z)
    return x * scale, y * scale, z * scale, math.cos(angle / 2.0)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Quaternion:
    """Return the quaternion of three angles.

    Args:
        ai: Angle about the first axis of ``axes`` [rad]; roll, by default.
        aj: Angle about the second axis [rad]; pitch, by default.
        ak: Angle about the third axis [rad]; yaw, by default.
        axes: Convention of the angles, for example ``"sxyz"`` or ``"rzyx"``.

    Returns:
        ``(x, y, z, w)``.

    Raises:
        KeyError: The convention does not exist.
    """
    *order, rotating = axis_order(axes)
    product: Quaternion | None = None
    for axis, angle in zip(order, (ai, aj, ak), strict=True):
        turn = [0.0, 0.0, 0.0, math.cos(angle / 2.0)]
        turn[axis] = math.sin(angle / 2.0)
        if product is None:
            product = (turn[0], turn[1], turn[2], turn[3])
        else:
            product = (
                quaternion_multiply(product, turn)
                if rotating
                else quaternion_multiply(turn, product)
            )
    assert product is not None
    return product


def euler_from_quaternion(quaternion: Numbers, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """Return the angles [rad] about the three axes of ``axes``.

    Roll, pitch and yaw by default. The quaternion need not be normalised.
    """
    return euler_from_rotation(rotation_from_quaternion(quaternion), axes)
