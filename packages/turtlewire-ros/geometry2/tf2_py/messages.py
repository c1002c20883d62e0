"""Lookups that return ``TransformStamped`` messages.

The compiled core builds the messages itself; for the plain-Python core this module does it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from tf2_py.times import to_moment, to_nanoseconds
from turtlewire.tf.buffer import CORE

if TYPE_CHECKING:
    import turtlewire
    from geometry_msgs.msg import TransformStamped


class MessageLookup(Protocol):
    """Lookups of a buffer with ROS times in and messages out."""

    def lookup(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = None
    ) -> TransformStamped:
        """As ``turtlewire.Buffer.lookup_transform``; without a timeout it does not wait."""
        ...

    def lookup_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> TransformStamped:
        """As `lookup`, by way of a frame that does not move."""
        ...


class _PlainMessageLookup:
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


def message_lookup(buffer: turtlewire.Buffer) -> MessageLookup:
    """Return the message lookup that fits the core in use."""
    if CORE == "python":
        return _PlainMessageLookup(buffer)
    from geometry_msgs.msg import TransformStamped
    from turtlewire import _native

    return _native.MessageLookup(buffer, TransformStamped())
