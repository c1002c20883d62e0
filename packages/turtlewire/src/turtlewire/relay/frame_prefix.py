"""Adds a prefix to the frames of transforms in one direction, and removes it in the other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import CdrError
from turtlewire.tf.listener import TYPE_NAME
from turtlewire.wire.report import warn_once

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["FramePrefix"]


class FramePrefix:
    """Renames the frames of ``tf2_msgs/msg/TFMessage``.

    Args:
        prefix: The prefix, such as ``robot1/``.
    """

    def __init__(self, prefix: str) -> None:
        self._prefix = prefix

    def add(self, cdr: bytes) -> bytes | None:
        """Put the prefix in front of all frames."""
        return _renamed(cdr, lambda frame: self._prefix + frame.lstrip("/"))

    def remove(self, cdr: bytes) -> bytes | None:
        """Take the prefix away; transforms between other frames are left out.

        None if no transform is left.
        """

        def without(frame: str) -> str | None:
            inside = frame.startswith(self._prefix)
            return frame[len(self._prefix) :] if inside else None

        return _renamed(cdr, without)


def _renamed(cdr: bytes, rename: Callable[[str], str | None]) -> bytes | None:
    """Rename the frames of a message; transforms with a frame that gets no name are left out."""
    try:
        message: Any = msg.deserialize(msg.get_message(TYPE_NAME), cdr)
    except CdrError as error:
        warn_once("relay TFMessage", f"a message of transforms was not carried: {error}")
        return None
    kept = []
    for transform in message.transforms:
        parent, child = rename(transform.header.frame_id), rename(transform.child_frame_id)
        if parent is not None and child is not None:
            transform.header.frame_id, transform.child_frame_id = parent, child
            kept.append(transform)
    message.transforms = kept
    return msg.serialize(message) if kept else None
