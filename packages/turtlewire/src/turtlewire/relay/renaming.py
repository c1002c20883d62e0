"""Converts names and frames of transforms between the two ends of a relay."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import CdrError
from turtlewire.tf.listener import STATIC_TOPIC, TOPIC, TYPE_NAME
from turtlewire.wire.report import warn_once

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["FramePrefix", "Renaming"]


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


_TRANSFORMS = {TOPIC, STATIC_TOPIC}


class Renaming:
    """Puts names into a namespace on the way there, and takes them out on the way back.

    Args:
        namespace: The namespace at the far end, such as ``/robot1``; empty keeps all names.
        shares_transforms: Whether ``/tf`` and ``/tf_static`` keep their names, because a prefix
            tells the frames of robots apart.
        same_network: Whether both ends are the same network, so that names in the namespace are
            there already.
    """

    def __init__(self, namespace: str, *, shares_transforms: bool, same_network: bool) -> None:
        self._prefix = namespace.rstrip("/")
        self._shared = _TRANSFORMS if shares_transforms else set()
        self._same_network = same_network

    def there(self, name: str) -> str | None:
        """Return the name at the far end; None if it is not carried."""
        if name in self._shared:
            return name
        if self._same_network and name.startswith(f"{self._prefix}/"):
            return None
        return self._prefix + name

    def back(self, name: str) -> str | None:
        """Return the name at the near end; None if it is not carried."""
        if name in self._shared:
            return name
        if not name.startswith(f"{self._prefix}/"):
            return None
        near = name[len(self._prefix) :]
        return None if near in self._shared else near

    def node_there(self, full_name: str) -> str:
        """Return the name that a node of the near end has at the far end."""
        return self._prefix + full_name

    def node_back(self, full_name: str) -> str:
        """Return the name that a node of the far end has at the near end."""
        inside = full_name.startswith(f"{self._prefix}/")
        return full_name[len(self._prefix) :] if inside else full_name
