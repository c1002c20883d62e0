"""Puts the messages of chunks in order of their log time."""

from __future__ import annotations

from bisect import bisect_left
from operator import itemgetter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from turtlewire.bag.mcap_records import ChunkIndex
    from turtlewire.bag.record_messages import RawMessage

__all__ = ["in_order"]

_FOREVER = 1 << 64

_log_time = itemgetter(0)


def in_order(
    chunks: Iterable[ChunkIndex], load: Callable[[ChunkIndex], list[RawMessage]]
) -> Iterator[list[RawMessage]]:
    """Yield messages in order of time, at equal times in the order of the file.

    Only chunks whose times overlap are in memory together.

    Args:
        chunks: In order of their first log time.
        load: Returns the messages of a chunk.
    """
    waiting: dict[int, list[RawMessage]] = {}
    for chunk in chunks:
        yield _taken_before(chunk.start_ns, waiting)
        found = load(chunk)
        found.sort(key=_log_time)
        waiting[chunk.offset] = found
    yield _taken_before(_FOREVER, waiting)


def _taken_before(time_ns: int, waiting: dict[int, list[RawMessage]]) -> list[RawMessage]:
    """Remove messages of earlier log times from the waiting ones, and return them in order.

    Args:
        time_ns: The log time that is not taken any more.
        waiting: The messages of each chunk, in order of time, by the chunk's offset.
    """
    taken: list[RawMessage] = []
    for offset in sorted(waiting):
        messages = waiting[offset]
        count = bisect_left(messages, time_ns, key=_log_time)
        if count < len(messages):
            taken += messages[:count]
            del messages[:count]
        else:
            taken = taken + messages if taken else messages
            del waiting[offset]
    taken.sort(key=_log_time)
    return taken
