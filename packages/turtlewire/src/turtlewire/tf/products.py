"""Operators of transforms, for both cores: products, and interpolation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.geometry.poses import canonical, compose, interpolate

if TYPE_CHECKING:
    from typing import Any, Protocol, TypeVar

    from turtlewire.geometry.poses import Pose
    from turtlewire.geometry.quaternions import Quaternion, Vector

    class AnyTransform(Protocol):
        """A Transform of either core."""

        frame_id: str
        child_frame_id: str
        stamp_ns: int

        @property
        def translation(self) -> Vector:
            """In metres."""
            ...

        @property
        def rotation(self) -> Quaternion:
            """The unit quaternion x, y, z, w."""
            ...

    Transform = TypeVar("Transform", bound=AnyTransform)

__all__ = ["interpolated", "product"]


def product(self: Transform, other: Transform) -> Transform:
    """Return ``a_from_c`` for ``a_from_b @ b_from_c``, with the older stamp; 0 means no stamp.

    Raises:
        ValueError: The frames do not meet.
    """
    if not isinstance(other, type(self)):
        if hasattr(other, "__array_ufunc__"):  # NumPy would take the transform for seven numbers
            raise TypeError(
                f"a Transform times {type(other).__name__} is not defined; for points in an array "
                "use as_matrix(), or Buffer.transform_points"
            )
        return NotImplemented  # type: ignore[no-any-return] # Python then asks the other operand
    if self.child_frame_id != other.frame_id:
        raise ValueError(
            f"'{self.frame_id}' from '{self.child_frame_id}' and '{other.frame_id}' from "
            f"'{other.child_frame_id}' do not meet: '{self.child_frame_id}' is not "
            f"'{other.frame_id}'; inverse() turns a transform round"
        )
    stamps = [stamp for stamp in (self.stamp_ns, other.stamp_ns) if stamp]
    pose = canonical(compose(_pose(self), _pose(other)))
    return _made(self, other.child_frame_id, min(stamps, default=0), pose)


def interpolated(self: Transform, other: Transform, stamp_ns: int) -> Transform:
    """Return the transform at a time between two of the same frames: lerp and slerp, as tf2 does.

    Args:
        self: The transform at one time.
        other: The transform at another time.
        stamp_ns: A time from one's stamp to the other's, both included.

    Raises:
        ValueError: The frames differ, or the time lies outside.
    """
    names = (self.frame_id, self.child_frame_id), (other.frame_id, other.child_frame_id)
    if names[0] != names[1]:
        raise ValueError(f"transforms of different frames cannot be interpolated: {names}")
    first, last = sorted((self, other), key=lambda each: each.stamp_ns)
    if not first.stamp_ns <= stamp_ns <= last.stamp_ns:
        raise ValueError(f"{stamp_ns} is not between {first.stamp_ns} and {last.stamp_ns}")
    span = last.stamp_ns - first.stamp_ns
    ratio = (stamp_ns - first.stamp_ns) / span if span else 0.0
    pose = canonical(interpolate(_pose(first), _pose(last), ratio))
    return _made(self, self.child_frame_id, stamp_ns, pose)


def _pose(transform: AnyTransform) -> Pose:
    return (*transform.translation, *transform.rotation)


def _made(like: Transform, child: str, stamp_ns: int, pose: Pose) -> Transform:
    make: Any = type(like)
    made: Transform = make(like.frame_id, child, stamp_ns, pose[:3], pose[3:])
    return made
