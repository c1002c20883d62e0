"""The time of a playback, and messages that are read before they are due."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.bag.message import BagMessage

__all__ = ["PlayClock", "ReadAhead"]


class PlayClock:
    """Shows a time of the bag that runs at a rate, stands still or jumps. Not thread-safe.

    Args:
        now_ns: The time that it shows first.
        rate: Bag seconds in one second, more than 0.
        is_paused: Whether it stands still.
        monotonic_ns: The clock behind it; another one is for tests.

    Attributes:
        rate: Bag seconds in one second.
        is_paused: Whether it stands still.
    """

    def __init__(
        self,
        now_ns: int,
        rate: float = 1.0,
        *,
        is_paused: bool = False,
        monotonic_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self.rate = rate
        self.is_paused = is_paused
        self._monotonic_ns = monotonic_ns
        self._shown_ns = now_ns
        self._since_ns = monotonic_ns()

    def now_ns(self) -> int:
        """Return the time of the bag, nanoseconds since 1970."""
        if self.is_paused:
            return self._shown_ns
        return self._shown_ns + int((self._monotonic_ns() - self._since_ns) * self.rate)

    def jump(self, now_ns: int) -> None:
        """Show another time from now on."""
        self._shown_ns, self._since_ns = now_ns, self._monotonic_ns()

    def pause(self) -> None:
        """Stand still."""
        self.jump(self.now_ns())
        self.is_paused = True

    def resume(self) -> None:
        """Run on from the time that it shows."""
        self.jump(self.now_ns())
        self.is_paused = False

    def set_rate(self, rate: float) -> None:
        """Run at another rate, more than 0, from the time that it shows."""
        self.jump(self.now_ns())
        self.rate = rate

    def seconds_until(self, time_ns: int) -> float:
        """Return the real seconds until a time of the bag, as if it ran; 0 for the past.

        The result is at most `threading.TIMEOUT_MAX`.
        """
        # From the last jump and not from now: errors do not add up over a long bag.
        due_ns = self._since_ns + (time_ns - self._shown_ns) / self.rate
        seconds = (due_ns - self._monotonic_ns()) * 1e-9
        return min(max(0.0, seconds), threading.TIMEOUT_MAX)


class ReadAhead:
    """Reads messages on its own thread, so that decompressing delays none that is due.

    Args:
        messages: What is read.
        size: How many messages are kept ready at most.
        size_bytes: How many bytes of them: a thousand images would fill the memory.
    """

    def __init__(
        self, messages: Iterator[BagMessage], size: int = 1000, size_bytes: int = 100 << 20
    ) -> None:
        self._size = max(1, size)
        self._size_bytes = size_bytes
        self._read_bytes = self._popped_bytes = 0  # each is written by one thread only
        self._ready: deque[BagMessage] = deque()
        self._changed = threading.Condition()
        self._ended = self._closed = self._waits = False
        self._failure: Exception | None = None
        self._thread = threading.Thread(
            target=self._run, args=(messages,), name="bag-reader", daemon=True
        )
        self._thread.start()

    def wait_until_ready(self) -> None:
        """Wait until the first message is read, or the end is reached."""
        with self._changed:
            self._changed.wait_for(lambda: self._ready or self._ended)

    def peek(self) -> BagMessage | None:
        """Return the next message, which stays the next one; None at the end.

        Raises:
            BagError: The bag is damaged; after all messages that can be read.
        """
        if self._ready:
            return self._ready[0]
        with self._changed:
            self._changed.wait_for(lambda: self._ready or self._ended)
            if self._ready:
                return self._ready[0]
        if self._failure is not None:
            raise self._failure
        return None

    def pop(self) -> None:
        """Go on behind the next message."""
        self._popped_bytes += len(self._ready.popleft().data)
        if self._waits and self._has_room():
            with self._changed:
                self._changed.notify_all()

    def _has_room(self) -> bool:
        """Return True if half of what is kept ready is gone."""
        return (
            len(self._ready) <= self._size // 2
            and self._read_bytes - self._popped_bytes <= self._size_bytes // 2
        )

    def close(self) -> None:
        """End the thread."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._thread.join()

    def _run(self, messages: Iterator[BagMessage]) -> None:
        try:
            for message in messages:
                waiting_bytes = self._read_bytes - self._popped_bytes
                if len(self._ready) >= self._size or waiting_bytes >= self._size_bytes:
                    with self._changed:
                        self._waits = True
                        self._changed.wait_for(lambda: self._has_room() or self._closed)
                        self._waits = False
                if self._closed:
                    return
                self._read_bytes += len(message.data)
                self._ready.append(message)
                if len(self._ready) == 1:
                    with self._changed:
                        self._changed.notify_all()
        except Exception as error:  # noqa: BLE001 - raised where the messages are needed
            self._failure = error
        finally:
            with self._changed:
                self._ended = True
                self._changed.notify_all()
