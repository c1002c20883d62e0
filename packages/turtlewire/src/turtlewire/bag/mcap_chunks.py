"""Chunks of an MCAP file: their records, and chunks to copy as they are."""

from __future__ import annotations

import zlib

from turtlewire.bag.compression import decompress
from turtlewire.bag.mcap_records import OPCODE_AND_LENGTH, ChunkIndex, Op, RawChunk, RecordReader
from turtlewire.errors import BagError

__all__ = ["chunk_records", "raw_chunk"]

_PREFIX = OPCODE_AND_LENGTH.size


def chunk_records(content: memoryview, *, is_intact: bool) -> bytes | memoryview:
    """Return the records of a chunk, decompressed; those before the end of a file that is cut off.

    Args:
        content: The content of the Chunk record.
        is_intact: Whether its checksum was compared before.

    Raises:
        BagError: The chunk is damaged.
    """
    reader = RecordReader(content)
    reader.take(16)  # the times of the first and last message
    size, crc, compression = reader.u64(), reader.u32(), reader.string()
    length = reader.u64()
    present = min(length, len(content) - reader.position)
    compressed, cut = reader.take(present), present < length
    records = decompress(compression, compressed, size, cut=cut) if compression else compressed
    if cut:  # the file ends in it
        return records[: _end_of_the_whole(records)]
    if crc and not is_intact and zlib.crc32(records) != crc:
        raise BagError("the checksum does not match: the chunk is damaged")
    return records


def raw_chunk(chunk: ChunkIndex, record: memoryview, indexes: memoryview) -> RawChunk | None:
    """Return a chunk whose parts fit together; None if they do not."""
    opcode, length = OPCODE_AND_LENGTH.unpack_from(record)
    reader = RecordReader(record[_PREFIX:])
    start, end, plain_bytes = reader.u64(), reader.u64(), reader.u64()
    crc, compression, packed_bytes = reader.u32(), reader.string(), reader.u64()
    whole = opcode == Op.CHUNK and _PREFIX + length == len(record)
    fits = (start, end) == (chunk.start_ns, chunk.end_ns)
    if not whole or not fits or reader.position + packed_bytes != length:
        return None
    offsets: dict[int, int] = {}
    counts: dict[int, int] = {}
    position = 0
    while position < len(indexes):
        opcode, length = OPCODE_AND_LENGTH.unpack_from(indexes, position)
        reader = RecordReader(indexes[position + _PREFIX : position + _PREFIX + length])
        channel, size = reader.u16(), reader.u32()
        if opcode != Op.MESSAGE_INDEX or size % 16 or size + 6 != length:
            return None
        if size:
            offsets[channel], counts[channel] = position, size // 16
        position += _PREFIX + length
    if position != len(indexes) or counts.keys() != chunk.channels:
        return None
    return RawChunk(
        record, indexes, start, end, compression, packed_bytes, plain_bytes, offsets, counts, crc
    )


def _end_of_the_whole(records: bytes | memoryview) -> int:
    """Return the end of the last whole record."""
    end = 0
    while end + _PREFIX <= len(records):
        _, length = OPCODE_AND_LENGTH.unpack_from(records, end)
        if end + _PREFIX + length > len(records):
            break
        end += _PREFIX + length
    return end
