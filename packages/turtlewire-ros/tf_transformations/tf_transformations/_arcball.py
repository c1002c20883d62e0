"""Rotates an object with the mouse as if it were in a glass ball (Ken Shoemake's arcball)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ._arrays import quaternion_slerp, unit_vector
from ._composition import quaternion_from_matrix, quaternion_matrix
from ._quaternions import EPSILON, quaternion_multiply

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.geometry.quaternions import Numbers

    Vector = NDArray[np.float64]


def arcball_map_to_sphere(point: Numbers, center: Numbers, radius: float) -> Vector:
    """Return the unit vector on the ball under a window position (y down).

    Positions outside the ball go to its rim.
    """
    x, y = (point[0] - center[0]) / radius, (center[1] - point[1]) / radius
    square = x * x + y * y
    if square > 1.0:
        return np.array([x / math.sqrt(square), y / math.sqrt(square), 0.0])
    return np.array([x, y, math.sqrt(1.0 - square)])


def arcball_constrain_to_axis(point: ArrayLike, axis: ArrayLike) -> Vector:
    """Return the nearest point of the ball's front half in the plane across ``axis`` (unit)."""
    normal = np.asarray(axis, dtype=np.float64)
    vector = np.asarray(point, dtype=np.float64)
    vector = vector - normal * (normal @ vector)
    length = math.sqrt(vector @ vector)
    if length > EPSILON:
        # The back half cannot be seen, so take the opposite point.
        return -vector / length if vector[2] < 0.0 else vector / length
    if normal[2] == 1.0:
        return np.array([1.0, 0.0, 0.0])
    across: Vector = unit_vector([-normal[1], normal[0], 0.0])
    return across


def arcball_nearest_axis(point: ArrayLike, axes: Sequence[ArrayLike]) -> ArrayLike | None:
    """Return the one of ``axes`` whose plane is nearest to the point; None if ``axes`` is empty."""
    vector = np.asarray(point, dtype=np.float64)
    return max(
        axes, key=lambda axis: float(arcball_constrain_to_axis(vector, axis) @ vector), default=None
    )


class Arcball:
    """Keeps the orientation of an object that is rotated with the mouse.

    Args:
        initial: Orientation at the start: a quaternion ``(x, y, z, w)``, a 4x4 matrix, or None for
            no rotation.

    Raises:
        ValueError: ``initial`` is neither.
    """

    def __init__(self, initial: ArrayLike | None = None) -> None:
        orientation = np.array(
            [0.0, 0.0, 0.0, 1.0] if initial is None else initial, dtype=np.float64
        )
        if orientation.shape == (4, 4):
            orientation = np.array(quaternion_from_matrix(orientation))
        elif orientation.shape != (4,):
            raise ValueError("initial not a quaternion or matrix.")
        self._pressed_at = np.array([0.0, 0.0, 1.0])
        self._pressed = self._previous = self._now = unit_vector(orientation)
        self._center: Numbers = (0.0, 0.0)
        self._radius = 1.0
        self._axes: list[Vector] | None = None
        self._axis: ArrayLike | None = None
        self._constrain = False

    def place(self, center: Numbers, radius: float) -> None:
        """Put the ball at ``center`` of the window, with ``radius``, both in pixels."""
        self._center = center
        self._radius = float(radius)

    def setaxes(self, *axes: ArrayLike) -> None:
        """Set the axes that a constrained rotation may go about; no argument, or None, for none."""
        self._axes = [unit_vector(axis) for axis in axes] if axes and axes[0] is not None else None

    def setconstrain(self, constrain: bool) -> None:
        """Turn constrained rotation on or off; it acts from the next press on."""
        self._constrain = constrain is True

    def getconstrain(self) -> bool:
        """Return True if constrained rotation is on."""
        return self._constrain

    def down(self, point: Numbers) -> None:
        """Press the mouse at a window position."""
        self._pressed_at = arcball_map_to_sphere(point, self._center, self._radius)
        self._pressed = self._previous = self._now
        self._axis = None
        if self._constrain and self._axes is not None:
            self._axis = arcball_nearest_axis(self._pressed_at, self._axes)
        if self._axis is not None:
            self._pressed_at = arcball_constrain_to_axis(self._pressed_at, self._axis)

    def drag(self, point: Numbers) -> None:
        """Move the pressed mouse to a window position."""
        here = arcball_map_to_sphere(point, self._center, self._radius)
        if self._axis is not None:
            here = arcball_constrain_to_axis(here, self._axis)
        self._previous = self._now
        across = np.cross(self._pressed_at, here)
        # The direction of the axis would be noise.
        if across @ across < EPSILON:
            self._now = self._pressed
        else:
            # Not halved: an arcball turns by twice the angle between the points.
            turn = (*across.tolist(), float(self._pressed_at @ here))
            self._now = np.array(quaternion_multiply(turn, self._pressed.tolist()))

    def next(self, acceleration: float = 0.0) -> None:
        """Go on turning as between the last two positions."""
        # A fraction of 2 goes as far beyond the last position as that is from the one before.
        ahead = quaternion_slerp(self._previous, self._now, 2.0 + acceleration, 0, False)
        self._previous, self._now = self._now, ahead

    def matrix(self) -> NDArray[np.float64]:
        """Return the orientation as a 4x4 matrix."""
        return quaternion_matrix(self._now.tolist())
