"""Counts, sizes and times of the messages of each topic of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.bag.mcap_records import RawChunk

__all__ = ["Extent", "add_extent", "extents_of_chunk", "extents_of_messages"]

#: Opcode, length and fields of a message before its bytes.
_MESSAGE_HEAD = 31
#: Opcode, length, channel and size of a MessageIndex record before its entries.
_INDEX_HEAD = 15


class Extent(NamedTuple):
    """The messages of a topic.

    Attributes:
        messages: Number of messages.
        data_bytes: Their bytes before compression.
        first_ns: Log time of the first message.
        last_ns: Log time of the last message.
    """

    messages: int
    data_bytes: int
    first_ns: int
    last_ns: int


def add_extent(extents: dict[str, Extent], topic: str, extent: Extent) -> None:
    """Add messages to the extent of a topic."""
    known = extents.get(topic)
    if known is not None:
        extent = Extent(
            known.messages + extent.messages,
            known.data_bytes + extent.data_bytes,
            min(known.first_ns, extent.first_ns),
            max(known.last_ns, extent.last_ns),
        )
    extents[topic] = extent


def extents_of_messages(messages: Iterable[tuple[str, int, int]]) -> dict[str, Extent]:
    """Return the extent of each topic from topics, log times and sizes of messages."""
    extents: dict[str, Extent] = {}
    for topic, time_ns, size in messages:
        add_extent(extents, topic, Extent(1, size, time_ns, time_ns))
    return extents


def extents_of_chunk(chunk: RawChunk) -> dict[int, Extent]:
    """Return the extent of each channel of an MCAP chunk, which is not decompressed.

    A message ends where the next record begins; definitions between messages count with them.
    """
    import numpy as np

    entries = {
        channel: np.frombuffer(
            chunk.indexes, "<u8", 2 * chunk.counts[channel], position + _INDEX_HEAD
        ).reshape(-1, 2)
        for channel, position in chunk.index_offsets.items()
    }
    if not entries:
        return {}
    begins = np.concatenate([each[:, 1] for each in entries.values()])
    order = np.argsort(begins, kind="stable")
    ends = np.append(begins[order][1:], np.uint64(chunk.plain_bytes))
    sizes = np.empty(len(begins), np.int64)
    sizes[order] = (ends - begins[order]).astype(np.int64) - _MESSAGE_HEAD
    extents, at = {}, 0
    for channel, rows in entries.items():
        own = sizes[at : at + len(rows)]
        at += len(rows)
        times = rows[:, 0]
        extents[channel] = Extent(
            len(rows), int(own.clip(0).sum()), int(times.min()), int(times.max())
        )
    return extents
