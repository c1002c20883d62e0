"""Recording as scripts start it."""

from __future__ import annotations

import queue
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from rclpy.logging import get_logging_severity_from_string, set_logger_level
from rosbag2_py._compression_options import CompressionMode, compression_mode_from_string
from rosbag2_py._open_writer import make_writer
from rosbag2_py._writer import get_registered_compressors
from rosbag2_transport.record import record

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions
    from rosbag2_transport.options import RecordOptions

__all__ = ["Recorder", "compression_mode_of"]


class Recorder:
    """Records topics into a bag.

    Args:
        log_level: ``debug``, ``info``, ``warn``, ``error`` or ``fatal``.

    Raises:
        RuntimeError: The level does not exist.
    """

    _running: ClassVar[set[queue.SimpleQueue[None]]] = set()

    def __init__(self, log_level: str = "info") -> None:
        set_logger_level("", get_logging_severity_from_string(log_level))

    def record(
        self,
        storage_options: StorageOptions,
        record_options: RecordOptions,
        node_name: str = "rosbag2_recorder",
    ) -> None:
        """Record until `cancel`; in the main thread also until SIGINT or SIGTERM.

        Raises:
            RuntimeError: The bag exists, the options do not fit, or the bag could not be written
                any more.
        """
        mode = compression_mode_of(record_options)
        stop: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._running.add(stop)
        try:
            record(
                partial(make_writer, storage_options, mode),
                record_options,
                stop,
                node_name=node_name,
                cache_bytes=storage_options.max_cache_size,
                snapshot=storage_options.snapshot_mode,
            )
        finally:
            self._running.discard(stop)

    @classmethod
    def cancel(cls) -> None:
        """End the recordings of this process; returns at once."""
        for stop in list(cls._running):
            stop.put(None)


def compression_mode_of(options: RecordOptions) -> str:
    """``FILE``, ``MESSAGE`` or empty.

    Raises:
        RuntimeError: Mode or format are not known.
    """
    mode = compression_mode_from_string(options.compression_mode)
    if mode is CompressionMode.NONE:
        return ""
    known = get_registered_compressors()
    if options.compression_format and options.compression_format not in known:
        raise RuntimeError(f"unknown compression format '{options.compression_format}'")
    return mode.name
