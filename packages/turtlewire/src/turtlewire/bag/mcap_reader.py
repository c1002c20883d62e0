"""Reads one MCAP file: its definitions, its blocks of records, and the messages in them.

A file that was closed ends with a summary that says where each chunk lies. A file whose writer was
killed, or that was written without an index, is walked from the start; all intact messages are
read.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Container, Iterator
from typing import TYPE_CHECKING

from turtlewire.bag.mapped_files import forget_pages, map_file
from turtlewire.bag.mcap_chunks import chunk_records, raw_chunk
from turtlewire.bag.mcap_records import (
    MAGIC,
    OPCODE_AND_LENGTH,
    Channel,
    ChunkIndex,
    McapStatistics,
    Op,
    RawChunk,
    RecordReader,
    Schema,
)
from turtlewire.bag.record_messages import mcap_messages
from turtlewire.errors import BagError
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.bag.record_messages import RawMessage

__all__ = ["McapFile"]

_MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
_PREFIX = OPCODE_AND_LENGTH.size
_FOOTER_SIZE = OPCODE_AND_LENGTH.size + 20
_NO_TIME = (1 << 64) - 1
_CHUNK_FIELDS = 8 + 8 + 8 + 4  # times, size and checksum, before the compression
_CHUNK = bytes([Op.CHUNK])


class McapFile:
    """An open MCAP file.

    Attributes:
        path: Where it is; of a decompressed copy, the compressed file.
        channels: Its channels by id.
        schemas: Its schemas by id.
        metadata: Contents of its Metadata records by name; of several with one name, the last.
        statistics: Counts and times of the whole file.
        chunks: Its chunks and runs of bare records, in the order of the file.
        extra_positions: Where its Attachment and Metadata records begin, as far as its index lists
            them.
        closed_properly: Whether the file ends with its summary.
        problems: What is damaged, one sentence each with the position; filled while reading.

    Raises:
        BagError: The file is not an MCAP file.
        OSError: The file cannot be opened.
    """

    def __init__(self, path: str, name: str = "") -> None:
        self.path = name or path
        self.channels: dict[int, Channel] = {}
        self.schemas: dict[int, Schema] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.statistics = McapStatistics(0, 0, 0, {})
        self._has_statistics = False
        self.chunks: list[ChunkIndex] = []
        self.extra_positions: set[int] = set()
        self.problems: list[str] = []
        self._intact: set[int] = set()
        self._map, self._bytes = map_file(path, MAGIC, "an MCAP file")
        try:
            self.closed_properly = self._read_summary()
            if not self.closed_properly or not self._summary_is_complete():
                self._walk_file()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Release the file; the bytes of its messages must not be used afterwards."""
        try:
            self._bytes.release()
            self._map.close()
        except BufferError:  # a message is still in use: the garbage collector closes the file
            pass

    def forget(self, chunk: ChunkIndex) -> None:
        """Give the memory of a chunk's pages back; they are read again when they are needed."""
        forget_pages(self._map, chunk.offset, chunk.length)

    def records(self, chunk: ChunkIndex) -> bytes | memoryview:
        """The records of a chunk, decompressed and checked; a view of the file if they are plain.

        Plain records are checked when they are read first: a checksum costs more than the rest of
        reading a few fields of one topic.

        Raises:
            BagError: The chunk is damaged; the text says where it lies.
        """
        content = self._bytes[chunk.offset : chunk.offset + chunk.length]
        if content[0] != Op.CHUNK:
            return content
        try:
            is_intact = chunk.offset in self._intact
            records = chunk_records(content[OPCODE_AND_LENGTH.size :], is_intact=is_intact)
        except BagError as error:
            raise BagError(f"{self.path}: chunk at byte {chunk.offset}: {error}") from None
        if isinstance(records, memoryview):
            self._intact.add(chunk.offset)
        return records

    @property
    def compression(self) -> str:
        """Compression of the first chunk; empty if the file has no chunks."""
        for chunk in self.chunks:
            if self._bytes[chunk.offset] == Op.CHUNK:
                fields = self._bytes[chunk.offset + _PREFIX : chunk.offset + chunk.length]
                reader = RecordReader(fields)
                reader.take(_CHUNK_FIELDS)
                return reader.string()
        return ""

    def raw_chunk(self, chunk: ChunkIndex) -> RawChunk | None:
        """Return a chunk with its message indexes as they are in the file.

        Returns:
            None if the chunk has no message indexes, or if they do not fit the summary: only
            reading its messages shows what it holds.
        """
        end = chunk.offset + chunk.length + chunk.index_bytes
        if not chunk.index_bytes or end > len(self._bytes):
            return None
        record = self._bytes[chunk.offset : chunk.offset + chunk.length]
        indexes = self._bytes[chunk.offset + chunk.length : end]
        try:
            return raw_chunk(chunk, record, indexes)
        except (BagError, struct.error):  # it ends in the middle of a field
            return None

    def messages(
        self, chunk: ChunkIndex, wanted: Container[int] | None = None
    ) -> Iterator[tuple[int, int, int, bytes]]:
        """Log time, channel, publish time and bytes of a chunk's messages, in the file's order.

        Args:
            chunk: One of `chunks`.
            wanted: The channels whose messages are wanted; None means all.

        Raises:
            BagError: The chunk is damaged; the messages before the damage were yielded.
        """
        records = self.records(chunk)
        position, end = 0, len(records)
        while position < end:
            found: list[RawMessage] = []
            position = mcap_messages(records, position, wanted, found)
            yield from found
            if position < end:
                position = self._other_record(records, position, chunk)

    def _other_record(self, records: bytes | memoryview, position: int, chunk: ChunkIndex) -> int:
        """Read a record other than a message, and return where the next one begins."""
        body = position + _PREFIX
        if body > len(records):
            raise self.cut(chunk, position)
        opcode, length = OPCODE_AND_LENGTH.unpack_from(records, position)
        end: int = body + length
        if end > len(records) or opcode == Op.MESSAGE:  # a message too short for its fields
            raise self.cut(chunk, position)
        try:
            self._read_definition(opcode, memoryview(records)[body:end])
        except BagError as error:
            raise BagError(f"{self.cut(chunk, position)}: {error}") from None
        return end

    def cut(self, chunk: ChunkIndex, position: int) -> BagError:
        """Return the error of a chunk whose records end at a position in the middle of one."""
        return BagError(
            f"{self.path}: chunk at byte {chunk.offset}: "
            f"its records are damaged at byte {position} of their decompressed bytes"
        )

    def _read_definition(self, opcode: int, content: memoryview) -> None:
        reader = RecordReader(content)
        if opcode == Op.SCHEMA:
            schema = reader.schema()
            self.schemas.setdefault(schema.id, schema)
        elif opcode == Op.CHANNEL:
            channel = reader.channel()
            self.channels.setdefault(channel.id, channel)

    # -- the summary

    def _read_summary(self) -> bool:
        """Read the summary section; False if it is missing or damaged."""
        data = self._bytes
        footer = len(data) - len(MAGIC) - _FOOTER_SIZE
        if footer < len(MAGIC) or data[-len(MAGIC) :] != MAGIC or data[footer] != Op.FOOTER:
            return False
        fields = RecordReader(data[footer + OPCODE_AND_LENGTH.size :])
        start, _, expected_crc = fields.u64(), fields.u64(), fields.u32()
        if not start:
            return False
        if start > footer:
            self.problems.append(f"{self.path}: the footer points past the end of the file")
            return False
        if expected_crc and zlib.crc32(data[start : len(data) - len(MAGIC) - 4]) != expected_crc:
            self.problems.append(f"{self.path}: the summary at byte {start} is damaged")
            return False
        try:
            for opcode, content, _ in self._top_records(start, footer):
                self._read_summary_record(opcode, content)
        except BagError as error:
            self.problems.append(f"{self.path}: the summary at byte {start} is damaged: {error}")
            self.chunks.clear()
            return False
        return True

    def _summary_is_complete(self) -> bool:
        """Return True if the summary is complete: writers may omit each kind of record."""
        used = self.statistics.channel_counts.keys()
        return (
            self._has_statistics
            and used <= self.channels.keys()
            and {each.schema_id for each in self.channels.values()} <= {0, *self.schemas}
            and (bool(self.chunks) or not self.statistics.message_count)
        )

    def _read_summary_record(self, opcode: int, content: memoryview) -> None:
        if opcode in (Op.SCHEMA, Op.CHANNEL):
            self._read_definition(opcode, content)
        elif opcode == Op.CHUNK_INDEX:
            chunk = RecordReader(content).chunk_index()
            if not chunk.length or chunk.offset + chunk.length > len(self._bytes):
                raise BagError("it lists a chunk that is empty or after the end of the file")
            self.chunks.append(chunk)
        elif opcode == Op.STATISTICS:
            self.statistics = RecordReader(content).statistics()
            self._has_statistics = True
        elif opcode == Op.ATTACHMENT_INDEX:
            self.extra_positions.add(RecordReader(content).u64())
        elif opcode == Op.METADATA_INDEX:
            offset = RecordReader(content).u64()
            self.extra_positions.add(offset)
            for found, record, _ in self._top_records(offset, len(self._bytes)):
                if found == Op.METADATA:
                    self._read_metadata(record)
                break

    def _read_metadata(self, content: memoryview) -> None:
        reader = RecordReader(content)
        try:
            name = reader.string()
            self.metadata[name] = reader.text_map()
        except BagError as error:  # no message needs it
            self.problems.append(f"{self.path}: its metadata cannot be read: {error}")

    def top_records(self) -> Iterator[tuple[int, memoryview, int]]:
        """Yield opcode, content and position of the records that lie in no chunk.

        Raises:
            BagError: The file is damaged; the records before the damage were yielded.
        """
        return self._top_records(len(MAGIC), len(self._bytes))

    def record_at(self, position: int) -> tuple[int, memoryview]:
        """Return opcode and bytes of a whole record, its opcode and length included.

        Raises:
            BagError: The file has no whole record at this position.
        """
        for opcode, content, _ in self._top_records(position, len(self._bytes)):
            return opcode, self._bytes[position : position + _PREFIX + len(content)]
        raise BagError(f"{self.path}: there is no record at byte {position}")

    def _top_records(self, position: int, end: int) -> Iterator[tuple[int, memoryview, int]]:
        """Opcode, content and position of the records between two positions of the file."""
        data = self._bytes
        while position < end:
            body = position + OPCODE_AND_LENGTH.size
            if body > end:
                raise BagError(f"the file ends in the middle of a record at byte {position}")
            opcode, length = OPCODE_AND_LENGTH.unpack_from(data, position)
            if body + length > end or not opcode:
                raise BagError(f"the record at byte {position} is cut off or damaged")
            yield opcode, data[body : body + length], position
            position = body + length

    # -- a file without a summary

    def _walk_file(self) -> None:
        """Find chunks, definitions and counts by reading the whole file."""
        self.chunks.clear()
        totals = _Totals()
        reached = len(MAGIC)
        try:
            for opcode, content, position in self._top_records(reached, len(self._bytes)):
                reached = position + OPCODE_AND_LENGTH.size + len(content)
                if opcode in (Op.SCHEMA, Op.CHANNEL):
                    self._read_definition(opcode, content)
                elif opcode == Op.METADATA:
                    self.extra_positions.add(position)
                    self._read_metadata(content)
                elif opcode == Op.ATTACHMENT:
                    self.extra_positions.add(position)
                elif opcode == Op.CHUNK:
                    size = len(content) + OPCODE_AND_LENGTH.size
                    self._add_chunk(position, size, totals, is_cut=False)
                elif opcode == Op.MESSAGE:
                    self._add_bare_message(position, content, totals)
                elif opcode == Op.DATA_END:
                    break
        except BagError as error:
            lost = len(self._bytes) - reached
            self.problems.append(
                f"{self.path}: {error}; all data before it is read, and the intact messages of the "
                f"last {counted(lost, 'byte')}"
            )
            if self._bytes[reached : reached + 1] == _CHUNK:  # whole messages may lie in it
                rest = len(self._bytes) - reached
                self._add_chunk(reached, rest, totals, is_cut=True)
        self.statistics = totals.statistics()

    def _add_chunk(self, position: int, length: int, totals: _Totals, *, is_cut: bool) -> None:
        """Add a chunk with the times and channels of its messages.

        Nothing is known of the messages that a damaged one has lost: it counts for all later times
        and all channels, so that `messages` raises whichever of them are wanted.
        """
        own = _Totals()
        is_damaged = False
        try:
            for log_time, channel, _, _ in self.messages(ChunkIndex(0, 0, position, length, None)):
                own.add(channel, log_time)
        except BagError as error:
            self.problems.append(str(error))
            is_damaged = not is_cut
        totals.merge(own)
        start = own.start_ns if own.counts else 0
        if is_damaged:
            self.chunks.append(ChunkIndex(start, _NO_TIME, position, length, None))
        elif own.counts:
            channels = frozenset(own.counts)
            self.chunks.append(ChunkIndex(start, own.end_ns, position, length, channels))

    def _add_bare_message(self, position: int, content: memoryview, totals: _Totals) -> None:
        """Add a message outside of chunks; messages in a row make up one block."""
        if len(content) < _MESSAGE.size:
            raise BagError(f"the message at byte {position} is damaged")
        channel, _, log_time, _ = _MESSAGE.unpack_from(content)
        totals.add(channel, log_time)
        length = len(content) + OPCODE_AND_LENGTH.size
        last = self.chunks[-1] if self.chunks else None
        if (
            last is None
            or last.offset + last.length != position
            or self._bytes[last.offset] != Op.MESSAGE
            or last.length > _BARE_BLOCK_BYTES
        ):
            self.chunks.append(ChunkIndex(log_time, log_time, position, length, None))
            return
        start, end = min(last.start_ns, log_time), max(last.end_ns, log_time)
        self.chunks[-1] = ChunkIndex(start, end, last.offset, last.length + length, None)


class _Totals:
    """Counts and times of the messages seen so far."""

    def __init__(self) -> None:
        self.counts: dict[int, int] = {}
        self.start_ns = _NO_TIME
        self.end_ns = 0

    def add(self, channel: int, log_time: int) -> None:
        self.counts[channel] = self.counts.get(channel, 0) + 1
        self.start_ns = min(self.start_ns, log_time)
        self.end_ns = max(self.end_ns, log_time)

    def merge(self, other: _Totals) -> None:
        for channel, count in other.counts.items():
            self.counts[channel] = self.counts.get(channel, 0) + count
        self.start_ns = min(self.start_ns, other.start_ns)
        self.end_ns = max(self.end_ns, other.end_ns)

    def statistics(self) -> McapStatistics:
        start = self.start_ns if self.counts else 0
        return McapStatistics(sum(self.counts.values()), start, self.end_ns, self.counts)


#: Bare messages are grouped into blocks of about this size, so that they can be put in order.
_BARE_BLOCK_BYTES = 1 << 20
