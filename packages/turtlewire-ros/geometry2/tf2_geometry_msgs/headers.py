"""The headers of results."""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time
from std_msgs.msg import Header

__all__ = ["copy_of", "header_of"]


def header_of(transform: Any) -> Header:
    """Return a new header with frame and stamp of a ``TransformStamped``.

    The data is now in that frame, and of that time.
    """
    try:
        header = transform.header
    except AttributeError:
        raise TypeError(
            "stamped data needs a geometry_msgs.msg.TransformStamped, whose header says in which "
            "frame the result is; "
            f"got {type(transform).__name__}"
        ) from None
    return copy_of(header.stamp, header.frame_id)


def copy_of(stamp: Any, frame_id: str) -> Header:
    """Return a header with the values of a stamp."""
    return Header(stamp=Time(sec=stamp.sec, nanosec=stamp.nanosec), frame_id=frame_id)
