"""The result of a lookup."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.call_errors import explain_calls
from turtlewire.geometry.poses import IDENTITY, Pose, between, canonical
from turtlewire.tf.plain.checks import check_frames, moments, numbers
from turtlewire.tf.products import interpolated, product

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, DTypeLike, NDArray

    from turtlewire.geometry.quaternions import Quaternion, Vector


@explain_calls
class Transform:
    """The pose of ``source_frame`` in ``target_frame`` at one time: ``target_from_source``.

    Immutable. It takes data of the source frame into the target frame. Translation in metres;
    rotation a unit quaternion in the order x, y, z, w. ``numpy.asarray(transform)`` gives the seven
    numbers.

    Raises:
        ValueError: The rotation has length 0. Other lengths are corrected where it is used.
    """

    __module__ = "turtlewire"
    __slots__ = ("_pose", "source_frame", "stamp_ns", "target_frame")

    target_frame: str
    source_frame: str
    stamp_ns: int | None
    _pose: Pose

    def __init__(
        self,
        target_frame: str,
        source_frame: str,
        translation: Vector,
        rotation: Quaternion = (0.0, 0.0, 0.0, 1.0),
        *,
        stamp_ns: int | None = None,
    ) -> None:
        check_frames(target_frame=target_frame, source_frame=source_frame)
        set_field = object.__setattr__
        set_field(self, "target_frame", target_frame)
        set_field(self, "source_frame", source_frame)
        set_field(self, "stamp_ns", moments(stamp_ns=stamp_ns)[0])
        x, y, z = numbers("translation", translation, 3)
        qx, qy, qz, qw = numbers("rotation", rotation, 4)
        if qx * qx + qy * qy + qz * qz + qw * qw == 0:
            raise ValueError("rotation must not be (0, 0, 0, 0); the identity is (0, 0, 0, 1)")
        set_field(self, "_pose", (x, y, z, qx, qy, qz, qw))

    @classmethod
    def from_matrix(
        cls,
        target_frame: str,
        source_frame: str,
        matrix: ArrayLike,
        *,
        stamp_ns: int | None = None,
    ) -> Transform:
        """Return the transform of a homogeneous 4x4 matrix.

        Raises:
            InvalidTransformError: The matrix is not a rotation and a translation.
        """
        from turtlewire.tf.arrays import of_matrix

        made: Transform = of_matrix(cls, target_frame, source_frame, matrix, stamp_ns=stamp_ns)
        return made

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Transform is immutable; {name!r} cannot be set")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a Transform is immutable; {name!r} cannot be deleted")

    x = property(lambda self: self._pose[0], doc="Translation along x, in metres.")
    y = property(lambda self: self._pose[1], doc="Translation along y, in metres.")
    z = property(lambda self: self._pose[2], doc="Translation along z, in metres.")

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
        return Transform(
            self.source_frame, self.target_frame, back[:3], back[3:], stamp_ns=self.stamp_ns
        )

    @property
    def euler(self) -> Vector:
        """Roll, pitch and yaw, in radians."""
        from turtlewire.tf.arrays import euler_angles

        return euler_angles(self)

    def apply(self, points: ArrayLike) -> NDArray[Any]:
        """Return points of the source frame, shape (..., 3), in the target frame."""
        from turtlewire.tf.arrays import applied

        return applied(self, points)

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

    def _fields(self) -> tuple[str, str, Vector, Quaternion, int | None]:
        return (
            self.target_frame,
            self.source_frame,
            self.translation,
            self.rotation,
            self.stamp_ns,
        )

    def __reduce__(self) -> tuple[Any, ...]:
        from turtlewire.tf.arrays import reduced

        return reduced(self)

    def __eq__(self, other: object) -> bool:
        return self._fields() == other._fields() if isinstance(other, Transform) else NotImplemented

    # Poses are compared by value, but floats make poor keys.
    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        target, source, translation, rotation, stamp = self._fields()
        return f"Transform({target!r}, {source!r}, {translation!r}, {rotation!r}, stamp_ns={stamp})"
