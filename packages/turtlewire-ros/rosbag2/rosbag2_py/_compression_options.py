"""rosbag2's own compression of a bag, in addition to the compression of its storage."""

from __future__ import annotations

from dataclasses import dataclass

from rosbag2_transport.options import NumberedEnum


class CompressionMode(NumberedEnum):
    """The unit of compression."""

    NONE = 0
    FILE = 1
    MESSAGE = 2


@dataclass(slots=True)
class CompressionOptions:
    """Compression of a writer.

    Attributes:
        compression_format: ``zstd``.
        compression_mode: The unit: each message or each file.
        compression_queue_size: Messages that may wait for compression.
        compression_threads: Threads that compress; 0 for one for each core.
    """

    compression_format: str = ""
    compression_mode: CompressionMode = CompressionMode.NONE
    compression_queue_size: int = 0
    compression_threads: int = 0


def compression_mode_from_string(compression_mode: str) -> CompressionMode:
    """Return a mode from its name in any case; empty means NONE.

    Raises:
        RuntimeError: The mode does not exist.
    """
    name = compression_mode.upper() or "NONE"
    if name not in CompressionMode.__members__:
        raise RuntimeError(f'CompressionMode "{compression_mode}" is not valid')
    return CompressionMode[name]


def compression_mode_to_string(compression_mode: CompressionMode) -> str:
    """Return the name of a mode."""
    return compression_mode.name
