"""The result of a lookup."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.geometry.poses import IDENTITY, Pose, between, canonical
from turtlewire.tf.products import interpolated, product

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import DTypeLike, NDArray

    from turtlewire.geometry.quaternions import Quaternion, Vector


class Transform:
    """The pose of ``child_frame_id`` (source) in ``frame_id`` (target) at one time.

    It is ``target_from_source``.

    Immutable. It takes data of the source frame into the target frame. Translation in metres;
    rotation a unit quaternion in the order x, y, z, w. ``numpy.asarray(transform)`` gives the seven
    numbers.
    """

    __module__ = "turtlewire"
    __slots__ = ("_pose", "child_frame_id", "frame_id", "stamp_ns")

    frame_id: str
    child_frame_id: str
    stamp_ns: int
    _pose: Pose

    def __init__(
        self,
        frame_id: str,
        child_frame_id: str,
        stamp_ns: int,
        translation: Vector,
        rotation: Quaternion,
    ) -> None:
        set_field = object.__setattr__
        set_field(self, "frame_id", frame_id)
        set_field(self, "child_frame_id", child_frame_id)
        set_field(self, "stamp_ns", stamp_ns)
        x, y, z = map(float, translation)
        qx, qy, qz, qw = map(float, rotation)
        set_field(self, "_pose", (x, y, z, qx, qy, qz, qw))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Transform is immutable; {name!r} cannot be set")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a Transform is immutable; {name!r} cannot be deleted")

    x = property(lambda self: self._pose[0], doc="Translation along x, in metres.")
    y = property(lambda self: self._pose[1], doc="Translation along y, in metres.")
    z = property(lambda self: self._pose[2], doc="Translation along z, in metres.")
    qx = property(lambda self: self._pose[3], doc="x of the unit quaternion.")
    qy = property(lambda self: self._pose[4], doc="y of the unit quaternion.")
    qz = property(lambda self: self._pose[5], doc="z of the unit quaternion.")
    qw = property(lambda self: self._pose[6], doc="w of the unit quaternion.")

    @property
    def translation(self) -> Vector:
        """(x, y, z) in metres."""
        return self._pose[:3]

    @property
    def rotation(self) -> Quaternion:
        """The unit quaternion (x, y, z, w)."""
        return self._pose[3:]

    def inverse(self) -> Transform:
        """Return the transform the other way round: source_from_target."""
        back = canonical(between(self._pose, IDENTITY))
        return Transform(self.child_frame_id, self.frame_id, self.stamp_ns, back[:3], back[3:])

    def __matmul__(self, other: Transform) -> Transform:
        return product(self, other)

    def interpolate(self, other: Transform, stamp_ns: int) -> Transform:
        """Return the transform at a time between two of the same frames."""
        return interpolated(self, other, stamp_ns)

    def as_matrix(self) -> NDArray[np.float64]:
        """Return the 4x4 matrix that acts on column vectors from the left."""
        from turtlewire.tf.arrays import pose_matrix

        return pose_matrix(self)

    def _repr_html_(self) -> str:
        """Numbers and a picture, for notebooks."""
        from turtlewire.tf.notebook import transform_html

        return transform_html(self)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        from turtlewire.tf.arrays import pose_array

        return pose_array(self, dtype, copy)

    def _fields(self) -> tuple[str, str, int, Vector, Quaternion]:
        return (self.frame_id, self.child_frame_id, self.stamp_ns, self.translation, self.rotation)

    def __reduce__(self) -> tuple[type[Transform], tuple[str, str, int, Vector, Quaternion]]:
        return (Transform, self._fields())

    def __eq__(self, other: object) -> bool:
        return self._fields() == other._fields() if isinstance(other, Transform) else NotImplemented

    # Poses are compared by value, but floats make poor keys.
    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return (
            f"Transform(frame_id={self.frame_id!r}, child_frame_id={self.child_frame_id!r}, "
            f"stamp_ns={self.stamp_ns}, "
            f"translation={self.translation!r}, rotation={self.rotation!r})"
        )
