"""The reference of the poses that a page gets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.errors import TransformException

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire.tf.buffer import Buffer
    from turtlewire_view.displays.content import Content

__all__ = ["Base"]


class Base:
    """The reference of poses: a frame, the origin subtracted from its coordinates, and a buffer.

    With ``own_frames``, each message is shown in its own frame, because there are no transforms.
    """

    __slots__ = ("buffer", "fixed", "origin", "own_frames")

    def __init__(
        self,
        buffer: Buffer,
        fixed: str,
        origin: tuple[float, float, float],
        *,
        own_frames: bool = False,
    ) -> None:
        self.buffer = buffer
        self.fixed = fixed
        self.origin = origin
        self.own_frames = own_frames

    def same_place(self, other: Base) -> bool:
        """Return True if poses in both are equal."""
        return (self.fixed, self.origin, self.own_frames) == (
            other.fixed,
            other.origin,
            other.own_frames,
        )

    def arrays(self, content: Content) -> dict[str, NDArray[Any]]:
        """Return the arrays of a content, with those that depend on where it is.

        Raises:
            TransformException: A transform that they need is not known.
        """
        if content.placed is None or content.frame_id is None:
            return content.arrays
        stamps = np.array([content.stamp_ns], dtype=np.int64)
        if content.placed.stamps_ns is not None:
            stamps = np.concatenate([stamps, content.placed.stamps_ns])
        if self.own_frames:
            matrices = np.tile(np.eye(4), (len(stamps), 1, 1))
            return {**content.arrays, **content.placed.arrays(matrices)}
        if not stamps.all():  # a message with the stamp 0 is drawn at the latest time
            newest = self.buffer.lookup_transform(self.fixed, content.frame_id).stamp_ns
            stamps = np.where(stamps == 0, newest or 0, stamps)
        matrices = self.buffer.lookup_transforms(
            self.fixed, content.frame_id, stamps, matrices=True
        )
        if not np.isfinite(matrices).all():
            raise TransformException(f"A pose of {content.frame_id!r} is not finite.")
        return {**content.arrays, **content.placed.arrays(matrices)}

    def pose(self, content: Content) -> list[float]:
        """Return the pose of a content's anchor: x, y, z, and the quaternion xyzw.

        Raises:
            TransformException: The pose is unknown.
        """
        assert content.frame_id is not None
        if self.own_frames:
            return [*np.subtract(content.anchor, self.origin).tolist(), 0.0, 0.0, 0.0, 1.0]
        fixed_from_frame = self.buffer.lookup_transform(
            self.fixed, content.frame_id, content.stamp_ns or None
        )
        matrix = fixed_from_frame.as_matrix()
        place = matrix[:3, :3] @ np.asarray(content.anchor) + matrix[:3, 3] - self.origin
        pose = [*place.tolist(), *fixed_from_frame.rotation]
        if not np.isfinite(pose).all():
            raise TransformException(f"The pose of {content.frame_id!r} is not finite.")
        return pose
