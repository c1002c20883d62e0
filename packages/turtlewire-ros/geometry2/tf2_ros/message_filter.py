"""Holds messages back until they can be transformed."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterable
from enum import IntEnum
from typing import TYPE_CHECKING, Any

from message_filters import SimpleFilter
from tf2_py.messages import to_moment
from turtlewire.errors import TransformException

from .buffer import JUMP_BACK

if TYPE_CHECKING:
    from rclpy.clock import TimeJump
    from rclpy.duration import Duration
    from rclpy.node import Node

    from .buffer import Buffer


class FilterFailureReason(IntEnum):
    """The reason for which a message was dropped."""

    Unknown = 0
    """The clock has jumped back, and the message belongs to another time."""
    OutTheBack = 1
    """It is older than the buffer's samples."""
    EmptyFrameID = 2
    """Its header names no frame."""
    NoTransformFound = 3
    """The transform did not come within the timeout."""
    QueueFull = 4
    """Too many messages waited."""


class _Waiting:
    """A waiting message; compared by identity, because two messages may be equal.

    As in every question of tf2, stamp 0 means the latest transform: here None.
    """

    __slots__ = ("deadline_ns", "message", "source", "stamp_ns")

    def __init__(self, message: Any, source: str, deadline_ns: int | None) -> None:
        self.message = message
        self.source = source
        self.stamp_ns = to_moment(message.header.stamp)
        self.deadline_ns = deadline_ns


