"""Write a bag on a background thread; callers never wait for the disk."""

from __future__ import annotations

import sqlite3
import threading
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.bag.writer import BagWriter

__all__ = ["Recording", "RecordingStatus"]

#: Messages reach the file at the latest after this time, so that those that are older than a
#: second survive the recorder's sudden end.
_FLUSH_SECONDS = 0.4

#: With this much waiting it is written at once.
_BATCH_BYTES = 2 << 20

#: Topic, bytes, log time and publish time of a message.
_Message = tuple[str, bytes, int, int]


class RecordingStatus(NamedTuple):
    """How a recording goes.

    Attributes:
        messages: How many messages were handed in.
        data_bytes: Their bytes.
        lost: How many of them found no room while the disk was too slow.
    """

    messages: int
    data_bytes: int
    lost: int


class Recording:
    """Writes the messages of several threads into a bag, on a thread of its own.

    Args:
        writer: The bag. It belongs to this object from now on; topics are added with `add_topic`.
        cache_bytes: How many bytes may wait for the disk; what comes then is lost and counted. 0
            means no limit.
        snapshot: Whether messages are only kept, the newest ``cache_bytes`` of them, until
            `take_snapshot` writes them.
        on_failure: Called once, on the writing thread, when the bag cannot be written any more.

    Attributes:
        failure: Why the bag cannot be written any more; None while all is well.
        lost: Numbers of lost messages by topic.

    Raises:
        BagError: Snapshots without a limit of the cache.
    """

    def __init__(
        self,
        writer: BagWriter,
        *,
        cache_bytes: int = 100 << 20,
        snapshot: bool = False,
        on_failure: Callable[[Exception], None] | None = None,
    ) -> None:
        if snapshot and not cache_bytes:
            raise BagError("Max cache size must be greater than 0 when snapshot mode is enabled")
        self.failure: Exception | None = None
        self.lost: dict[str, int] = {}
        self._writer = writer
        self._cache_bytes = cache_bytes
        self._snapshot = snapshot
        self._on_failure = on_failure
        self._messages = self._data_bytes = 0
        self._waiting: deque[_Message] = deque()
        self._waiting_bytes = 0
        self._changed = threading.Condition()
        self._closing = self._is_closed = False
        self._disk = threading.Lock()  # the writer is not thread-safe; guards nothing else
        self._thread = threading.Thread(target=self._run, name="bag-writer", daemon=True)
        self._thread.start()

    @property
    def status(self) -> RecordingStatus:
        """Recording's progress."""
        with self._changed:
            return RecordingStatus(self._messages, self._data_bytes, sum(self.lost.values()))

    def write(
        self, topic: str, data: bytes, log_time_ns: int, publish_time_ns: int | None = None
    ) -> None:
        """Hand in one message of a topic that was added; never waits for the disk.

        Args:
            topic: Name of its topic.
            data: Its CDR bytes.
            log_time_ns: When it was received, nanoseconds since 1970.
            publish_time_ns: When it was sent; None if it is not known.
        """
        size = len(data)
        message = (topic, data, log_time_ns, publish_time_ns or log_time_ns)
        with self._changed:
            self._messages += 1
            self._data_bytes += size
            full = self._cache_bytes and self._waiting_bytes + size > self._cache_bytes
            if full and self._snapshot:
                while self._waiting and self._waiting_bytes + size > self._cache_bytes:
                    self._waiting_bytes -= len(self._waiting.popleft()[1])
            elif (full and self._waiting) or self.failure or self._closing:
                self.lost[topic] = self.lost.get(topic, 0) + 1
                return
            self._waiting.append(message)
            self._waiting_bytes += size
            if len(self._waiting) == 1 or self._waiting_bytes >= _BATCH_BYTES:
                self._changed.notify_all()

    def add_topic(self, *args: Any, **options: Any) -> None:
        """Add a topic; see `BagWriter.add_topic`."""
        with self._disk:
            try:
                self._writer.add_topic(*args, **options)
            except (OSError, sqlite3.Error) as error:
                self._fail(error)

    def take_snapshot(self) -> bool:
        """Write what is kept now; returns whether it is in the file."""
        return self._write_waiting() and self.failure is None

    def split(self) -> tuple[str, str]:
        """Write what waits, finish the file and begin another; see `BagWriter.split`.

        Raises:
            BagError: The recording has ended.
            OSError: The bag can no longer be written; `failure` has the same error.
            sqlite3.Error: The same of a database.
        """
        if not self._snapshot:
            self._write_waiting()
        with self._disk:
            if self._is_closed:
                raise BagError("the recording has ended")
            try:
                return self._writer.split()
            except (OSError, sqlite3.Error) as error:
                self._fail(error)
                raise

    def close(self) -> None:
        """Write what waits and finish the bag; closing twice does nothing.

        Raises:
            OSError: The bag could not be finished, for example because the disk is full.
        """
        with self._changed:
            if self._closing:
                return
            self._closing = True
            self._changed.notify_all()
        self._thread.join()
        with self._disk:
            self._is_closed = True
            self._writer.close()

    def _take(self) -> list[_Message]:
        with self._changed:
            messages = list(self._waiting)
            self._waiting.clear()
            self._waiting_bytes = 0
        return messages

    def _run(self) -> None:
        while self._wait():
            self._write_waiting()
        if not self._snapshot:
            self._write_waiting()

    def _wait(self) -> bool:
        """Wait until there is enough to write or the oldest is old enough; False at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._closing or (self._waiting and not self._snapshot))
            self._changed.wait_for(
                lambda: self._closing or self._waiting_bytes >= _BATCH_BYTES, _FLUSH_SECONDS
            )
            return not self._closing

    def _write_waiting(self) -> bool:
        """Write what waits; False if the bag is closed."""
        with self._disk:
            if self._is_closed:
                return False
            try:
                for message in self._take():
                    self._writer.write(*message)
                self._writer.flush()
            except (OSError, sqlite3.Error) as error:
                self._fail(error)
        return True

    def _fail(self, error: Exception) -> None:
        if self.failure is None:
            self.failure = error
            if self._on_failure is not None:
                self._on_failure(error)
