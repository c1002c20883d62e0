"""Playing bags as scripts start it."""

from __future__ import annotations

import queue
from typing import TYPE_CHECKING, ClassVar

from rclpy.logging import get_logging_severity_from_string, set_logger_level
from rosbag2_transport.play import burst, play

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions
    from rosbag2_transport.options import PlayOptions

__all__ = ["Player"]


class Player:
    """Plays bags.

    Args:
        log_level: ``debug``, ``info``, ``warn``, ``error`` or ``fatal``.

    Raises:
        RuntimeError: The level does not exist.
    """

    _running: ClassVar[set[queue.SimpleQueue[None]]] = set()

    def __init__(self, log_level: str = "info") -> None:
        set_logger_level("", get_logging_severity_from_string(log_level))

    def play(self, storage_options: StorageOptions, play_options: PlayOptions) -> None:
        """Play to the end or until `cancel`; in the main thread also until SIGINT or SIGTERM.

        Raises:
            RuntimeError: The bag does not exist, or an option is invalid.
        """
        stop: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._running.add(stop)
        try:
            play(storage_options.uri, play_options, stop)
        finally:
            self._running.discard(stop)

    def burst(
        self, storage_options: StorageOptions, play_options: PlayOptions, num_messages: int
    ) -> None:
        """Publish the first messages at once, then wait paused; ends as `play` does.

        Args:
            storage_options: The bag.
            play_options: What is played, and how.
            num_messages: How many messages; 0 for all.

        Raises:
            RuntimeError: The bag does not exist, or an option is invalid.
        """
        stop: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._running.add(stop)
        try:
            burst(storage_options.uri, play_options, stop, num_messages)
        finally:
            self._running.discard(stop)

    @classmethod
    def cancel(cls) -> None:
        """End the playbacks of this process; returns at once."""
        for stop in list(cls._running):
            stop.put(None)
