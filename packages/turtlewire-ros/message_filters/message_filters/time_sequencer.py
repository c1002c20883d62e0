"""Passes messages on in the order of their stamps."""

from __future__ import annotations

import threading
from bisect import insort_right
from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Any

from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.time import Time

from .simple_filter import SimpleFilter
from .stamps import nanoseconds

if TYPE_CHECKING:
    from rclpy.clock import TimeJump
    from rclpy.node import Node

_JUMP_BACK = JumpThreshold(min_forward=None, min_backward=Duration(nanoseconds=-1))


class TimeSequencer(SimpleFilter):
    """Holds messages until their stamps are older than a delay, and passes them on by stamp.

    A message that is older than one that was passed on is dropped. When the node's clock jumps
    back, the waiting messages are dropped, and older stamps pass again. Callbacks run on the node's
    executor. Thread-safe.

    Args:
        input_filter: The filter to listen to; None if you :meth:`add` messages yourself.
        delay: How long after its stamp a message is passed on [s]; the node's clock measures it.
        update_rate: The time between two checks of the waiting messages [s].
        queue_size: How many messages may wait; then the one with the oldest stamp is dropped. 0
            sets no limit.
        node: Its executor runs the callbacks.
        msg_stamp_attr: Where a message has its stamp: attributes with dots between them.

    Raises:
        ValueError: The update rate is not above 0.
    """

    def __init__(
        self,
        input_filter: SimpleFilter | None,
        delay: Duration | float,
        update_rate: Duration | float,
        queue_size: int,
        node: Node,
        msg_stamp_attr: str = "header.stamp",
    ) -> None:
        super().__init__()
        period_s = nanoseconds(update_rate) / 1e9
        if period_s <= 0.0:
            raise ValueError(
                "update_rate is the time between two checks of the waiting messages, in seconds or "
                f"as a Duration; it must be above 0, not {period_s:g}"
            )
        self._delay_ns = nanoseconds(delay)
        self._queue_size = queue_size
        self._stamp_path = msg_stamp_attr
        self._lock = threading.Lock()
        self._waiting: list[tuple[int, Any]] = []
        self._last_ns: int | None = None
        self._input: tuple[SimpleFilter, int] | None = None
        self._node = node
        self._clock = node.get_clock()
        self._jumps = self._clock.create_jump_callback(_JUMP_BACK, post_callback=self._restart)
        self._timer = node.create_timer(period_s, self._dispatch)
        if input_filter is not None:
            self.connectInput(input_filter)

    def connectInput(self, input_filter: SimpleFilter) -> None:  # noqa: N802 -- ROS 2's name
        """Listen to a filter, instead of the one before."""
        self._disconnect()
        self._input = input_filter, input_filter.registerCallback(self.add)

    def add(self, message: Any) -> None:
        """Keep a message until its time, or drop it if it comes too late.

        Raises:
            AttributeError: The message has no stamp where ``msg_stamp_attr`` says.
        """
        stamp_ns = self._stamp_ns(message)
        with self._lock:
            if self._last_ns is not None and stamp_ns < self._last_ns:
                return
            # Behind equal stamps, so that these stay in the order of their arrival.
            insort_right(self._waiting, (stamp_ns, message), key=itemgetter(0))
            if self._queue_size and len(self._waiting) > self._queue_size:
                del self._waiting[0]

    def shutdown(self) -> None:
        """Stop permanently: end the timer and the connection, and drop the waiting messages."""
        self._disconnect()
        self._node.destroy_timer(self._timer)
        self._jumps.unregister()
        with self._lock:
            self._waiting.clear()

    def _disconnect(self) -> None:
        if self._input is not None:
            former, number = self._input
            former.unregisterCallback(number)
            self._input = None

    def _stamp_ns(self, message: Any) -> int:
        try:
            stamp = attrgetter(self._stamp_path)(message)
        except AttributeError as error:
            raise AttributeError(
                f"{type(message).__name__} has no {self._stamp_path}: name the attribute of its "
                "stamp in msg_stamp_attr"
            ) from error
        return (stamp if hasattr(stamp, "nanoseconds") else Time.from_msg(stamp)).nanoseconds

    def _dispatch(self) -> None:
        """Pass on the messages whose time has come."""
        newest_ns = self._clock.now().nanoseconds - self._delay_ns
        with self._lock:
            due = [each for each in self._waiting if each[0] <= newest_ns]
            if due:
                del self._waiting[: len(due)]
                self._last_ns = due[-1][0]
        # Outside the lock, because callbacks may take long or add messages.
        for _, message in due:
            self.signalMessage(message)

    def _restart(self, _jump: TimeJump) -> None:
        """Drop the waiting messages, and accept older stamps again."""
        with self._lock:
            self._waiting.clear()
            self._last_ns = None
