"""Warnings about buffers that are full."""

from __future__ import annotations

import time
from weakref import WeakKeyDictionary

from turtlewire.tf.buffer import Buffer
from turtlewire.tf.faults import refusals
from turtlewire.wire.report import warn

__all__ = ["FullBuffers"]

#: Seconds between two warnings about a topic.
_PERIOD_S = 60.0
#: Seconds between two counts of the rejected transforms: counting is slow.
_LOOK_PERIOD_S = 1.0


class FullBuffers:
    """Warns about buffers that reject frames, at most once a minute.

    Args:
        topic: The topic that fills them.
    """

    def __init__(self, topic: str) -> None:
        self._topic = topic
        self._next_look_s = 0.0
        self._refused: WeakKeyDictionary[Buffer, int] = WeakKeyDictionary()

    def look(self, store: object) -> None:
        """Warn if a buffer has rejected frames since the last warning."""
        now_s = time.monotonic()
        if not isinstance(store, Buffer) or not store.is_full or now_s < self._next_look_s:
            return
        self._next_look_s = now_s + _LOOK_PERIOD_S
        refused = sum(each.counts.get("too_many_frames", 0) for each in refusals(store).values())
        if refused == self._refused.get(store, 0):
            return
        self._refused[store] = refused
        self._next_look_s = now_s + _PERIOD_S
        warn(
            f"a buffer that {self._topic} fills has max_frames={store.max_frames} frames and "
            f"ignores further ones; `ros2 topic info -v {self._topic}` shows who publishes"
        )
