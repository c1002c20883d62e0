"""Copies the messages of bags into new bags: message by message, or MCAP chunks as bytes."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.bag.mcap_records import OPCODE_AND_LENGTH, ChunkIndex, Op
from turtlewire.bag.mcap_storage import McapStorage
from turtlewire.bag.storage import messages_of_blocks, one_ahead
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.frame_renaming import FrameRenaming
    from turtlewire.bag.mcap_records import RawChunk
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.metadata import TopicInfo
    from turtlewire.bag.output_channels import OutputChannels
    from turtlewire.bag.pieces import Pieces
    from turtlewire.bag.reader import Bag

__all__ = ["ChunkCopy", "MessageCopy", "can_copy_chunks"]

_MESSAGES_A_REPORT = 1000


class MessageCopy:
    """Copies messages one by one, in order of their log time over all bags.

    Args:
        bags: The bags to read.
        takes: Returns True for topics that are wanted.
        channels: The channels of the new bags.
        frames: Renames frames; None leaves all messages as they are.
        damaged: Called for each part that cannot be read.
    """

    def __init__(
        self,
        bags: Sequence[Bag],
        takes: Callable[[TopicInfo], bool],
        channels: OutputChannels,
        frames: FrameRenaming | None,
        damaged: Callable[[BagError], None],
    ) -> None:
        self._bags = bags
        self._takes = takes
        self._channels = channels
        self._frames = frames
        self._damaged = damaged

    def copy(
        self, pieces: Pieces, start_ns: int, end_ns: int, tell: Callable[[float], None]
    ) -> None:
        """Copy the messages from a log time on and before another.

        Args:
            pieces: Takes them.
            start_ns: The first log time.
            end_ns: The log time at which copying ends, not included.
            tell: Called with the share that is done.
        """
        streams = [self._messages(bag, start_ns, end_ns) for bag in self._bags]
        first = max(start_ns, min(bag.start_ns for bag in self._bags))
        last = min(end_ns, max(bag.end_ns for bag in self._bags))
        for number, message in enumerate(heapq.merge(*streams, key=attrgetter("log_time_ns"))):
            data = message.data if self._frames is None else self._frames.apply(message)
            name = self._channels.name_of_message(message)
            pieces.write(name, data, message.log_time_ns, message.publish_time_ns)
            if number % _MESSAGES_A_REPORT == 0:
                tell((message.log_time_ns - first) / max(1, last - first))

    def _messages(self, bag: Bag, start_ns: int, end_ns: int) -> Iterator[BagMessage]:
        topics = [topic.name for topic in bag.metadata.topics if self._takes(topic)]
        try:
            yield from bag.messages(topics, start_ns=start_ns, end_ns=end_ns - 1)
        except BagError as error:
            for each in (error, *error.others):
                self._damaged(each)


class _FileChunk(NamedTuple):
    """A chunk of one of the files.

    Attributes:
        chunk: Where it is.
        file: The number of its file.
        is_contested: Whether chunks of other files have messages of the same times.
    """

    chunk: ChunkIndex
    file: int
    is_contested: bool


class ChunkCopy:
    """Copies MCAP files chunk by chunk; those that lie wholly in the selection as bytes.

    Args:
        bags: The bags to read, for which `can_copy_chunks` is True.
        takes: Returns True for topics that are wanted.
        channels: The channels of the new bags.
        compression: The compression of chunks that are copied as bytes; None for any.
        damaged: Called for each part that cannot be read.
    """

    def __init__(
        self,
        bags: Sequence[Bag],
        takes: Callable[[TopicInfo], bool],
        channels: OutputChannels,
        compression: str | None,
        damaged: Callable[[BagError], None],
    ) -> None:
        self._takes = takes
        self._channels = channels
        self._compression = compression
        self._damaged = damaged
        damage: list[BagError] = []
        self._files = [
            file
            for bag in bags
            for file in bag.readable_files(bag.metadata.paths, damage)
            if isinstance(file, McapStorage)
        ]
        for error in damage:
            damaged(error)
        #: Name of the channel in the new bag by the channel's number, for each file.
        self._names = [
            {each: channels.name_of(file.channel(each)) for each in file.wanted_channels(takes)}
            for file in self._files
        ]

    def copy(
        self, pieces: Pieces, start_ns: int, end_ns: int, tell: Callable[[float], None]
    ) -> None:
        """Copy messages; see `MessageCopy.copy`."""
        last = end_ns - 1
        found = [file.chunks(self._takes, start_ns, last) for file in self._files]
        total = sum(chunk.length for chunks in found for chunk in chunks) or 1
        done = 0
        contested: list[_FileChunk] = []

        def check(each: _FileChunk) -> RawChunk | None:
            return None if each.is_contested else self._whole(each, start_ns, last)

        for each, whole in one_ahead(_in_turn(found), check):
            if contested and not each.is_contested:
                self._merge(contested, pieces, start_ns, last)
                contested = []
            if each.is_contested:
                contested.append(each)
            else:
                self._copy_chunk(each, whole, pieces, start_ns, last)
            done += each.chunk.length
            tell(done / total)
        self._merge(contested, pieces, start_ns, last)

    def _whole(self, each: _FileChunk, start_ns: int, last_ns: int) -> RawChunk | None:
        """Return a chunk that can be copied as bytes as far as its own content decides.

        This runs on another thread, because the checksum of a plain chunk takes as long as copying.
        """
        chunk, names = each.chunk, self._names[each.file]
        if not start_ns <= chunk.start_ns <= chunk.end_ns <= last_ns:
            return None
        if chunk.channels is None or not chunk.channels <= names.keys():
            return None
        raw = self._files[each.file].file.raw_chunk(chunk)
        if raw is None or self._compression not in (None, raw.compression) or raw.is_damaged():
            return None
        has_others = len(names) < len(self._files[each.file].file.channels)
        return None if has_others and self._defines_others(each) else raw

    def _copy_chunk(
        self,
        each: _FileChunk,
        whole: RawChunk | None,
        pieces: Pieces,
        start_ns: int,
        last_ns: int,
    ) -> None:
        """Copy a chunk as bytes if that is possible, else its messages in the order of the file."""
        names = self._names[each.file]
        try:
            if (
                whole is not None
                and pieces.may_hold(len(whole.record))
                and self._has_same_numbers(each, pieces)
            ):
                pieces.copy_chunk(whole)
                return
            for log_time, number, publish_time, data in self._readable(each):
                if start_ns <= log_time <= last_ns:
                    pieces.write(names[number], data, log_time, publish_time)
        finally:
            self._files[each.file].file.forget(each.chunk)

    def _readable(self, each: _FileChunk) -> Iterator[tuple[int, int, int, bytes]]:
        """Yield the messages of a chunk before its damage; only reading it counts as damage."""
        try:
            yield from self._files[each.file].file.messages(each.chunk, self._names[each.file])
        except BagError as error:
            self._damaged(error)

    def _has_same_numbers(self, each: _FileChunk, pieces: Pieces) -> bool:
        """Return True if the channels and schemas of a file have the same numbers in the output."""
        file = self._files[each.file]
        pieces.writer(each.chunk.start_ns, 0)  # fills `verbatim`
        return all(
            name in pieces.verbatim and self._channels.is_same(file.channel(number))
            for number, name in self._names[each.file].items()
        )

    def _defines_others(self, each: _FileChunk) -> bool:
        """Return True if a chunk has the definition of a topic that is not wanted."""
        file, names = self._files[each.file].file, self._names[each.file]
        try:
            records = file.records(each.chunk)
            position = 0
            while position < len(records):
                opcode, length = OPCODE_AND_LENGTH.unpack_from(records, position)
                position += OPCODE_AND_LENGTH.size
                number = int.from_bytes(records[position : position + 2], "little")
                if opcode == Op.CHANNEL and number not in names:
                    return True
                position += length
        except (BagError, ValueError):
            return True
        return False

    def _merge(
        self, contested: list[_FileChunk], pieces: Pieces, start_ns: int, last_ns: int
    ) -> None:
        """Copy the messages of chunks of several files in order of their log time."""
        streams = []
        for number in sorted({each.file for each in contested}):
            chunks = [each.chunk for each in contested if each.file == number]
            chunks.sort(key=_start)
            streams.append(self._messages(number, chunks, start_ns, last_ns))
        for message in heapq.merge(*streams, key=attrgetter("log_time_ns")):
            name = self._channels.name_of_message(message)
            pieces.write(name, message.data, message.log_time_ns, message.publish_time_ns)

    def _messages(
        self, number: int, chunks: list[ChunkIndex], start_ns: int, last_ns: int
    ) -> Iterator[BagMessage]:
        file = self._files[number]
        blocks = file.blocks_of(chunks, self._names[number], start_ns, last_ns, self._damaged)
        return messages_of_blocks(file, blocks)


def can_copy_chunks(bags: Sequence[Bag]) -> bool:
    """Return True if all files of bags are MCAP files with the bytes of ROS 2's messages."""
    return all(
        isinstance(file, McapStorage) and not file.converts
        for bag in bags
        for file in bag.readable_files(bag.metadata.paths, [])
    ) and all(bag.metadata.compression_mode != "MESSAGE" for bag in bags)


