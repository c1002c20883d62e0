"""The send queue of one client."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from itertools import count
from typing import NamedTuple

from turtlewire_view.foxglove.protocol import message_data

__all__ = ["Outbox"]


#: How many frames besides messages, or bytes of them, may wait before the client's next request.
_CROWD, _CROWD_BYTES = 500, 1 << 20
#: How many may wait at all.
_FLOOD = 5000


class _Message(NamedTuple):
    number: int
    time_ns: int
    cdr: bytes


class Outbox:
    """Messages of subscriptions, and all other frames. Thread-safe.

    The wire's threads put messages in, and never wait. When a client is slow and more bytes wait
    than it may have, the subscription with the most of them loses its oldest messages; each keeps
    its newest one, however large it is. All other frames are kept, go first and stay in order.

    Args:
        limit: How many bytes of messages may wait.
        wake: Called when there is something to take after there was nothing; for any thread.
        on_loss: Called with the id of a subscription when it loses its first message.
        on_flood: Called once when too many other frames wait for the client to be reading.
    """

    def __init__(
        self,
        limit: int,
        wake: Callable[[], None],
        on_loss: Callable[[int], None],
        on_flood: Callable[[], None],
    ) -> None:
        self._limit = limit
        self._wake = wake
        self._on_loss = on_loss
        self._on_flood = on_flood
        self._lock = threading.Lock()
        self._frames: deque[str | bytes] = deque()
        self._frame_bytes = 0
        self._time: bytes | None = None
        self._numbers = count(1)
        self._ids: dict[int, int] = {}
        self._messages: dict[int, deque[_Message]] = {}  # of subscriptions with any
        self._sizes: dict[int, int] = {}
        self._bytes = 0
        self._count = 0
        self._losing: set[int] = set()
        self._is_idle = True
        self._is_closed = False

    @property
    def is_crowded(self) -> bool:
        """True if the queue, apart from messages, is too full for further requests."""
        return self._frame_bytes >= _CROWD_BYTES or len(self._frames) >= _CROWD

    @property
    def is_empty(self) -> bool:
        """True if nothing waits."""
        return not (self._frames or self._messages) and self._time is None

    def send(self, frame: str | bytes) -> None:
        """Add a frame that is not lost."""
        with self._lock:
            if self._is_closed:
                return
            self._frames.append(frame)
            self._frame_bytes += len(frame)
            self._rouse()
            is_flooded = len(self._frames) >= _FLOOD
        if is_flooded:
            self.close()
            self._on_flood()

    def set_time(self, frame: bytes) -> None:
        """Add the time, in place of an earlier one that was not taken."""
        with self._lock:
            if not self._is_closed:
                self._time = frame
                self._rouse()

    def begin(self, subscription_id: int) -> int:
        """Return the number of a new subscription; a client can use the id of one that ended."""
        with self._lock:
            number = next(self._numbers)
            if not self._is_closed:
                self._ids[number] = subscription_id
            return number

    def put(self, number: int, time_ns: int, cdr: bytes) -> None:
        """Add a message of a subscription; nothing happens if the subscription has ended."""
        with self._lock:
            if number not in self._ids:
                return
            self._count += 1
            queue = self._messages.setdefault(number, deque())
            queue.append(_Message(self._count, time_ns, cdr))
            self._resize(number, len(cdr))
            lost = self._shrink() if self._bytes > self._limit else []
            self._rouse()
        for subscription_id in lost:
            self._on_loss(subscription_id)

    def end(self, number: int) -> None:
        """Drop the messages of a subscription that has ended, later ones too."""
        with self._lock:
            self._ids.pop(number, None)
            self._messages.pop(number, None)
            self._bytes -= self._sizes.pop(number, 0)
            self._losing.discard(number)

    def take(self) -> str | bytes | None:
        """Return the next frame; None if no frame waits, and `wake` is called for the next one."""
        with self._lock:
            if self._frames:
                frame = self._frames.popleft()
                self._frame_bytes -= len(frame)
                return frame
            if self._time is not None:
                time, self._time = self._time, None
                return time
            if not self._messages:
                self._is_idle = True
                return None
            number = min(self._messages, key=lambda each: self._messages[each][0].number)
            message = self._pop(number)
            subscription_id = self._ids[number]
        return message_data(subscription_id, message.time_ns, message.cdr)

    def close(self) -> None:
        """Drop everything, now and from now on."""
        with self._lock:
            self._is_closed = True
            self._frames.clear()
            self._frame_bytes = self._bytes = 0
            self._time = None
            self._ids.clear()
            self._messages.clear()
            self._sizes.clear()

    def _rouse(self) -> None:
        if self._is_idle:
            self._is_idle = False
            self._wake()

    def _shrink(self) -> list[int]:
        """Drop old messages; return the ids of subscriptions that lose for the first time."""
        lost = []
        while self._bytes > self._limit:
            droppable = [number for number, queue in self._messages.items() if len(queue) > 1]
            if not droppable:
                break
            number = max(droppable, key=self._sizes.__getitem__)
            self._pop(number)
            if number not in self._losing:
                self._losing.add(number)
                lost.append(self._ids[number])
        return lost

    def _pop(self, number: int) -> _Message:
        queue = self._messages[number]
        message = queue.popleft()
        if not queue:
            del self._messages[number]
        self._resize(number, -len(message.cdr))
        return message

    def _resize(self, number: int, change: int) -> None:
        self._sizes[number] = self._sizes.get(number, 0) + change
        self._bytes += change
