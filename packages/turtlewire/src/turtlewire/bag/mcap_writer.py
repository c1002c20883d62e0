"""Writes one MCAP file in chunks, as rosbag2 does.

Flushed data survives if the process is killed: chunks are complete records, and a reader walks a
file that has no summary.
"""

from __future__ import annotations

import struct
import zlib
from itertools import accumulate, count
from typing import TYPE_CHECKING

from turtlewire.bag.compression import compress, most_bytes
from turtlewire.bag.mcap_records import (
    MAGIC,
    OPCODE_AND_LENGTH,
    Op,
    RawChunk,
    RecordReader,
    Schema,
    pack_map,
    pack_string,
    record,
)
from turtlewire.bag.metadata import dump_metadata
from turtlewire.bag.qos_yaml import profiles_to_text
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.message import BagChannel
    from turtlewire.bag.metadata import BagMetadata

__all__ = ["CHUNK_BYTES", "McapWriter"]

#: rosbag2's default.
CHUNK_BYTES = 768 * 1024

_MESSAGE = struct.Struct("<BQHIQQ")
_LIBRARY = "turtlewire"
_MOST_NUMBERS = (1 << 16) - 1


class McapWriter:
    """An MCAP file that is being written.

    Args:
        path: The file; it must not exist.
        compression: Of the chunks: ``""``, ``"zstd"`` or ``"lz4"``.
        level: Compression level of zstd.
        chunk_bytes: Size of a chunk before compression.
        checksums: Whether chunks carry a CRC-32.

    Raises:
        FileExistsError: The file already exists.
        OSError: From each method: the file cannot be written, for example because the disk is full.
    """

    def __init__(
        self,
        path: str,
        *,
        compression: str = "",
        level: int = 1,
        chunk_bytes: int = CHUNK_BYTES,
        checksums: bool = True,
    ) -> None:
        compress(compression, b"", level)  # refuse a compression that is not known or not installed
        self.path = path
        self._compression = compression
        self._level = level
        self._chunk_bytes = chunk_bytes
        self._checksums = checksums
        #: Channel, log time, publish time and bytes of the messages of the chunk to come.
        self._pending: list[tuple[int, int, int, bytes]] = []
        self._pending_bytes = 0
        #: Bytes of the records that the summary repeats or adds.
        self.summary_bytes = 0
        self._new_definitions: list[bytes] = []
        self._definitions: list[bytes] = []
        self._schemas: set[int] = set()
        #: The number in this file of each schema that `define` has added.
        self.schema_ids: dict[Schema, int] = {}
        self._channels: set[int] = set()
        self._chunk_indexes: list[bytes] = []
        self._metadata_indexes: list[bytes] = []
        self._attachment_indexes: list[bytes] = []
        self._file = open(path, "xb", buffering=0)  # noqa: SIM115 - closed by close()
        self.file_bytes = 0
        self.message_count = 0
        self.start_ns = (1 << 64) - 1
        self.end_ns = 0
        self.channel_counts: dict[int, int] = {}
        self._put(MAGIC + record(Op.HEADER, pack_string("ros2") + pack_string(_LIBRARY)))

    @property
    def size(self) -> int:
        """Bytes in the file and waiting for it."""
        return self.file_bytes + self._pending_bytes

    def add_schema(self, name: str, encoding: str, data: bytes, number: int | None = None) -> int:
        """Add a type; returns its id, which is ``number`` if no other type has it."""
        number = _free(self._schemas, number, 1)
        content = struct.pack("<H", number) + pack_string(name) + pack_string(encoding)
        self._add(record(Op.SCHEMA, content + struct.pack("<I", len(data)) + data))
        return number

    def add_channel(
        self,
        schema_id: int,
        topic: str,
        metadata: dict[str, str],
        encoding: str = "cdr",
        number: int | None = None,
    ) -> int:
        """Add a topic; returns its id, which is ``number`` if no other topic has it."""
        number = _free(self._channels, number, 0)
        content = struct.pack("<HH", number, schema_id) + pack_string(topic)
        self._add(record(Op.CHANNEL, content + pack_string(encoding) + pack_map(metadata)))
        return number

    def _add(self, definition: bytes) -> None:
        self._definitions.append(definition)
        self.summary_bytes += len(definition)
        self._new_definitions.append(definition)

    def define(self, channel: BagChannel, version: int) -> int:
        """Add a channel and its type with their numbers of another file, if these are free.

        Args:
            channel: The channel.
            version: The version of the bag's metadata; QoS is written as in that version.

        Returns:
            The id of the channel.
        """
        schema, original = channel.schema, channel.record
        schema_id = self.schema_ids.get(schema, 0)
        if not schema_id and schema.name:
            number = schema.id or None
            schema_id = self.add_schema(schema.name, schema.encoding, schema.data, number)
            self.schema_ids[schema] = schema_id
        topic = channel.topic
        if original is None:
            qos = profiles_to_text(topic.qos, version)
            metadata = {"offered_qos_profiles": qos, "topic_type_hash": topic.type_hash}
            return self.add_channel(schema_id, topic.name, metadata, topic.serialization_format)
        return self.add_channel(
            schema_id, topic.name, original.metadata, original.message_encoding, original.id
        )

    def write(self, channel_id: int, log_time_ns: int, publish_time_ns: int, data: bytes) -> None:
        """Add a message; it reaches the file when its chunk is full or at `flush`."""
        # Only collects: making the records of a whole chunk at once takes half the time.
        self._pending.append((channel_id, log_time_ns, publish_time_ns, data))
        self._pending_bytes += _MESSAGE.size + len(data)
        if self._pending_bytes >= self._chunk_bytes:
            self.flush()

    def write_metadata(self, name: str, entries: dict[str, str]) -> None:
        """Add a Metadata record between chunks."""
        self.flush()
        self.copy_extra(memoryview(record(Op.METADATA, pack_string(name) + pack_map(entries))))

    def embed(self, metadata: BagMetadata) -> None:
        """Add the bag's metadata; the last one counts."""
        self.write_metadata("rosbag2", {"serialized_metadata": dump_metadata(metadata)})

    def copy_extra(self, content: memoryview) -> None:
        """Append an Attachment or Metadata record as it is."""
        reader = RecordReader(content[OPCODE_AND_LENGTH.size :])
        index = struct.pack("<QQ", self.file_bytes, len(content))
        self._put(content)
        if content[0] == Op.METADATA:
            index += pack_string(reader.string())
            self._metadata_indexes.append(record(Op.METADATA_INDEX, index))
        else:
            log_time, create_time = reader.u64(), reader.u64()
            name, media_type, size = reader.string(), reader.string(), reader.u64()
            index += struct.pack("<QQQ", log_time, create_time, size)
            index += pack_string(name) + pack_string(media_type)
            self._attachment_indexes.append(record(Op.ATTACHMENT_INDEX, index))

    def flush(self) -> None:
        """Write the pending messages as a chunk and hand it to the operating system.

        After an error the messages still wait, and the file ends with its last whole record.
        """
        if not self._pending and not self._new_definitions:
            return
        pack, fields = _MESSAGE.pack, _MESSAGE.size - OPCODE_AND_LENGTH.size
        definitions = b"".join(self._new_definitions)
        messages = [
            # rosbag2 writes the sequence number 0 always.
            pack(Op.MESSAGE, fields + len(data), channel, 0, log_time, publish_time) + data
            for channel, log_time, publish_time, data in self._pending
        ]
        index: dict[int, list[int]] = {}
        positions = accumulate(map(len, messages), initial=len(definitions))
        # The last position is that behind the last message.
        for (channel, log_time, _, _), position in zip(self._pending, positions, strict=False):
            entries = index.get(channel)
            if entries is None:
                entries = index[channel] = []
            entries.append(log_time)
            entries.append(position)
        messages.insert(0, definitions)
        self._write_chunk(b"".join(messages), index)
        self._new_definitions.clear()
        self.discard()

    def discard(self) -> None:
        """Forget the pending messages, for example because the disk is full."""
        self._pending.clear()
        self._pending_bytes = 0

    def _write_chunk(self, records: bytes, index: dict[int, list[int]]) -> None:
        """Write a chunk with its message indexes.

        Args:
            records: What it holds.
            index: Log time and offset of each message, alternating, by channel.
        """
        times = [time for entries in index.values() for time in entries[::2]]
        start, end = (min(times), max(times)) if times else (0, 0)
        crc = zlib.crc32(records) if self._checksums else 0
        compression, packed = self._packed(records)
        fields = (
            struct.pack("<QQQI", start, end, len(records), crc)
            + pack_string(compression)
            + struct.pack("<Q", len(packed))
        )
        head = OPCODE_AND_LENGTH.pack(Op.CHUNK, len(fields) + len(packed)) + fields
        indexes, offsets = _message_indexes(index)
        counts = {channel: len(entries) // 2 for channel, entries in index.items()}
        chunk = (start, end, compression, len(packed), len(records), offsets, counts)
        self._append_chunk((head, packed), indexes, *chunk)

    def copy_chunk(self, chunk: RawChunk) -> None:
        """Append a chunk of another file as it is.

        The channels and schemas of its messages must have the same numbers in this file.
        """
        self.flush()
        self._append_chunk(
            (chunk.record,),
            chunk.indexes,
            chunk.start_ns,
            chunk.end_ns,
            chunk.compression,
            chunk.packed_bytes,
            chunk.plain_bytes,
            chunk.index_offsets,
            chunk.counts,
        )

    def _append_chunk(
        self,
        chunk: tuple[bytes | memoryview, ...],
        indexes: bytes | memoryview,
        start: int,
        end: int,
        compression: str,
        packed_bytes: int,
        plain_bytes: int,
        index_offsets: dict[int, int],
        counts: dict[int, int],
    ) -> None:
        """Append a chunk and its message indexes, and note them for the summary."""
        offset, chunk_bytes = self.file_bytes, sum(map(len, chunk))
        self._put(*chunk, indexes)
        first = offset + chunk_bytes
        offsets = b"".join(
            struct.pack("<HQ", channel, first + place) for channel, place in index_offsets.items()
        )
        chunk_index = (
            struct.pack("<QQQQI", start, end, offset, chunk_bytes, len(offsets))
            + offsets
            + struct.pack("<Q", len(indexes))
            + pack_string(compression)
            + struct.pack("<QQ", packed_bytes, plain_bytes)
        )
        self._chunk_indexes.append(record(Op.CHUNK_INDEX, chunk_index))
        self.summary_bytes += len(self._chunk_indexes[-1])
        for channel, number in counts.items():
            self.channel_counts[channel] = self.channel_counts.get(channel, 0) + number
        if counts:
            self.start_ns = min(self.start_ns, start)
            self.end_ns = max(self.end_ns, end)
        self.message_count += sum(counts.values())

    def _packed(self, records: bytes) -> tuple[str, bytes]:
        """Compress a chunk; return the compression and the bytes.

        A chunk that readers would take for a bomb is written as it is.
        """
        packed = compress(self._compression, records, self._level)
        if len(records) > most_bytes(len(packed)):
            return "", records
        return self._compression, packed

    def _put(self, *parts: bytes | memoryview) -> None:
        """Append to the file, or leave it as it was."""
        try:
            for part in parts:
                rest = memoryview(part)
                while rest:
                    rest = rest[self._file.write(rest) :]
        except OSError:
            # Readers ignore half a chunk, but it may fill the rest of the disk.
            self._file.truncate(self.file_bytes)
            self._file.seek(self.file_bytes)
            raise
        self.file_bytes += sum(map(len, parts))

    def close(self) -> None:
        """Write the summary and close the file.

        If the messages that wait cannot be written, they are lost, and the rest gets its summary.
        """
        try:
            try:
                self.flush()
            finally:
                self._end()
        finally:
            self._file.close()

    def abandon(self) -> None:
        """Close the file without completing it, because it will be deleted."""
        self._file.close()

    def _end(self) -> None:
        self._put(record(Op.DATA_END, bytes(4)) + self._summary() + MAGIC)

    def _summary(self) -> bytes:
        """Return the summary section with its offsets and the footer."""
        start = self.file_bytes + OPCODE_AND_LENGTH.size + 4  # behind the DataEnd record
        schemas = [part for part in self._definitions if part[0] == Op.SCHEMA]
        channels = [part for part in self._definitions if part[0] == Op.CHANNEL]
        groups = [
            (Op.SCHEMA, schemas),
            (Op.CHANNEL, channels),
            (Op.STATISTICS, [self._statistics()]),
            (Op.CHUNK_INDEX, self._chunk_indexes),
            (Op.ATTACHMENT_INDEX, self._attachment_indexes),
            (Op.METADATA_INDEX, self._metadata_indexes),
        ]
        summary = b""
        offsets = b""
        for opcode, records in groups:
            data = b"".join(records)
            if data:
                place = struct.pack("<BQQ", opcode, start + len(summary), len(data))
                offsets += record(Op.SUMMARY_OFFSET, place)
            summary += data
        fields = struct.pack("<QQ", start, start + len(summary))
        footer = OPCODE_AND_LENGTH.pack(Op.FOOTER, len(fields) + 4) + fields
        covered = summary + offsets + footer
        return covered + struct.pack("<I", zlib.crc32(covered))

    def _statistics(self) -> bytes:
        counts = b"".join(
            struct.pack("<HQ", channel, number) for channel, number in self.channel_counts.items()
        )
        return record(
            Op.STATISTICS,
            struct.pack(
                "<QHIIIIQQ",
                self.message_count,
                len(self._schemas),
                len(self._channels),
                len(self._attachment_indexes),
                len(self._metadata_indexes),
                len(self._chunk_indexes),
                self.start_ns if self.message_count else 0,
                self.end_ns,
            )
            + struct.pack("<I", len(counts))
            + counts,
        )


def _message_indexes(index: dict[int, list[int]]) -> tuple[bytes, dict[int, int]]:
    """Return the MessageIndex records that follow a chunk, and where in them each channel's is."""
    records: list[bytes] = []
    offsets: dict[int, int] = {}
    position = 0
    for channel, entries in index.items():
        data = struct.pack(f"<{len(entries)}Q", *entries)
        records.append(record(Op.MESSAGE_INDEX, struct.pack("<HI", channel, len(data)) + data))
        offsets[channel] = position
        position += len(records[-1])
    return b"".join(records), offsets


def _free(used: set[int], number: int | None, first: int) -> int:
    """Return ``number`` if it is free, else the first free one, and note that it is used."""
    if number is None or number in used:
        number = next(each for each in count(first) if each not in used)
    if number > _MOST_NUMBERS:
        raise BagError(f"an MCAP file has at most {_MOST_NUMBERS:,} topics and definitions")
    used.add(number)
    return number
