"""Operators of transforms, for both cores: products and interpolation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.geometry.poses import canonical, compose, interpolate
from turtlewire.tf.datetimes import as_nanoseconds

if TYPE_CHECKING:
    from typing import Any, Protocol, TypeVar

    from turtlewire.geometry.poses import Pose
    from turtlewire.geometry.quaternions import Quaternion, Vector

    class AnyTransform(Protocol):
        """A Transform of either core."""

        @property
        def target_frame(self) -> str:
            """The frame in which the pose is."""
            ...

        @property
        def source_frame(self) -> str:
            """The frame whose pose it is."""
            ...

        @property
        def stamp_ns(self) -> int | None:
            """The time of the pose; None if it holds at all times."""
            ...

        @property
        def translation(self) -> Vector:
            """The translation, in metres."""
            ...

        @property
        def rotation(self) -> Quaternion:
            """The unit quaternion x, y, z, w."""
            ...

    Transform = TypeVar("Transform", bound=AnyTransform)

__all__ = ["interpolated", "product"]


def product(self: Transform, other: Transform) -> Transform:
    """Return ``a_from_c`` for ``a_from_b @ b_from_c``, with the older stamp.

    Raises:
        ValueError: The inner frames differ.
    """
    if not isinstance(other, type(self)):
        if hasattr(other, "__array_ufunc__"):  # NumPy would take the transform for seven numbers
            raise TypeError(
                f"a Transform times {type(other).__name__} is not defined; for points in an array "
                "use apply(), or Buffer.transform_points"
            )
        return NotImplemented  # type: ignore[no-any-return] # Python then asks the other operand
    if self.source_frame != other.target_frame:
        raise ValueError(
            f"cannot multiply '{self.target_frame}' from '{self.source_frame}' by "
            f"'{other.target_frame}' from '{other.source_frame}': the inner frames differ, "
            f"'{self.source_frame}' and '{other.target_frame}'; inverse() inverts a transform"
        )
    stamps = [stamp for stamp in (self.stamp_ns, other.stamp_ns) if stamp is not None]
    pose = canonical(compose(_pose(self), _pose(other)))
    return _made(self, other.source_frame, min(stamps, default=None), pose)


def interpolated(self: Transform, other: Transform, stamp_ns: int) -> Transform:
    """Return the transform at a time between two of the same frames: lerp and slerp, as tf2 does.

    Args:
        self: The transform at one time.
        other: The transform at another time.
        stamp_ns: A time from one's stamp to the other's, both included.

    Raises:
        ValueError: The frames differ, or the time lies outside.
    """
    names = (self.target_frame, self.source_frame), (other.target_frame, other.source_frame)
    if names[0] != names[1]:
        raise ValueError(f"transforms of different frames cannot be interpolated: {names}")
    stamp_ns = as_nanoseconds(stamp_ns, "stamp_ns")
    if self.stamp_ns is None or other.stamp_ns is None:
        raise ValueError("a transform without a stamp holds at all times: nothing to interpolate")
    (begin, first), (end, last) = sorted(
        ((self.stamp_ns, self), (other.stamp_ns, other)), key=lambda each: each[0]
    )
    if not begin <= stamp_ns <= end:
        raise ValueError(f"{stamp_ns} is not between {begin} and {end}")
    ratio = (stamp_ns - begin) / (end - begin) if end > begin else 0.0
    pose = canonical(interpolate(_pose(first), _pose(last), ratio))
    return _made(self, self.source_frame, stamp_ns, pose)


def _pose(transform: AnyTransform) -> Pose:
    return (*transform.translation, *transform.rotation)


def _made(like: Transform, source: str, stamp_ns: int | None, pose: Pose) -> Transform:
    make: Any = type(like)
    made: Transform = make(like.target_frame, source, pose[:3], pose[3:], stamp_ns=stamp_ns)
    return made
