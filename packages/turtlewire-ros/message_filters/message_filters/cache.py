"""Keeps the newest messages, and finds them by time."""

from __future__ import annotations

import threading
import warnings
from bisect import bisect_left, bisect_right
from collections import deque
from typing import TYPE_CHECKING, overload

from rclpy._typing import MsgT
from rclpy.logging import get_logger
from turtlewire.distro import KILTED, LYRICAL, since

from .simple_filter import OneMessageFilter
from .stamps import stamp_of

if TYPE_CHECKING:
    from rclpy.time import Time

    from .simple_filter import SimpleFilter

_LOGGER = get_logger("message_filters_cache")
_DEPRECATED_LASTEST_TIME = "Deprecated in favour of :py:classmethod:Cache.getLatestTime:."


class Cache(OneMessageFilter[MsgT]):
    """Keeps the last messages of a filter, ordered by stamp, and passes them on. Thread-safe.

    Args:
        f: The filter to listen to; None if you :meth:`add` messages yourself.
        cache_size: How many messages are kept.
        allow_headerless: Accept messages without a stamp, with the time of their arrival.
    """

    @overload
    def __init__(
        self, f: OneMessageFilter[MsgT], cache_size: int = 1, allow_headerless: bool = False
    ) -> None: ...

    @overload
    def __init__(
        self, f: SimpleFilter | None = None, cache_size: int = 1, allow_headerless: bool = False
    ) -> None: ...

    def __init__(
        self, f: SimpleFilter | None = None, cache_size: int = 1, allow_headerless: bool = False
    ) -> None:
        super().__init__()
        self._lock = threading.Lock()
        self.cache_msgs: list[MsgT] = []
        self.cache_times: list[Time] = []
        self._arrived: deque[Time] = deque()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        if f is not None:
            self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:  # noqa: N802 -- ROS 2's name
        """Listen to a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: MsgT) -> None:
        """Store a message, and pass it on."""
        stamp = stamp_of(msg, allow_headerless=self.allow_headerless, logger=_LOGGER)
        if stamp is None:
            return
        with self._lock:
            # After equal stamps, so that these stay in the order of their arrival.
            place = bisect_right(self.cache_times, stamp)
            self.cache_times.insert(place, stamp)
            self.cache_msgs.insert(place, msg)
            self._arrived.append(stamp)
            if len(self._arrived) > self.cache_size:
                self._forget(self._arrived.popleft())
        # Outside the lock, because callbacks may ask this cache.
        self.signalMessage(msg)

    def _forget(self, stamp: Time) -> None:
        """Drop the message that arrived first; of equal stamps, it is the first."""
        # Not always the oldest stamp: after a clock has jumped back, earlier messages have newer
        # ones.
        place = bisect_left(self.cache_times, stamp)
        del self.cache_times[place], self.cache_msgs[place]

    def getInterval(  # noqa: N802 -- ROS 2's name
        self, from_stamp: Time, to_stamp: Time
    ) -> list[MsgT]:
        """Return the messages from one time to another, both included."""
        with self._lock:
            return self.cache_msgs[
                bisect_left(self.cache_times, from_stamp) : bisect_right(self.cache_times, to_stamp)
            ]

    def getElemAfterTime(self, stamp: Time) -> MsgT | None:  # noqa: N802 -- ROS 2's name
        """Return the oldest message that is not older than a time, or None."""
        with self._lock:
            place = bisect_left(self.cache_times, stamp)
            return self.cache_msgs[place] if place < len(self.cache_msgs) else None

    def getElemBeforeTime(self, stamp: Time) -> MsgT | None:  # noqa: N802 -- ROS 2's name
        """Return the newest message that is not newer than a time, or None."""
        with self._lock:
            place = bisect_right(self.cache_times, stamp)
            return self.cache_msgs[place - 1] if place else None

    def getLatestTime(self) -> Time | None:  # noqa: N802 -- ROS 2's name
        """Return the newest stamp, or None."""
        with self._lock:
            return self.cache_times[-1] if self.cache_times else None

    # Lyrical no longer has it.
    if not since(LYRICAL):

        def getLastestTime(self) -> Time | None:  # noqa: N802 -- ROS 2's older, misspelt name
            """Return the newest stamp, or None; deprecated since Kilted."""
            if since(KILTED):
                warnings.warn(_DEPRECATED_LASTEST_TIME, DeprecationWarning, stacklevel=2)
            return self.getLatestTime()

    def getOldestTime(self) -> Time | None:  # noqa: N802 -- ROS 2's name
        """Return the oldest stamp, or None."""
        with self._lock:
            return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> MsgT | None:  # noqa: N802 -- ROS 2's name
        """Return the newest message, or None."""
        with self._lock:
            return self.cache_msgs[-1] if self.cache_msgs else None
