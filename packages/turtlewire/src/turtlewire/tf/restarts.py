"""Detects jumps back in time: a simulation or a bag has restarted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.tf.faults import refusals

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer

__all__ = ["RestartWatch"]


class RestartWatch:
    """Clears a buffer of which a link gets only samples that are too old for it.

    Args:
        buffer: What to look at. Clearing it keeps static transforms.
    """

    def __init__(self, buffer: Buffer) -> None:
        self._buffer = buffer
        self._before: dict[str, tuple[int, int]] = {}

    def look(self) -> bool:
        """Compare with the last look; whether the buffer was cleared."""
        newest = {link.child_frame: link.newest_ns for link in self._buffer.links()}
        refused = {
            frame: each.counts.get("old_data", 0) for frame, each in refusals(self._buffer).items()
        }
        before, now = self._before, {f: (refused.get(f, 0), stamp) for f, stamp in newest.items()}
        self._before = now
        restarted = any(
            now[frame][0] > before[frame][0] and now[frame][1] == before[frame][1]
            for frame in now.keys() & before.keys()
        )
        if restarted:
            self._buffer.clear()
        return restarted
