"""Plays bags from scripts: controlled by method calls, or in one call that blocks."""

from __future__ import annotations

import contextlib
import queue
import sqlite3
import threading
import weakref
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy.logging import get_logging_severity_from_string, set_logger_level
from rosbag2_transport.options import PlayOptions
from rosbag2_transport.play import burst, play, served_player
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions
    from rosbag2_transport.player import BagPlayer


class Player:
    """Plays bags.

    With a bag, the methods steer its playback: :meth:`play` returns at once. Without one, as in the
    first releases of Jazzy, :meth:`play` and :meth:`burst` are given the bag, and block.

    Args:
        storage_options: The bag, or a list of bags; or the log level, as in the first releases of
            Jazzy.
        play_options: Options of the playback.
        log_level: ``debug``, ``info``, ``warn``, ``error`` or ``fatal``.
        node_name: Name of the player's node.

    Raises:
        RuntimeError: The level or the bag does not exist, or an option is invalid.
    """

    # Of the class, because `cancel` is a class method in ROS 2.
    _running: ClassVar[set[queue.SimpleQueue[None]]] = set()

    def __init__(
        self,
        storage_options: StorageOptions | Sequence[StorageOptions] | str | None = None,
        play_options: PlayOptions | None = None,
        log_level: str = "info",
        node_name: str = "rosbag2_player",
    ) -> None:
        if isinstance(storage_options, str):
            log_level, storage_options = storage_options, None
        set_logger_level("", get_logging_severity_from_string(log_level))
        #: The thread of the last playback.
        self._threads: list[threading.Thread] = []
        self._failures: list[Exception] = []
        self._player: BagPlayer | None = None
        if storage_options is None:
            return
        opened = contextlib.ExitStack()
        try:
            paths, options = _paths(storage_options), play_options or PlayOptions()
            self._player, _ = opened.enter_context(served_player(paths, options, node_name))
        except (BagError, OSError) as error:
            raise RuntimeError(str(error)) from error
        # Ends threads and node with the object, or with the process.
        weakref.finalize(self, _end, self._player, self._threads, opened)

    # -- the playback of one bag

    def start_spin(self) -> None:
        """Do nothing: the services of the player's node are answered from the beginning."""

    def stop_spin(self) -> None:
        """Do nothing, as :meth:`start_spin`."""

    def play(
        self,
        storage_options: StorageOptions | Sequence[StorageOptions] | None = None,
        play_options: PlayOptions | None = None,
    ) -> bool:
        """Start the playback; without its own bag, play one to the end.

        The playback of a bag that is given here ends with the bag, by `cancel`, and in the main
        thread by SIGINT or SIGTERM.

        Returns:
            False if the playback is running already.

        Raises:
            RuntimeError: The bag does not exist, or an option is invalid.
        """
        if storage_options is not None:
            options = play_options or PlayOptions()
            self._until_cancelled(lambda stop: play(_paths(storage_options), options, stop))
            return True
        player = self._steered()
        if not player.begin():
            return False
        self._threads[:] = [
            threading.Thread(
                target=_run, args=(player, self._failures), name="bag-player", daemon=True
            )
        ]
        self._threads[0].start()
        return True

    def stop(self) -> None:
        """End the playback, and wait for its end."""
        self._steered().stop()
        self.wait_for_playback_to_finish()

    def pause(self) -> None:
        """Hold the clock of the playback."""
        self._steered().pause()

    def resume(self) -> None:
        """Let the clock of the playback run again."""
        self._steered().resume()

    def is_paused(self) -> bool:
        """Return True if the clock of the playback is held."""
        return self._steered().clock.is_paused

    def play_next(self) -> bool:
        """Publish the next message of a paused playback; False at the end or if it runs."""
        return self._steered().play_next()

    def seek(self, time_point: int) -> None:
        """Continue at a time of the bag, in nanoseconds."""
        self._steered().seek(time_point)

    def burst(self, *bag_and_number: Any) -> int | None:
        """Publish the next messages of a paused playback at once: ``burst(num_messages)``.

        ``burst(storage_options, play_options, num_messages)`` starts a playback with it, which then
        waits paused, and ends as that of `play` does.

        Args:
            *bag_and_number: The number of messages, 0 for all; optionally the bag and its options
                before it.

        Returns:
            How many messages there were; None if the bag is given.

        Raises:
            RuntimeError: The bag does not exist, or an option is invalid.
        """
        *bag, number = bag_and_number
        if not bag:
            return self._steered().burst(number)
        storage, options = bag
        self._until_cancelled(lambda stop: burst(_paths(storage), options, stop, number))
        return None

    def wait_for_playback_to_start(self, timeout: float = -1.0) -> bool:
        """Wait for the first message's turn, at most this many seconds; negative: no limit.

        Returns:
            False if the timeout passes first.
        """
        return self._steered().wait_until_started(None if timeout < 0 else timeout)

    def wait_for_playback_to_finish(self, timeout: float = -1.0) -> bool:
        """Wait for the end of the playback, at most this many seconds; negative: no limit.

        Returns:
            False if the timeout passes first.

        Raises:
            RuntimeError: The bag is damaged.
        """
        for thread in self._threads:
            thread.join(None if timeout < 0 else timeout)
            if thread.is_alive():
                return False
        if self._failures:
            raise RuntimeError(str(self._failures[0])) from self._failures.pop(0)
        return True

    wait_for_playback_to_start_exclusively = wait_for_playback_to_start
    wait_for_playback_to_finish_exclusively = wait_for_playback_to_finish

    def get_starting_time(self) -> int:
        """Return the log time of the bag's first message, in nanoseconds."""
        return self._steered().start_ns

    def get_playback_duration(self) -> int:
        """Return the nanoseconds from the bag's first message to the end of the playback."""
        player = self._steered()
        return player.end_ns - player.start_ns

    def _steered(self) -> BagPlayer:
        if self._player is None:
            raise RuntimeError("this Player has no bag: give Player() storage and play options")
        return self._player

    # -- bags that are given call by call

    @classmethod
    def cancel(cls) -> None:
        """End the playbacks of this process that block; returns at once."""
        for stop in list(cls._running):
            stop.put(None)

    def _until_cancelled(self, run: Callable[[queue.SimpleQueue[None]], None]) -> None:
        stop: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._running.add(stop)
        try:
            run(stop)
        finally:
            self._running.discard(stop)


def _run(player: BagPlayer, failures: list[Exception]) -> None:
    """Play on a thread, which must not keep the `Player` alive."""
    try:
        player.run()
    except (BagError, OSError, sqlite3.Error) as error:
        failures.append(error)


def _end(player: BagPlayer, threads: list[threading.Thread], opened: contextlib.ExitStack) -> None:
    player.stop()
    for thread in threads:
        thread.join()
    opened.close()


def _paths(storage_options: StorageOptions | Sequence[StorageOptions]) -> list[str]:
    """Return the paths of the bags.

    Raises:
        RuntimeError: The list is empty.
    """
    if not isinstance(storage_options, (list, tuple)):
        return [storage_options.uri]  # type: ignore[union-attr]
    if not storage_options:
        raise RuntimeError("expected at least one bag to play, got an empty list")
    return [each.uri for each in storage_options]