def _in_turn(files: list[list[ChunkIndex]]) -> Iterator[_FileChunk]:
    """Yield the chunks of files by their first log time, the chunks of one file in its order."""
    ordered = sorted(
        ((chunk, number) for number, chunks in enumerate(files) for chunk in chunks),
        key=lambda pair: pair[0].start_ns,
    )
    contested = _contested(ordered)
    queues = [
        [
            _FileChunk(chunk, number, chunk.offset in contested[number])
            for chunk in sorted(chunks, key=lambda chunk: chunk.offset)
        ]
        for number, chunks in enumerate(files)
    ]
    return heapq.merge(*queues, key=lambda each: each.chunk.start_ns)


def _contested(ordered: list[tuple[ChunkIndex, int]]) -> dict[int, set[int]]:
    """Return the offsets of each file's chunks whose times overlap with chunks of other files."""
    files = {number for _, number in ordered}
    found: dict[int, set[int]] = {number: set() for number in files}
    ends: dict[int, int] = {}
    for chunk, number in ordered:  # with one that starts before
        if any(end >= chunk.start_ns for other, end in ends.items() if other != number):
            found[number].add(chunk.offset)
        ends[number] = max(ends.get(number, 0), chunk.end_ns)
    starts: dict[int, int] = {}
    for chunk, number in reversed(ordered):  # with one that starts after
        if any(start <= chunk.end_ns for other, start in starts.items() if other != number):
            found[number].add(chunk.offset)
        starts[number] = chunk.start_ns
    return found


def _start(chunk: ChunkIndex) -> int:
    return chunk.start_ns
