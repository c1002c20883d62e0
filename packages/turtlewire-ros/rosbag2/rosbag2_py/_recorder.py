"""Records bags from scripts: controlled by method calls, or in one call that blocks."""

from __future__ import annotations

import queue
import threading
import weakref
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from rclpy.logging import get_logging_severity_from_string, set_logger_level
from rosbag2_py._compression_options import CompressionMode, compression_mode_from_string
from rosbag2_py._writer import get_registered_compressors, make_writer
from rosbag2_transport.options import RecordOptions
from rosbag2_transport.record import record

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions
    from rosbag2_transport.recorder import BagRecorder

_Stop = queue.SimpleQueue[None]


class Recorder:
    """Records topics into bags.

    With a bag, the methods steer its recording: :meth:`record` returns at once. Without one, as in
    the first releases of Jazzy, :meth:`record` is given the bag, and blocks.

    Args:
        storage_options: The bag; or the log level, as in the first releases of Jazzy.
        record_options: Options of the recording.
        log_level: ``debug``, ``info``, ``warn``, ``error`` or ``fatal``.
        node_name: Name of the recorder's node.

    Raises:
        RuntimeError: The level does not exist.
    """

    # Of the class, because `cancel` is a class method in ROS 2.
    _running: ClassVar[set[_Stop]] = set()

    def __init__(
        self,
        storage_options: StorageOptions | str | None = None,
        record_options: RecordOptions | None = None,
        log_level: str = "info",
        node_name: str = "rosbag2_recorder",
    ) -> None:
        if isinstance(storage_options, str):
            log_level, storage_options = storage_options, None
        set_logger_level("", get_logging_severity_from_string(log_level))
        self._storage = storage_options
        self._options = record_options or RecordOptions()
        self._node_name = node_name
        self._recording: _Recording | None = None

    # -- the recording of one bag

    def start_spin(self) -> None:
        """Do nothing: the services of the recorder's node are answered while it records."""

    def stop_spin(self) -> None:
        """Do nothing, as :meth:`start_spin`."""

    def record(
        self,
        storage_options: StorageOptions | None = None,
        record_options: RecordOptions | None = None,
        node_name: str = "rosbag2_recorder",
    ) -> None:
        """Start to record; without its own bag, record until `cancel`.

        The recording of a bag that is given here also ends by SIGINT and SIGTERM in the main
        thread.

        Raises:
            RuntimeError: The bag exists, the options do not fit, or the bag could not be written
                any more.
        """
        if storage_options is not None:
            options = record_options or RecordOptions()
            stop: _Stop = queue.SimpleQueue()
            self._running.add(stop)
            try:
                _record(storage_options, options, node_name, stop, lambda _recorder: None)
            finally:
                self._running.discard(stop)
        elif self._storage is None:
            raise RuntimeError("this Recorder has no bag: give Recorder() storage and options")
        elif self._recording is None:
            self._recording = _Recording(self._storage, self._options, self._node_name)
            # Ends the bag in order with the object, or with the process.
            weakref.finalize(self, self._recording.end)

    def stop(self) -> None:
        """Finish the bag.

        Raises:
            RuntimeError: The bag could not be written any more.
        """
        if self._recording is not None:
            recording, self._recording = self._recording, None
            recording.stop()

    def pause(self) -> None:
        """Drop messages until :meth:`resume`."""
        self._recorder().pause()

    def resume(self) -> None:
        """Record again."""
        self._recorder().resume()

    def is_paused(self) -> bool:
        """Return True if messages are dropped at the moment."""
        return self._options.start_paused if self._recording is None else self._recorder().is_paused

    def _recorder(self) -> BagRecorder:
        if self._recording is None:
            raise RuntimeError("nothing is recorded: call record() first")
        return self._recording.recorder

    # -- bags that are given call by call

    @classmethod
    def cancel(cls) -> None:
        """End the recordings of this process that block; returns at once."""
        for stop in list(cls._running):
            stop.put(None)


class _Recording:
    """A recording on its own thread.

    Raises:
        RuntimeError: The recording could not start.
    """

    def __init__(self, storage: StorageOptions, options: RecordOptions, node_name: str) -> None:
        self._stop: _Stop = queue.SimpleQueue()
        self._failure: RuntimeError | None = None
        started: queue.SimpleQueue[BagRecorder | None] = queue.SimpleQueue()

        def run() -> None:
            try:
                _record(storage, options, node_name, self._stop, started.put)
            except RuntimeError as error:
                self._failure = error
            started.put(None)

        self._thread = threading.Thread(target=run, name="bag-recorder", daemon=True)
        self._thread.start()
        recorder = started.get()
        if recorder is None:
            self.stop()
            raise RuntimeError("the recording ended at once")
        self.recorder = recorder

    def end(self) -> None:
        """Finish the bag."""
        self._stop.put(None)
        self._thread.join()

    def stop(self) -> None:
        """Finish the bag, and raise what went wrong."""
        self.end()
        if self._failure is not None:
            raise self._failure


def _record(
    storage: StorageOptions,
    options: RecordOptions,
    node_name: str,
    stop: _Stop,
    on_start: Callable[[BagRecorder], object],
) -> None:
    record(
        partial(make_writer, storage, compression_mode_of(options)),
        options,
        stop,
        node_name=node_name,
        cache_bytes=storage.max_cache_size,
        cache_ns=storage.max_cache_duration * 1_000_000_000,
        snapshot=storage.snapshot_mode,
        on_start=on_start,
    )


def compression_mode_of(options: RecordOptions) -> str:
    """Return ``FILE``, ``MESSAGE`` or an empty string.

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
