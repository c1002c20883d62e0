"""Shows a ``TransformStamped`` in a notebook as numbers and a small picture."""

from __future__ import annotations

from typing import NamedTuple

from geometry_msgs.msg import TransformStamped


class _Pose(NamedTuple):
    target_frame: str
    source_frame: str
    stamp_ns: int | None
    translation: tuple[float, float, float]
    rotation: tuple[float, float, float, float]


def transform_html(message: TransformStamped) -> str | None:
    """Return the numbers of a transform and the axes of its two frames.

    None, which makes a notebook show plain text, if the rotation is not set.
    """
    from turtlewire.tf import notebook

    t, q, stamp = message.transform.translation, message.transform.rotation, message.header.stamp
    if not any((q.x, q.y, q.z, q.w)):
        return None
    stamp_ns = stamp.sec * 1_000_000_000 + stamp.nanosec
    return notebook.transform_html(
        _Pose(
            message.header.frame_id,
            message.child_frame_id,
            stamp_ns or None,  # 0 means a static link
            (t.x, t.y, t.z),
            (q.x, q.y, q.z, q.w),
        )
    )


TransformStamped._repr_html_ = transform_html  # type: ignore[attr-defined]
