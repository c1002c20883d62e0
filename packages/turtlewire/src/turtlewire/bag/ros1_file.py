"""Reads one ``.bag`` file of ROS 1 (format 2.0): its connections, chunks and messages.

A bag that was closed ends with its connections and the times of each chunk. A bag whose recorder
was killed has no end and is walked from the start; all intact messages are read.
"""

from __future__ import annotations

import bz2
import struct
from collections.abc import Container, Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turtlewire.bag.compression import decompress, most_bytes
from turtlewire.bag.mapped_files import forget_pages, map_file
from turtlewire.bag.mcap_records import ChunkIndex
from turtlewire.bag.record_messages import ros1_fields, ros1_header, ros1_messages
from turtlewire.errors import BagError
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.bag.record_messages import RawMessage

__all__ = ["MAGIC", "Connection", "Ros1File"]

MAGIC = b"#ROSBAG V2.0\n"

_MESSAGE, _BAG_HEADER, _CHUNK, _CHUNK_INFO, _CONNECTION = b"\2", b"\3", b"\5", b"\6", b"\7"
_U32, _U64 = struct.Struct("<I"), struct.Struct("<Q")
_TIME = struct.Struct("<II")  # seconds, nanoseconds
_DAMAGE = (ValueError, KeyError, struct.error)


@dataclass(frozen=True)
class Connection:
    """A publisher of a topic.

    Attributes:
        topic: The topic.
        type: The type of its messages, ``sensor_msgs/Imu``.
        definition: The definition of the type with its dependencies.
        latching: Whether its last message was kept for later subscribers.
    """

    topic: str
    type: str
    definition: str
    latching: bool


