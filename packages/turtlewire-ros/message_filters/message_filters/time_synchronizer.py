"""Combines messages of several topics by their stamps."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from itertools import product
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.logging import get_logger
from turtlewire.distro import KILTED, since

from .simple_filter import SimpleFilter
from .stamps import stamp_of

_LOGGER = get_logger("message_filters_synchronizer")


class TimeSynchronizer(SimpleFilter):
    """Passes on one message of each filter when they all have exactly the same stamp. Thread-safe.

    A callback gets as many messages as there are filters, in their order.

    Args:
        fs: The filters.
        queue_size: How many messages of each filter may wait for their partners; then the one that
            has waited longest is dropped.

    Attributes:
        queues: The waiting messages of each filter, by stamp [ns], offsets subtracted.
    """

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.lock = threading.Lock()
        self._inputs: list[SimpleFilter] = []
        self.input_connections: list[int] = []
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:  # noqa: N802 -- ROS 2's name
        """Listen to these filters only, and drop the waiting messages."""
        for former, number in zip(self._inputs, self.input_connections, strict=True):
            former.unregisterCallback(number)
        self._inputs = list(fs)
        self.queues: list[dict[int, Any]] = [{} for _ in fs]
        self.input_connections = [
            f.registerCallback(self.add, queue, index)
            for index, (f, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(
        self,
        msg: Any,
        my_queue: dict[int, Any],
        my_queue_index: int | None = None,  # noqa: ARG002 -- the subclass needs it
    ) -> None:
        """Store a message of one filter, and pass on the set that it completes."""
        stamp = stamp_of(msg, allow_headerless=False, logger=_LOGGER)
        if stamp is None:
            return
        with self.lock:
            self._keep(msg, stamp.nanoseconds, my_queue)
            common = set.intersection(*(set(queue) for queue in self.queues))
            sets = [[queue.pop(stamp) for queue in self.queues] for stamp in sorted(common)]
        # Outside the lock, because callbacks may take long or add messages.
        for messages in sets:
            self.signalMessage(*messages)

    def _keep(self, msg: Any, stamp_ns: int, queue: dict[int, Any]) -> None:
        # Removed first, so that the stamp moves to the end of the queue.
        queue.pop(stamp_ns, None)
        queue[stamp_ns] = msg
        while len(queue) > self.queue_size:
            # By arrival: after a clock has jumped back, older messages have newer stamps.
            del queue[next(iter(queue))]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on one message of each filter when their stamps are close together. Thread-safe.

    Args:
        fs: The filters.
        queue_size: How many messages of each filter may wait for their partners; then the one that
            has waited longest is dropped.
        slop: The stamps of a set differ by less than this [s].
        allow_headerless: Accept messages without a stamp, with the time of their arrival. In Jazzy
            this is the fourth argument; from Kilted on, ``queue_offset`` is.
        queue_offset: For each filter, what is subtracted from its stamps [ns]; False: nothing.
        sync_arrival_time: Take the times of arrival instead of the stamps.

    Raises:
        TypeError: The fourth argument is the one of another distribution.
        ValueError: The number of offsets is not the number of filters.
    """

    if not since(KILTED):

        def __init__(
            self,
            fs: Sequence[SimpleFilter],
            queue_size: int,
            slop: float,
            allow_headerless: bool = False,
            queue_offset: Sequence[int] | bool | None = False,
            sync_arrival_time: bool = False,
        ) -> None:
            self._set_options(len(fs), slop, queue_offset, allow_headerless, sync_arrival_time)
            super().__init__(fs, queue_size)

    else:

        def __init__(  # type: ignore[misc]  # the fourth argument is another one
            self,
            fs: Sequence[SimpleFilter],
            queue_size: int,
            slop: float,
            queue_offset: Sequence[int] | bool | None = False,
            allow_headerless: bool = False,
            sync_arrival_time: bool = False,
        ) -> None:
            self._set_options(len(fs), slop, queue_offset, allow_headerless, sync_arrival_time)
            super().__init__(fs, queue_size)

    def _set_options(
        self,
        filters: int,
        slop: float,
        queue_offset: Sequence[int] | bool | None,
        allow_headerless: bool,
        sync_arrival_time: bool,
    ) -> None:
        """Store the options; before the filters are connected, whose messages need them."""
        if queue_offset is None or isinstance(queue_offset, int):
            if queue_offset:
                raise TypeError(
                    "queue_offset is a list of nanoseconds, one for each filter, not "
                    f"{queue_offset!r}. From Kilted on it is the fourth argument: write "
                    "allow_headerless=True"
                )
            queue_offset = [0] * filters
        if hasattr(allow_headerless, "__len__"):
            raise TypeError(
                f"allow_headerless is True or False, not {allow_headerless!r}. In Jazzy it is the "
                f"fourth argument: write queue_offset={allow_headerless!r}"
            )
        self.queue_offset = list(queue_offset)
        if len(self.queue_offset) != filters:
            raise ValueError(
                f"queue_offset has {len(self.queue_offset)} offsets for {filters} filters; it "
                "needs one for each"
            )
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless
        self.sync_arrival_time = sync_arrival_time

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Store a message of one filter, and pass on the closest set that it completes.

        Args:
            msg: The message.
            my_queue: The queue of the filter, one of :attr:`queues`.
            my_queue_index: The index of the filter; without it no offset is subtracted.
        """
        stamp = (
            Clock(clock_type=ClockType.ROS_TIME).now()
            if self.sync_arrival_time
            else stamp_of(msg, allow_headerless=self.allow_headerless, logger=_LOGGER)
        )
        if stamp is None:
            return
        offset_ns = 0 if my_queue_index is None else self.queue_offset[my_queue_index]
        stamp_ns = stamp.nanoseconds - offset_ns
        with self.lock:
            self._keep(msg, stamp_ns, my_queue)
            found = self._closest_set(stamp_ns, my_queue_index)
            messages = [
                queue.pop(each) for queue, each in zip(self.queues, found or (), strict=False)
            ]
        if found is not None:
            self.signalMessage(*messages)

    def _closest_set(self, stamp_ns: int, index: int | None) -> tuple[int, ...] | None:
        """Return a stamp of each queue, all within the slop of the new message's stamp, or None."""
        slop_ns = self.slop.nanoseconds
        candidates = []
        for number, queue in enumerate(self.queues):
            near = (
                [stamp_ns]
                if number == index
                else sorted(queue, key=lambda other: abs(other - stamp_ns))
            )
            candidates.append(
                [other for other in near if other in queue and abs(other - stamp_ns) <= slop_ns]
            )
        # As in ROS 2, the first set that fits; each filter's candidates come nearest first.
        for stamps in product(*candidates):
            if max(stamps) - min(stamps) < slop_ns:
                return stamps
        return None
