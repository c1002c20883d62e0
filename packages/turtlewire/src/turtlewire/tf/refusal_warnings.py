"""Warnings about transforms that the buffers of a topic refuse."""

from __future__ import annotations

import time
from weakref import WeakKeyDictionary

from turtlewire.tf.buffer import Buffer
from turtlewire.tf.faults import refusals
from turtlewire.wire.report import warn, warn_once

__all__ = ["RefusalWarnings"]

#: Seconds between two warnings about a full buffer.
_PERIOD_S = 60.0
#: Seconds between two counts of the rejected transforms: counting is slow.
_LOOK_PERIOD_S = 1.0
_NO_ROOM = "too_many_frames"


class RefusalWarnings:
    """Warns of each refused frame once for each reason, and of full buffers at most once a minute.

    Args:
        topic: The topic that fills the buffers.
    """

    def __init__(self, topic: str) -> None:
        self._topic = topic
        self._next_look_s = 0.0
        self._without_room: WeakKeyDictionary[Buffer, int] = WeakKeyDictionary()
        self._kinds: WeakKeyDictionary[Buffer, int] = WeakKeyDictionary()

    def look(self, store: object) -> None:
        """Warn of what a buffer has refused since the last look."""
        if not isinstance(store, Buffer):
            return
        kinds = store._refusal_kinds()
        if kinds and kinds != self._kinds.get(store, 0):
            self._kinds[store] = kinds
            _warn_of_reasons(store)
        if store.is_full:
            self._look_for_room(store)

    def _look_for_room(self, store: Buffer) -> None:
        now_s = time.monotonic()
        if now_s < self._next_look_s:
            return
        self._next_look_s = now_s + _LOOK_PERIOD_S
        refused = sum(each.counts.get(_NO_ROOM, 0) for each in refusals(store).values())
        if refused == self._without_room.get(store, 0):
            return
        self._without_room[store] = refused
        self._next_look_s = now_s + _PERIOD_S
        warn(
            f"a buffer that {self._topic} fills has max_frames={store.max_frames} frames and "
            f"ignores further ones; `ros2 topic info -v {self._topic}` shows who publishes"
        )


def _warn_of_reasons(store: Buffer) -> None:
    for frame, refused in refusals(store).items():
        reasons = sorted(refused.counts.keys() - {_NO_ROOM})
        if reasons:
            warn_once(f"refused {frame}: {reasons}", refused.last.replace("\n", " "))