class Ros1File:
    """An open bag of ROS 1.

    Attributes:
        path: Where it is; of a decompressed copy, the compressed file.
        connections: The connections by number.
        chunks: The chunks, in the order of the file.
        counts: How many messages each connection has.
        problems: What is damaged, one sentence each; filled while reading.

    Raises:
        BagError: The file is not a bag of ROS 1, or an encrypted one.
        OSError: The file cannot be opened.
    """

    def __init__(self, path: str, name: str = "") -> None:
        self.path = name or path
        self.connections: dict[int, Connection] = {}
        self.chunks: list[ChunkIndex] = []
        self.counts: dict[int, int] = {}
        self.problems: list[str] = []
        self._map, self._bytes = map_file(path, MAGIC, "a bag of ROS 1")
        try:
            self._read()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Release the file."""
        try:
            self._bytes.release()
            self._map.close()
        except BufferError:  # an error that is being raised still refers to the bytes
            pass

    def forget(self, chunk: ChunkIndex) -> None:
        """Release the memory of a chunk's pages; they are read again when they are needed."""
        forget_pages(self._map, chunk.offset, chunk.length)

    def messages(
        self, chunk: ChunkIndex, wanted: Container[int] | None = None
    ) -> Iterator[RawMessage]:
        """Yield log time, connection, log time again and bytes of a chunk's messages.

        Args:
            chunk: One of `chunks`.
            wanted: The connections whose messages are wanted; None means all.

        Raises:
            BagError: The chunk is damaged; the messages before the damage were yielded.
        """
        records = self._records(chunk)
        position = 0
        while position < len(records):
            found: list[RawMessage] = []
            position = ros1_messages(records, position, wanted, found)
            yield from found
            if position < len(records):
                position = self._other_record(records, position, chunk)

    def _other_record(self, records: bytes | memoryview, position: int, chunk: ChunkIndex) -> int:
        """Read a record other than a message, and return where the next one begins."""
        try:
            fields, data, end = ros1_fields(records, position)
            if fields["op"] == _CONNECTION:
                self._add_connection(fields, data)
            elif fields["op"] == _MESSAGE:
                raise ValueError("a message without its fields")
        except _DAMAGE as error:
            raise BagError(
                f"{self.path}: chunk at byte {chunk.offset}: its records are damaged at byte "
                f"{position} of their decompressed bytes: {_text(error)}"
            ) from None
        return end

    def _records(self, chunk: ChunkIndex) -> bytes | memoryview:
        try:
            if chunk.offset + chunk.length == len(self._bytes) and self._is_cut(chunk.offset):
                return self._whole_records(chunk.offset)
            fields, data, _ = ros1_fields(self._bytes, chunk.offset)
            compression = fields["compression"].decode("utf-8", "replace")
            (size,) = _U32.unpack(fields["size"])
            if compression == "none":
                return data
            if compression == "bz2":
                return _decompress_bz2(data, size)
            return decompress(compression, data, size)
        except (BagError, *_DAMAGE) as error:
            raise BagError(f"{self.path}: chunk at byte {chunk.offset}: {_text(error)}") from None

    def _is_cut(self, offset: int) -> bool:
        """Return True if the file ends in the data of a record."""
        begin, size = self._data_of(offset)
        return begin + size > len(self._bytes)

    def _data_of(self, offset: int) -> tuple[int, int]:
        """Return where the data of a record begin, and their size."""
        begin = offset + 4 + _U32.unpack_from(self._bytes, offset)[0]
        return begin + 4, _U32.unpack_from(self._bytes, begin)[0]

    def _whole_records(self, offset: int) -> memoryview:
        """Return the whole records of a chunk in which the file ends; none of a compressed one."""
        begin, _ = self._data_of(offset)
        records = self._bytes[begin:]
        fields = ros1_header(self._bytes[offset + 4 : begin - 4])
        position = 0
        with suppress(*_DAMAGE):
            while fields["compression"] == b"none":
                position = ros1_fields(records, position)[2]
        return records[:position]

    # -- the connections and the chunks

    def _read(self) -> None:
        try:
            fields, _, begin = ros1_fields(self._bytes, len(MAGIC))
            if fields["op"] != _BAG_HEADER:
                raise ValueError("its first record is not the header of a bag")
            (index,) = _U64.unpack(fields["index_pos"])
        except _DAMAGE as error:
            raise BagError(f"{self.path} is not a bag of ROS 1: {_text(error)}") from None
        if fields.get("encryptor", b"") not in (b"", b"rosbag/NoEncryptor"):
            raise BagError(f"{self.path} is encrypted")
        if index > len(self._bytes):
            self.problems.append(f"{self.path}: it ends before its index at byte {index}")
        if not index or index > len(self._bytes) or not self._read_index(index):
            self._walk(begin)

    def _read_index(self, position: int) -> bool:
        """Read the connections and times of chunks at the end; False if they are damaged."""
        try:
            while position < len(self._bytes):
                fields, data, position = ros1_fields(self._bytes, position)
                if fields["op"] == _CONNECTION:
                    self._add_connection(fields, data)
                elif fields["op"] == _CHUNK_INFO:
                    self._add_chunk_info(fields, data)
        except _DAMAGE as error:
            self.problems.append(f"{self.path}: its index is damaged: {_text(error)}")
        else:
            if self.counts.keys() <= self.connections.keys():
                return True
            self.problems.append(f"{self.path}: its index is damaged: a connection is missing")
        self.connections.clear()
        self.chunks.clear()
        self.counts.clear()
        return False

    def _add_connection(self, fields: dict[str, bytes], data: memoryview) -> None:
        (number,) = _U32.unpack(fields["conn"])
        known = ros1_header(data)
        self.connections.setdefault(
            number,
            Connection(
                fields["topic"].decode("utf-8", "replace"),
                known["type"].decode("utf-8", "replace"),
                known["message_definition"].decode("utf-8", "replace"),
                known.get("latching") == b"1",
            ),
        )

    def _add_chunk_info(self, fields: dict[str, bytes], data: memoryview) -> None:
        (offset,) = _U64.unpack(fields["chunk_pos"])
        chunk, _, end = ros1_fields(self._bytes, offset)
        if chunk["op"] != _CHUNK or len(data) % 8:
            raise ValueError("it does not fit the chunks")
        counts = dict(struct.iter_unpack("<II", data))
        for number, count in counts.items():
            self.counts[number] = self.counts.get(number, 0) + count
        times = _nanoseconds(fields["start_time"]), _nanoseconds(fields["end_time"])
        self.chunks.append(ChunkIndex(*times, offset, end - offset, frozenset(counts)))

    def _walk(self, position: int) -> None:
        """Find chunks, connections and counts by reading the whole file."""
        try:
            while position < len(self._bytes):
                fields, data, end = ros1_fields(self._bytes, position)
                if fields["op"] == _CONNECTION:
                    self._add_connection(fields, data)
                elif fields["op"] == _CHUNK:
                    self._add_chunk(position, end - position)
                position = end
        except _DAMAGE as error:
            lost = len(self._bytes) - position
            self.problems.append(
                f"{self.path}: the record at byte {position} is cut off or damaged "
                f"({_text(error)}); all data before it is read, and the intact messages of the "
                f"last {counted(lost, 'byte')}"
            )
            with suppress(*_DAMAGE):
                if self._is_cut(position):
                    self._add_chunk(position, lost)

    def _add_chunk(self, position: int, length: int) -> None:
        times: list[int] = []
        chunk = ChunkIndex(0, 0, position, length, None)
        found: set[int] = set()
        try:
            for log_time, number, _, _ in self.messages(chunk):
                times.append(log_time)
                found.add(number)
                self.counts[number] = self.counts.get(number, 0) + 1
        except BagError as error:
            self.problems.append(str(error))
        self.forget(chunk)
        if times:
            span = min(times), max(times)
            self.chunks.append(ChunkIndex(*span, position, length, frozenset(found)))


def _nanoseconds(time: bytes) -> int:
    seconds, nanoseconds = _TIME.unpack(time)
    return int(seconds) * 1_000_000_000 + int(nanoseconds)


def _text(error: Exception) -> str:
    return f"it has no field {error}" if isinstance(error, KeyError) else str(error)


def _decompress_bz2(data: memoryview, size: int) -> bytes:
    if size > most_bytes(len(data)):
        raise BagError(f"{len(data)} bytes say that they hold {size} bytes, which is too much")
    try:
        out = bz2.BZ2Decompressor().decompress(data, size + 1)
    except (OSError, EOFError) as error:
        raise BagError(f"damaged bz2 data: {error}") from None
    if len(out) != size:
        raise BagError(f"a chunk decompresses to {len(out)} bytes instead of {size}")
    return out
