"""ROS's messages: times and transforms of them, and lookups that return ``TransformStamped``.

The compiled core builds the messages itself; for the plain-Python core this module does it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.call_errors import ros_time_error
from turtlewire.tf.buffer import CORE

if TYPE_CHECKING:
    import turtlewire
    from geometry_msgs.msg import TransformStamped
    from turtlewire._native import MessageLookup


def to_moment(time: Any) -> int | None:
    """Return the nanoseconds of a time of a question; time 0, the latest, is the engine's None."""
    return to_nanoseconds(time) or None


def to_nanoseconds(value: Any, what: str = "time") -> int:
    """Return the nanoseconds of a time or duration.

    Args:
        value: A builtin_interfaces message, or an rclpy ``Time`` or ``Duration``.
        what: ``time`` or ``duration``, for the error.

    Raises:
        TypeError: ``value`` is neither. Numbers are refused, because their unit is unknown.
    """
    if hasattr(value, "sec") and hasattr(value, "nanosec"):
        return int(value.sec) * 1_000_000_000 + int(value.nanosec)
    if hasattr(value, "nanoseconds"):
        return int(value.nanoseconds)
    raise ros_time_error(what, value)


class _PlainMessageLookup:
    """Lookups of a buffer with ROS times in and messages out; without a timeout they do not wait.

    It is the plain-Python twin of ``turtlewire._native.MessageLookup``.
    """

    def __init__(self, buffer: turtlewire.Buffer) -> None:
        self._buffer = buffer

    def lookup(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = None
    ) -> TransformStamped:
        return to_message(
            self._buffer.lookup_transform(
                target_frame, source_frame, to_moment(time), timeout_ns=_timeout(timeout)
            )
        )

    def lookup_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> TransformStamped:
        found = self._buffer.lookup_transform(
            target_frame,
            source_frame,
            to_moment(source_time),
            fixed_frame=fixed_frame,
            target_stamp_ns=to_moment(target_time),
            timeout_ns=_timeout(timeout),
        )
        return to_message(found)


def _timeout(timeout: Any) -> int:
    return 0 if timeout is None else to_nanoseconds(timeout, "duration")


def to_message(transform: turtlewire.Transform) -> TransformStamped:
    """Return a transform of the engine as ROS message."""
    from geometry_msgs.msg import TransformStamped

    message = TransformStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(
        transform.stamp_ns or 0, 1_000_000_000
    )
    message.header.frame_id = transform.target_frame
    message.child_frame_id = transform.source_frame
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = transform.translation
    rotation.x, rotation.y, rotation.z, rotation.w = transform.rotation
    return message


def message_lookup(buffer: turtlewire.Buffer) -> MessageLookup | _PlainMessageLookup:
    """Return the message lookup that fits the core in use."""
    if CORE == "python":
        return _PlainMessageLookup(buffer)
    from geometry_msgs.msg import TransformStamped
    from turtlewire import _native

    return _native.MessageLookup(buffer, TransformStamped())
