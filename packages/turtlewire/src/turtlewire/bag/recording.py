"""Write a bag on a background thread; callers never wait for the disk."""

from __future__ import annotations

import threading
from collections import Counter, deque
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.errors import BagError

if TYPE_CHECKING:
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
    """The progress of a recording.

    Attributes:
        messages: How many messages were handed in.
        data_bytes: Their bytes.
        lost: How many of them found no room while the disk was too slow.
    """

    messages: int
    data_bytes: int
    lost: int


class Recording:
    """Writes the messages of several threads into a bag, on its own thread.

    Args:
        writer: The bag. It belongs to this object from now on; topics are added with `add_topic`.
        cache_bytes: How many bytes may wait for the disk; what comes then is lost and counted. 0
            means no limit.
        cache_ns: The span of log times that a snapshot may have; 0 means no limit.
        snapshot: Whether messages are only kept, the newest within ``cache_bytes`` and
            ``cache_ns``, until `take_snapshot` writes them.
        on_failure: Called once, on the writing thread, when the bag cannot be written any more.

    Attributes:
        failure: Why the bag cannot be written any more; None while all is well.
        lost: Numbers of messages by topic that found no room in the cache, or that came too late
            for a bag that cannot be written any more.
        refused: Numbers of messages by topic that no bag can hold, and why the first was refused.

    Raises:
        BagError: Snapshots without a limit of the cache.
    """

    def __init__(
        self,
        writer: BagWriter,
        *,
        cache_bytes: int = 100 << 20,
        cache_ns: int = 0,
        snapshot: bool = False,
        on_failure: Callable[[Exception], None] | None = None,
    ) -> None:
        if snapshot and not cache_bytes and not cache_ns:
            raise BagError("snapshots need a limit: cache_bytes or cache_ns must be more than 0")
        self.failure: Exception | None = None
        self.lost: dict[str, int] = {}
        self.refused: dict[str, tuple[int, str]] = {}
        self._writer = writer
        self._cache_bytes, self._cache_ns = cache_bytes, cache_ns
        self._snapshot = snapshot
        self._on_failure = on_failure
        self._messages = self._data_bytes = 0
        self._waiting: deque[_Message] = deque()
        self._waiting_bytes = 0
        self._changed = threading.Condition()
        self._repeated: dict[str, deque[_Message]] = {}
        self._last_ns = 0
        writer.on_begin = self._write_again
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
            publish_time_ns: When it was sent; None, or a time before 1970, if it is not known.
        """
        size = len(data)
        if publish_time_ns is None or publish_time_ns <= 0:
            publish_time_ns = log_time_ns
        message = (topic, data, log_time_ns, publish_time_ns)
        with self._changed:
            self._messages += 1
            self._data_bytes += size
            if self._snapshot:
                self._drop_oldest(size, log_time_ns)
            elif (self._is_full(size) and self._waiting) or self.failure or self._closing:
                self.lost[topic] = self.lost.get(topic, 0) + 1
                return
            self._waiting.append(message)
            self._waiting_bytes += size
            if len(self._waiting) == 1 or self._waiting_bytes >= _BATCH_BYTES:
                self._changed.notify_all()

    def _is_full(self, size: int) -> bool:
        return 0 < self._cache_bytes < self._waiting_bytes + size

    def _drop_oldest(self, size: int, now_ns: int) -> None:
        """Drop messages until a new one fits into the snapshot."""
        while self._waiting and (
            self._is_full(size) or 0 < self._cache_ns < now_ns - self._waiting[0][2]
        ):
            dropped = self._waiting.popleft()
            self._waiting_bytes -= len(dropped[1])
            self._remember(dropped)

    def add_topic(self, *args: Any, **options: Any) -> None:
        """Add a topic; see `BagWriter.add_topic`."""
        with self._disk:
            try:
                self._writer.add_topic(*args, **options)
            except OSError as error:
                self._fail(error)

    def repeat(self, topic: str, depth: int) -> None:
        """Write the newest messages of a topic again into each further file and snapshot.

        Args:
            topic: Name of a topic that was added, for example of transforms that are latched.
            depth: How many messages.
        """
        with self._changed:
            self._repeated.setdefault(topic, deque(maxlen=depth))

    def take_snapshot(self) -> bool:
        """Write what is kept now; returns whether it is in the file."""
        return self._write_waiting() and self.failure is None

    def split(self) -> tuple[str, str]:
        """Write what waits, finish the file and begin another; see `BagWriter.split`.

        Raises:
            BagError: The recording has ended.
            OSError: The bag can no longer be written; `failure` has the same error.
        """
        if not self._snapshot:
            self._write_waiting()
        with self._disk:
            if self._is_closed:
                raise BagError("the recording has ended")
            try:
                paths = self._writer.split()
                self._write_again(self._last_ns)
            except OSError as error:
                self._fail(error)
                raise
            return paths

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

    def _take(self) -> deque[_Message]:
        with self._changed:
            messages, self._waiting = self._waiting, deque()
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
            messages = self._take()
            try:
                if self.failure is None:
                    self._write(messages)
            except OSError as error:
                self._fail(error)
            with self._changed:
                for topic, *_ in messages:
                    self.lost[topic] = self.lost.get(topic, 0) + 1
        return True

    def _write(self, messages: deque[_Message]) -> None:
        """Write messages and remove them from the queue. The caller holds ``_disk``."""
        if self._snapshot:
            self._write_again(messages[0][2] if messages else self._last_ns, messages)
        while messages:
            self._write_one(messages[0])
            messages.popleft()
        self._writer.flush()

    def _write_one(self, message: _Message) -> None:
        try:
            self._writer.write(*message)
        except (BagError, ValueError) as error:  # empty, or of no time: the others are written
            count, reason = self.refused.get(message[0], (0, str(error)))
            self.refused[message[0]] = count + 1, reason
        else:
            self._last_ns = message[2]
            self._remember(message)

    def _write_again(self, time_ns: int, following: Sequence[_Message] = ()) -> None:
        """Write the newest messages of the topics to repeat. The caller holds ``_disk``.

        Args:
            time_ns: Their log time: files begin with it.
            following: Messages that are written next; they need no repetition.
        """
        counts = Counter(topic for topic, *_ in following)
        with self._changed:
            again = [
                message
                for topic, newest in self._repeated.items()
                for message in _all_but(newest, counts[topic])
            ]
        for topic, data, _, publish_time_ns in again:
            self._writer.append(topic, data, time_ns, publish_time_ns)  # begins no file

    def _remember(self, message: _Message) -> None:
        newest = self._repeated.get(message[0])
        if newest is not None:
            newest.append(message)

    def _fail(self, error: Exception) -> None:
        if self.failure is None:
            self.failure = error
            if self._on_failure is not None:
                self._on_failure(error)


def _all_but(newest: deque[_Message], count: int) -> list[_Message]:
    """Return the messages that still belong to the newest ones when ``count`` others follow."""
    assert newest.maxlen is not None
    return list(newest)[max(0, len(newest) + count - newest.maxlen) :]
