"""The bags that an operation writes, one after another."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from turtlewire.bag.writer import BagWriter
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.extra_records import ExtraRecord
    from turtlewire.bag.mcap_records import RawChunk
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.output_channels import OutputChannels

__all__ = ["MOST_PIECES", "Pieces"]

MOST_PIECES = 10_000


class Pieces:
    """Writes messages into a bag, or into numbered bags below a folder.

    Args:
        folder: The bag; or the folder of the numbered bags, whose names begin with its name.
        channels: The channels of each bag.
        options: Arguments of `BagWriter`.
        numbered: Whether there may be several bags.
        max_bytes: A numbered bag ends before it exceeds this size; 0 for no limit.
        latched: Returns the messages to repeat at the beginning of a bag that starts at a time;
            None repeats nothing.
        metadata: The metadata records of each bag.

    Attributes:
        paths: The bags that were begun, relative to the folder.
        messages: Number of messages written, the repeated ones not included.
        verbatim: The channels that have the numbers of their origin; filled by the first bag.
        attachments: The attachments of the next bag that is not empty.
    """

    def __init__(
        self,
        folder: str,
        channels: OutputChannels,
        options: dict[str, Any],
        *,
        numbered: bool = False,
        max_bytes: int = 0,
        latched: Callable[[int], list[BagMessage]] | None = None,
        metadata: Sequence[ExtraRecord] = (),
    ) -> None:
        self._folder = folder
        self._channels = channels
        self._options = options
        self._numbered = numbered
        self._max_bytes = max_bytes
        self._latched = latched
        self._metadata = metadata
        self._writer: BagWriter | None = None
        self._start_ns: int | None = None
        self._is_empty = True
        self.paths: list[str] = []
        self.messages = 0
        self.verbatim: set[str] = set()
        self.attachments: list[ExtraRecord] = []

    def begin(self, start_ns: int | None) -> None:
        """End the current bag, and remove it if it is empty; its first message begins the next one.

        Args:
            start_ns: The log time of repeated messages; None uses that of the first message.
        """
        writer, self._writer = self._writer, None
        if writer is not None and self._is_empty:
            writer.abandon()
            shutil.rmtree(writer.path)
            self.paths.pop()
        elif writer is not None:
            for extra in (*self._metadata, *self.attachments):
                writer.copy_extra(extra.record)
            self.attachments.clear()
            writer.close()
        self._start_ns = start_ns

    def write(self, name: str, data: bytes, log_time_ns: int, publish_time_ns: int) -> None:
        """Write a message of one of the channels."""
        writer = self.writer(log_time_ns, len(data))
        writer.append(name, data, log_time_ns, publish_time_ns)
        self.messages += 1
        self._is_empty = False

    def copy_chunk(self, chunk: RawChunk) -> None:
        """Append a chunk of an MCAP file whose channels are `verbatim`."""
        self.writer(chunk.start_ns, len(chunk.record)).copy_chunk(chunk)
        self.messages += sum(chunk.counts.values())
        self._is_empty = False

    def may_hold(self, size: int) -> bool:
        """Return True if something of a size does not exceed the limit of a bag by itself."""
        return not self._max_bytes or size <= self._max_bytes

    def close(self) -> None:
        """Finish the last bag."""
        self.begin(None)

    def abandon(self) -> None:
        """Close the files of the current bag as they are, before they are removed."""
        if self._writer is not None:
            self._writer.abandon()

    def writer(self, time_ns: int, size: int) -> BagWriter:
        """Return the bag in which something of a time and size has room."""
        if (
            self._max_bytes
            and self._writer is not None
            and not self._is_empty
            and self._writer.size + size > self._max_bytes
        ):
            self.begin(time_ns)
        if self._writer is None:
            self._open(time_ns if self._start_ns is None else self._start_ns)
        assert self._writer is not None
        return self._writer

    def _open(self, start_ns: int) -> None:
        if len(self.paths) == MOST_PIECES:
            raise BagError(f"this makes more than {MOST_PIECES:,} bags")
        path = self._folder
        if self._numbered:
            path = os.path.join(path, f"{os.path.basename(path)}_{len(self.paths)}")
        writer = self._writer = BagWriter(path, **self._options)
        self._is_empty = True
        self.paths.append(os.path.relpath(path, os.path.dirname(self._folder)))
        for name, channel in self._channels.channels.items():
            if writer.add_channel(name, channel):
                self.verbatim.add(name)
        for message in self._latched(start_ns) if self._latched else ():
            name = self._channels.name_of_message(message)
            writer.append(name, message.data, message.log_time_ns, message.publish_time_ns)