class MessageFilter(SimpleFilter):
    """Passes messages on as soon as they can be transformed into the target frames.

    A message that can no longer be transformed is dropped. Callbacks run on the node's executor, or
    inside :meth:`add` if the transform is known already. Nothing is polled.

    Args:
        f: The filter to listen to, a ``message_filters.Subscriber`` for example; None if you
            :meth:`add` messages yourself.
        buffer: The buffer that receives the transforms.
        target_frame: The frame, or the frames, that a message will be transformed into.
        queue_size: How many messages may wait; then the oldest is dropped. 0 sets no limit.
        node: Its executor runs the callbacks, and its clock measures the timeout.
        tolerance: The transform must be known at the stamp, and also this much later.
        timeout: How long a message waits; None sets no limit.
    """

    def __init__(
        self,
        f: SimpleFilter | None,
        buffer: Buffer,
        target_frame: str | Iterable[str],
        queue_size: int,
        node: Node,
        *,
        tolerance: Duration | None = None,
        timeout: Duration | None = None,
    ) -> None:
        super().__init__()
        self._engine = buffer.engine
        self._node = node
        self._lock = threading.Lock()
        self._waiting: deque[_Waiting] = deque()
        self._failure_callbacks: list[Callable[[Any, FilterFailureReason], Any]] = []
        self._queue_size = queue_size
        self._tolerance_ns = 0 if tolerance is None else tolerance.nanoseconds
        self._timeout_ns = None if timeout is None else timeout.nanoseconds
        self._ready = node.create_guard_condition(self._deliver)
        self.setTargetFrames([target_frame] if isinstance(target_frame, str) else target_frame)
        self._timer = (
            None
            if timeout is None
            else node.create_timer(timeout.nanoseconds / 1e9, self._expire, autostart=False)
        )
        self._stop_listening: Callable[[], None] | None = self._engine.on_change(self._on_data)
        self._jumps = node.get_clock().create_jump_callback(JUMP_BACK, post_callback=self._on_jump)
        self._on_destroy: Callable[[MessageFilter], None] | None = None
        # The node holds the filter, which then works without any other reference to it.
        node._rclpy_endpoints.keep(self)
        if f is not None:
            self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:  # noqa: N802 -- as in C++
        """Listen to a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def registerFailureCallback(  # noqa: N802 -- as in C++
        self, cb: Callable[[Any, FilterFailureReason], Any]
    ) -> None:
        """Call ``cb(message, reason)`` for each message that is dropped."""
        self._failure_callbacks.append(cb)

    def setTargetFrame(self, target_frame: str) -> None:  # noqa: N802 -- as in C++
        """Wait for another frame, also with the messages that wait already."""
        self.setTargetFrames([target_frame])

    def setTargetFrames(self, target_frames: Iterable[str]) -> None:  # noqa: N802 -- as in C++
        """Wait for other frames, also with the messages that wait already."""
        # As in C++, the leading slash of ROS 1 is removed.
        self._targets = tuple(frame.removeprefix("/") for frame in target_frames)
        self._ready.trigger()

    def getTargetFramesString(self) -> str:  # noqa: N802 -- as in C++
        """Return the target frames in one line."""
        return " ".join(self._targets)

    def setTolerance(self, tolerance: Duration) -> None:  # noqa: N802 -- as in C++
        """Require the transform at the stamp and this much later."""
        self._tolerance_ns = tolerance.nanoseconds

    def setQueueSize(self, queue_size: int) -> None:  # noqa: N802 -- as in C++
        """Set how many messages may wait."""
        self._queue_size = queue_size

    def getQueueSize(self) -> int:  # noqa: N802 -- as in C++
        """Return the largest number of waiting messages."""
        return self._queue_size

    def clear(self) -> None:
        """Drop the waiting messages without calling failure callbacks."""
        with self._lock:
            self._waiting.clear()

    def add(self, message: Any) -> None:
        """Take a message with a header: pass it on, keep it for later, or drop it."""
        source = message.header.frame_id.removeprefix("/")
        if not source:
            self._fail(message, FilterFailureReason.EmptyFrameID)
            return
        deadline = (
            None
            if self._timeout_ns is None
            else self._node.get_clock().now().nanoseconds + self._timeout_ns
        )
        waiting = _Waiting(message, source, deadline)
        dropped = None
        with self._lock:
            self._waiting.append(waiting)
            if self._queue_size and len(self._waiting) > self._queue_size:
                dropped = self._waiting.popleft()
            elif (
                len(self._waiting) == 1 and self._timer is not None and self._timeout_ns is not None
            ):
                # The timer runs for the oldest message only.
                self._timer.timer_period_ns = self._timeout_ns
                self._timer.reset()
        # Without the lock, because the user's callbacks may add messages.
        if dropped is not None:
            self._fail(dropped.message, FilterFailureReason.QueueFull)
        self._deliver()

    def destroy(self) -> None:
        """Stop and drop the waiting messages. The node calls it when it is destroyed."""
        if self._stop_listening is None:
            return
        self._stop_listening()
        self._stop_listening = None
        self._jumps.unregister()
        self.clear()
        self._node.destroy_guard_condition(self._ready)
        if self._timer is not None:
            self._node.destroy_timer(self._timer)
        if self._on_destroy is not None:
            self._on_destroy(self)

    def _on_jump(self, _jump: TimeJump) -> None:
        """Fail the waiting messages: after a jump back no transform will come for them."""
        with self._lock:
            waiting = list(self._waiting)
            self._waiting.clear()
        for each in waiting:
            self._fail(each.message, FilterFailureReason.Unknown)

    def _on_data(self) -> None:
        """Wake the executor if a message is ready or too old; runs on the receiving thread."""
        with self._lock:
            waiting = list(self._waiting)
        # The callbacks run on the node's executor, not on the thread that received the data.
        if any(self._is_ready(each) or self._is_too_old(each) for each in waiting):
            self._ready.trigger()

    def _deliver(self) -> None:
        """Pass on the ready messages in order of arrival, and drop messages that are too old."""
        with self._lock:
            ready = [each for each in self._waiting if self._is_ready(each)]
            too_old = [
                each for each in self._waiting if each not in ready and self._is_too_old(each)
            ]
            for each in (*ready, *too_old):
                self._waiting.remove(each)
        for each in ready:
            self.signalMessage(each.message)
        for each in too_old:
            self._fail(each.message, FilterFailureReason.OutTheBack)

    def _is_ready(self, waiting: _Waiting) -> bool:
        stamp = waiting.stamp_ns
        stamps = {stamp} if stamp is None else {stamp, stamp + self._tolerance_ns}
        return all(
            self._engine.can_transform(target, waiting.source, stamp)
            for target in self._targets
            for stamp in stamps
        )

    def _is_too_old(self, waiting: _Waiting) -> bool:
        if waiting.stamp_ns is None or self._engine.cache_time_ns is None:
            return False
        oldest = waiting.stamp_ns + self._engine.cache_time_ns
        try:
            return any(
                oldest < self._engine._latest_common_time(target, waiting.source)
                for target in self._targets
            )
        except TransformException:
            return False  # a frame is not known yet

    def _expire(self) -> None:
        """Drop the messages whose time is over, and set the timer for the next one."""
        now = self._node.get_clock().now().nanoseconds
        with self._lock:
            expired = []
            # With one timeout for all, the deadlines are in order of arrival.
            while (
                self._waiting
                and self._waiting[0].deadline_ns is not None
                and self._waiting[0].deadline_ns <= now
            ):
                expired.append(self._waiting.popleft())
            assert self._timer is not None
            if self._waiting and self._waiting[0].deadline_ns is not None:
                self._timer.timer_period_ns = self._waiting[0].deadline_ns - now
                self._timer.reset()
            else:
                self._timer.cancel()
        for each in expired:
            self._fail(each.message, FilterFailureReason.NoTransformFound)

    def _fail(self, message: Any, reason: FilterFailureReason) -> None:
        for callback in list(self._failure_callbacks):
            callback(message, reason)
