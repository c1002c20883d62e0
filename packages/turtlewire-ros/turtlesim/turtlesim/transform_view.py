"""TF for the page: all frames, and the transform between two. Listens while a page watches."""

from __future__ import annotations

import math
import re
import threading
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire import Buffer
from turtlewire.errors import TransformException
from turtlewire.tf.listener import TransformListener

if TYPE_CHECKING:
    from turtlewire.wire import base

#: How many frames are drawn on the field.
MOST_AXES = 40
#: Hidden in `ros2 node list`, as names that begin with an underscore are.
_NODE_NAME = "_turtlesim_page"
_FRAME = re.compile(
    r"^(?P<name>.*): ?\n  parent: '(?P<parent>.*)'\n  broadcaster: '.*'\n  rate: (?P<rate>.*)\n"
    r"  most_recent_transform: (?P<newest>.*)\n  oldest_transform: .*\n"
    r"  buffer_length: (?P<length>.*)$",
    re.MULTILINE,
)


class Frame(NamedTuple):
    """A frame and the link to its parent.

    Attributes:
        name: The frame.
        parent: Its parent.
        rate: Transforms per second, 0 while there is only one; None for a static link.
        age: How old the newest transform is [s]; None for a static link.
    """

    name: str
    parent: str
    rate: float | None
    age: float | None


class TransformView:
    """A buffer that is filled while a page watches. Thread-safe.

    Args:
        context: The participant whose ``/tf`` and ``/tf_static`` are subscribed to.
        namespace: Namespace of the hidden node that subscribes.
        now_ns: The simulator's clock, which stamps are compared with.
    """

    def __init__(self, context: base.Context, namespace: str, now_ns: Callable[[], int]) -> None:
        self._context = context
        self._namespace = namespace
        self._now_ns = now_ns
        self._lock = threading.Lock()
        self._lookers = 0
        self._buffer = Buffer()
        self._node: base.Node | None = None
        self._listener: TransformListener | None = None

    def join(self) -> None:
        """A page watches; the first one starts the listener."""
        with self._lock:
            self._lookers += 1
            if self._listener is None:
                self._buffer = Buffer()
                self._node = self._context.create_node(_NODE_NAME, self._namespace)
                self._listener = TransformListener(self._buffer, self._node, context=self._context)

    def leave(self) -> None:
        """A page watches no longer; the last one ends the listener."""
        with self._lock:
            self._lookers -= 1
            if self._lookers == 0:
                self._stop()

    def close(self) -> None:
        """End the listener, even while pages watch."""
        with self._lock:
            self._stop()

    def frames(self) -> list[Frame]:
        """Return all frames that have a parent, sorted by name."""
        now_s = self._now_ns() / 1e9
        return sorted(
            _read_frame(match, now_s) for match in _FRAME.finditer(self._buffer.to_yaml())
        )

    def relation(self, target: str, source: str) -> dict[str, Any]:
        """Translation [m] and rotation (xyzw) of ``source`` in ``target``, or tf2's error.

        Numbers that are not finite, which tf2 accepts, are None.
        """
        try:
            target_from_source = self._buffer.lookup_transform(target, source)
        except TransformException as error:
            return {"error": str(error), "hint": error.hint}
        parts = {
            "translation": target_from_source.translation,
            "rotation": target_from_source.rotation,
        }
        return {
            name: [value if math.isfinite(value) else None for value in values]
            for name, values in parts.items()
        }

    def axes(self, field: str, names: Sequence[str]) -> dict[str, list[float]]:
        """Return the frames' axes in the field now, seen from above.

        Args:
            field: The frame of the field.
            names: The frames; frames without a finite place in ``field`` are left out.

        Returns:
            Name to x and y [m] and the directions of the x axis and the y axis, two numbers each.
        """
        found = {}
        for name in names:
            try:
                field_from_frame = self._buffer.lookup_transform(field, name)
            except TransformException:  # the frame now belongs to another tree
                continue
            place = _seen_from_above(*field_from_frame.translation, *field_from_frame.rotation)
            if all(map(math.isfinite, place)):
                found[name] = place
        return found

    def _stop(self) -> None:
        if self._listener is not None and self._node is not None:
            self._listener.close()
            self._node.close()
            self._listener = self._node = None


def field_frames(frames: Sequence[Frame], turtles: Sequence[str]) -> tuple[str, list[str]]:
    """Return the frame in which turtles are where the field shows them, and all frames of its tree.

    That is ``world``, or without it the root of the tree of the first turtle that has a frame; an
    empty name without either. No more than :data:`MOST_AXES` frames are drawn.
    """
    parents = {frame.name: frame.parent for frame in frames}
    known = {*parents, *parents.values()}
    field = next((name for name in ("world", *turtles) if name in known), "")
    root = _root(field, parents)
    names = sorted(name for name in known if _root(name, parents) == root)
    return ("world" if field == "world" else root), names[:MOST_AXES]


def _root(name: str, parents: dict[str, str]) -> str:
    for _ in parents:  # no longer, should parents ever form a loop
        name = parents.get(name, name)
    return name


def _seen_from_above(
    x: float, y: float, z: float, qx: float, qy: float, qz: float, qw: float
) -> list[float]:
    """Place and the first two columns of the rotation's matrix, without what points upwards."""
    del z
    return [
        x,
        y,
        1.0 - 2.0 * (qy * qy + qz * qz),
        2.0 * (qx * qy + qw * qz),
        2.0 * (qx * qy - qw * qz),
        1.0 - 2.0 * (qx * qx + qz * qz),
    ]


def _read_frame(match: re.Match[str], now_s: float) -> Frame:
    newest, has_one = float(match["newest"]), float(match["length"]) == 0.0
    if has_one and newest == 0.0:  # tf2 gives static links no stamp
        return Frame(match["name"], match["parent"], None, None)
    rate = 0.0 if has_one else float(match["rate"])
    return Frame(match["name"], match["parent"], rate, now_s - newest)
