"""Passes the messages of several inputs on in the order of their stamps."""

from __future__ import annotations

import threading
from bisect import insort_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import TYPE_CHECKING, Any

from rclpy.time import Time

from .simple_filter import SimpleFilter
from .stamps import nanoseconds

if TYPE_CHECKING:
    from rclpy.duration import Duration
    from rclpy.node import Node
    from rclpy.timer import Timer


@dataclass
class QueueStatus:
    """The state of one input of an :class:`InputAligner`.

    Attributes:
        active: True if other inputs wait for its messages: one has arrived, and the next is not
            overdue.
        queue_size: How many messages wait.
        msgs_processed: How many were passed on.
        msgs_dropped: How many came after later ones had been passed on.
    """

    active: bool
    queue_size: int
    msgs_processed: int
    msgs_dropped: int


class _Input:
    """The waiting messages of one input, by stamp."""

    def __init__(self) -> None:
        self.output = SimpleFilter()
        self.waiting: list[tuple[int, Any]] = []
        self.period_ns = 0
        self.last_ns = 0
        self.status = QueueStatus(False, 0, 0, 0)

    def misses_one_before(self, stamp_ns: int) -> bool:
        """Return True if a message up to a stamp may still arrive."""
        is_due = self.last_ns + self.period_ns <= stamp_ns
        return self.status.active and not self.waiting and is_due


class InputAligner:
    """Passes the messages of several inputs on, one after the other, in the order of their stamps.

    A message waits while an earlier one may come from another input: until the inputs have given
    later messages, or are not due by their periods, or the timeout is over. An input that has had
    no message yet holds nothing up. A message that is earlier than one that was passed on is
    dropped. Messages are passed on in :meth:`dispatchMessages` only, which a timer may call.
    Thread-safe.

    Args:
        timeout: How much later than a waiting message the newest one may be, before the message no
            longer waits for other inputs, as a Duration or in seconds.
        filters: The inputs; None if you :meth:`add` messages yourself.
    """

    def __init__(
        self, timeout: Duration | float, filters: Sequence[SimpleFilter] | None = None
    ) -> None:
        self._timeout_ns = nanoseconds(timeout)
        self._name = ""
        self._lock = threading.Lock()
        self._inputs: dict[int, _Input] = {}
        self._newest_ns = 0
        self._passed_ns: int | None = None
        self._connections: list[tuple[SimpleFilter, int]] = []
        self._timer: Timer | None = None
        self._node: Node | None = None
        if filters is not None:
            self.connectInput(filters)

    def connectInput(self, filters: Sequence[SimpleFilter]) -> None:  # noqa: N802 -- ROS 2's name
        """Listen to filters, instead of those before; their order gives the indices."""
        self.disconnectAll()
        for index, each in enumerate(filters):
            self._connections.append((each, each.registerCallback(self.add, index)))

    def disconnectAll(self) -> None:  # noqa: N802 -- ROS 2's name
        """Stop listening to all filters; messages that wait are kept."""
        for each, number in self._connections:
            each.unregisterCallback(number)
        self._connections.clear()

    def registerCallback(  # noqa: N802 -- ROS 2's name
        self, index: int, callback: Callable[..., Any], *args: Any
    ) -> int:
        """Call ``callback(message, *args)`` for each message of an input.

        Returns:
            The number of the callback.

        Raises:
            IndexError: The index is negative.
        """
        return self._input(index).output.registerCallback(callback, *args)

    def setName(self, name: str) -> None:  # noqa: N802 -- ROS 2's name
        """Name the aligner."""
        self._name = name

    def getName(self) -> str:  # noqa: N802 -- ROS 2's name
        """Return its name; empty if it has none."""
        return self._name

    def setInputPeriod(self, index: int, period: Duration | float) -> None:  # noqa: N802
        """Say how much time there is between the stamps of an input.

        Messages of other inputs then wait for it only when its next message is due.

        Args:
            index: The number of the input.
            period: As a Duration or in seconds; 0: unknown.

        Raises:
            IndexError: The index is negative.
        """
        self._input(index).period_ns = nanoseconds(period)

    def setupDispatchTimer(  # noqa: N802 -- ROS 2's name
        self, node: Node, update_rate: Duration | float
    ) -> None:
        """Call :meth:`dispatchMessages` by a timer of a node, instead of the one before.

        Args:
            node: Its executor runs the callbacks.
            update_rate: The time between two calls, as a Duration or in seconds.

        Raises:
            ValueError: The time is not above 0.
        """
        period_s = nanoseconds(update_rate) / 1e9
        if period_s <= 0.0:
            raise ValueError(
                "update_rate is the time between two calls, in seconds or as a Duration; it must "
                f"be above 0, not {period_s:g}"
            )
        if self._node is not None and self._timer is not None:
            self._node.destroy_timer(self._timer)
        self._node, self._timer = node, node.create_timer(period_s, self.dispatchMessages)

    def getQueueStatus(self, index: int) -> QueueStatus:  # noqa: N802 -- ROS 2's name
        """Return the state of an input.

        Raises:
            IndexError: The index is negative.
        """
        queue = self._input(index)
        with self._lock:
            status = queue.status
            return QueueStatus(
                status.active, len(queue.waiting), status.msgs_processed, status.msgs_dropped
            )

    def add(self, msg: Any, queue_index: int) -> None:
        """Keep a message of an input until its turn, or drop it if it comes too late.

        Raises:
            AttributeError: The message has no ``header.stamp``.
            IndexError: The index is negative.
        """
        stamp_ns = Time.from_msg(msg.header.stamp).nanoseconds
        queue = self._input(queue_index)
        with self._lock:
            queue.status.active = True
            queue.last_ns = max(queue.last_ns, stamp_ns)
            self._newest_ns = max(self._newest_ns, stamp_ns)
            if self._passed_ns is not None and stamp_ns < self._passed_ns:
                queue.status.msgs_dropped += 1
                return
            # Behind equal stamps, so that these stay in the order of their arrival.
            insort_right(queue.waiting, (stamp_ns, msg), key=itemgetter(0))

    def dispatchMessages(self) -> None:  # noqa: N802 -- ROS 2's name
        """Pass on the messages that need not wait any longer."""
        while True:
            with self._lock:
                found = self._next()
            if found is None:
                return
            # Outside the lock, because callbacks may take long or add messages.
            queue, message = found
            queue.output.signalMessage(message)

    def _next(self) -> tuple[_Input, Any] | None:
        """Take the earliest message; None if no message waits, or if it waits for another input."""
        queues = [queue for _, queue in sorted(self._inputs.items()) if queue.waiting]
        if not queues:
            return None
        queue = min(queues, key=lambda each: each.waiting[0][0])
        stamp_ns, message = queue.waiting[0]
        late = [each for each in self._inputs.values() if each.misses_one_before(stamp_ns)]
        if late and self._newest_ns - stamp_ns <= self._timeout_ns:
            return None
        for each in late:
            each.status.active = False  # until its next message
        del queue.waiting[0]
        queue.status.msgs_processed += 1
        self._passed_ns = stamp_ns
        return queue, message

    def _input(self, index: int) -> _Input:
        if index < 0:
            raise IndexError(f"inputs are counted from 0; there is no input {index}")
        with self._lock:
            return self._inputs.setdefault(index, _Input())
