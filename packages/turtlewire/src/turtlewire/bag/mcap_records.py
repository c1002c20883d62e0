"""The records of an MCAP file, as bytes and as objects.

Source: the MCAP specification (version 0). Numbers are little-endian; a string is its length (u32)
and UTF-8 bytes; maps and arrays are their length in bytes (u32) and their entries.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass, field

from turtlewire.errors import BagError

__all__ = [
    "MAGIC",
    "OPCODE_AND_LENGTH",
    "Channel",
    "ChunkIndex",
    "McapStatistics",
    "Op",
    "RawChunk",
    "RecordReader",
    "Schema",
    "pack_map",
    "pack_string",
    "record",
]

MAGIC = b"\x89MCAP0\r\n"

#: What each record begins with.
OPCODE_AND_LENGTH = struct.Struct("<BQ")

_U16, _U32, _U64 = struct.Struct("<H"), struct.Struct("<I"), struct.Struct("<Q")


class Op:
    """The record types (a plain class: comparing IntEnum members costs time for each message)."""

    HEADER = 0x01
    FOOTER = 0x02
    SCHEMA = 0x03
    CHANNEL = 0x04
    MESSAGE = 0x05
    CHUNK = 0x06
    MESSAGE_INDEX = 0x07
    CHUNK_INDEX = 0x08
    ATTACHMENT = 0x09
    ATTACHMENT_INDEX = 0x0A
    STATISTICS = 0x0B
    METADATA = 0x0C
    METADATA_INDEX = 0x0D
    SUMMARY_OFFSET = 0x0E
    DATA_END = 0x0F


@dataclass(frozen=True)
class Schema:
    """The definition of a type.

    Attributes:
        id: Its number in the file, never 0.
        name: ``tf2_msgs/msg/TFMessage``.
        encoding: ``ros2msg``, ``ros2idl``; empty or ``unknown`` if the definition is missing.
        data: The text of the definition in UTF-8.
    """

    id: int
    name: str
    encoding: str
    data: bytes


@dataclass(frozen=True)
class Channel:
    """A topic with its type.

    Attributes:
        id: Its number in the file.
        schema_id: The number of its schema; 0 for none.
        topic: The topic's name.
        message_encoding: ``cdr``.
        metadata: For rosbag2 ``offered_qos_profiles`` (YAML) and ``topic_type_hash``.
    """

    id: int
    schema_id: int
    topic: str
    message_encoding: str
    metadata: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class ChunkIndex:
    """Position, time span and topics of a chunk.

    Attributes:
        start_ns: Smallest log time of its messages.
        end_ns: Largest log time.
        offset: Position of the chunk's record in the file.
        length: Length of that record, opcode and length included.
        channels: The channels with messages in it; None if the file does not say.
        index_bytes: Length of the MessageIndex records behind the chunk; 0 if it has none.
    """

    start_ns: int
    end_ns: int
    offset: int
    length: int
    channels: frozenset[int] | None
    index_bytes: int = 0


@dataclass(frozen=True)
class RawChunk:
    """A chunk as its file holds it, which can be copied without decompressing it.

    Attributes:
        record: The Chunk record.
        indexes: The MessageIndex records behind it.
        start_ns: Smallest log time of its messages.
        end_ns: Largest log time.
        compression: ``""``, ``"zstd"`` or ``"lz4"``.
        packed_bytes: Size of its records as they are in the file.
        plain_bytes: Size of its records when decompressed.
        index_offsets: Position of each channel's MessageIndex record in `indexes`.
        counts: Number of messages of each channel.
        crc: CRC-32 of its decompressed records; 0 for none.
    """

    record: memoryview
    indexes: memoryview
    start_ns: int
    end_ns: int
    compression: str
    packed_bytes: int
    plain_bytes: int
    index_offsets: dict[int, int]
    counts: dict[int, int]
    crc: int

    def is_damaged(self) -> bool:
        """Return True if its checksum shows damage; that of a compressed chunk is not checked."""
        if self.compression or not self.crc:
            return False
        return zlib.crc32(self.record[len(self.record) - self.plain_bytes :]) != self.crc


@dataclass(frozen=True)
class McapStatistics:
    """Topics, times and counts of a whole file.

    Attributes:
        message_count: Number of messages.
        start_ns: Smallest log time.
        end_ns: Largest log time.
        channel_counts: Number of messages of each channel.
        extra_records: Number of Attachment and Metadata records.
    """

    message_count: int
    start_ns: int
    end_ns: int
    channel_counts: dict[int, int]
    extra_records: int = 0


class RecordReader:
    """Reads the fields of one record's content, in order.

    Raises:
        BagError: From each method, when the content ends too early or holds no UTF-8.
    """

    def __init__(self, content: memoryview) -> None:
        self._content = content
        self.position = 0

    def _number(self, layout: struct.Struct) -> int:
        try:
            (value,) = layout.unpack_from(self._content, self.position)
        except struct.error:
            raise BagError("a record ends in the middle of a field") from None
        self.position += layout.size
        number: int = value
        return number

    def u16(self) -> int:
        """Return an unsigned number of two bytes."""
        return self._number(_U16)

    def u32(self) -> int:
        """Return an unsigned number of four bytes."""
        return self._number(_U32)

    def u64(self) -> int:
        """Return an unsigned number of eight bytes."""
        return self._number(_U64)

    def take(self, length: int) -> memoryview:
        """Return the next ``length`` bytes."""
        end = self.position + length
        if end > len(self._content):
            raise BagError("a field is longer than its record")
        part = self._content[self.position : end]
        self.position = end
        return part

    def string(self) -> str:
        """Return a string."""
        try:
            return str(self.take(self.u32()), "utf-8")
        except UnicodeDecodeError:
            raise BagError("a string is not UTF-8") from None

    def text_map(self) -> dict[str, str]:
        """Return a map of strings to strings."""
        end = self.u32() + self.position
        entries = {}
        while self.position < end:
            key = self.string()
            entries[key] = self.string()
        return entries

    def number_map(self) -> dict[int, int]:
        """Return a map of u16 to u64."""
        end = self.u32() + self.position
        entries = {}
        while self.position < end:
            key = self.u16()
            entries[key] = self.u64()
        return entries

    def schema(self) -> Schema:
        """Return the content of a Schema record."""
        return Schema(self.u16(), self.string(), self.string(), bytes(self.take(self.u32())))

    def channel(self) -> Channel:
        """Return the content of a Channel record."""
        return Channel(self.u16(), self.u16(), self.string(), self.string(), self.text_map())

    def chunk_index(self) -> ChunkIndex:
        """Return the content of a ChunkIndex record."""
        start, end, offset, length = self.u64(), self.u64(), self.u64(), self.u64()
        indexes = self.number_map()
        # Without message indexes the map is empty although the chunk has messages.
        channels = frozenset(indexes) if indexes else None
        return ChunkIndex(start, end, offset, length, channels, self.u64())

    def statistics(self) -> McapStatistics:
        """Return the content of a Statistics record."""
        count = self.u64()
        self.take(2 + 4)  # numbers of schemas and channels
        extra_records = self.u32() + self.u32()  # attachments and metadata
        self.take(4)  # number of chunks
        return McapStatistics(count, self.u64(), self.u64(), self.number_map(), extra_records)


def pack_string(text: str) -> bytes:
    """Return a string as its length and UTF-8 bytes."""
    data = text.encode()
    return _U32.pack(len(data)) + data


def pack_map(entries: dict[str, str]) -> bytes:
    """Return a map of strings to strings."""
    data = b"".join(pack_string(key) + pack_string(value) for key, value in entries.items())
    return _U32.pack(len(data)) + data


def record(opcode: int, content: bytes) -> bytes:
    """Return a whole record."""
    return OPCODE_AND_LENGTH.pack(opcode, len(content)) + content
