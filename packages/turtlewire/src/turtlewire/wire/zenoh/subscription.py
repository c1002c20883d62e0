"""Subscriptions."""

from __future__ import annotations

import time
from collections import deque
from typing import TYPE_CHECKING

from zenoh import ext

from turtlewire.wire.base import EventKind, EventStatus, MessageInfo, Subscription
from turtlewire.wire.delivery import deliver
from turtlewire.wire.encapsulation import HEADER_SIZE
from turtlewire.wire.qos import Durability, History, Reliability
from turtlewire.wire.queue_wait_set import Queued
from turtlewire.wire.report import warn_once

from .attachment import Attachment
from .endpoint import ZenohEndpoint
from .token import SUBSCRIPTION

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    import zenoh

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS
    from turtlewire.wire.queue_wait_set import Watcher

    from .context_state import Owner, ZenohContextState
    from .endpoint import Declared
    from .token import Token

    OnMessage = Callable[[bytes, MessageInfo], None]

__all__ = ["ZenohSubscription"]


class ZenohSubscription(ZenohEndpoint, Queued, Subscription):
    """A subscriber that queues on its own thread, which the library makes.

    Queuing on Zenoh's receiving thread would stop the whole link while another thread computes.
    """

    KIND = SUBSCRIPTION
    # The last two never happen, as in rmw_zenoh_cpp.
    EVENTS = ZenohEndpoint.EVENTS | {
        EventKind.MESSAGE_LOST,
        EventKind.DEADLINE_MISSED,
        EventKind.LIVELINESS_CHANGED,
    }

    def __init__(
        self,
        core: ZenohContextState,
        node: Owner,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: OnMessage | None = None,
    ) -> None:
        super().__init__(core, node, topic, type_id, qos)
        self.watchers: dict[Watcher, Callable[[], None]] = {}
        keep_all = self.qos.history == History.KEEP_ALL
        self._queue: deque[tuple[bytes, MessageInfo]] = deque(
            maxlen=None if keep_all else self.qos.depth
        )
        self._on_message = on_message
        self._is_delivering = False
        self._last_numbers: dict[bytes, int] = {}
        self._lost_count = 0
        with core.calls:
            subscriber = self._subscribe()
        self.announce(subscriber)

    def _subscribe(self) -> Declared:
        """Begin to receive, on a new thread."""
        return self._core.threads.declare(self._on_sample, self._declare)

    def _declare(self, handler: Any) -> Declared:
        if self.qos.durability != Durability.TRANSIENT_LOCAL:
            # Not an advanced one, as rmw_zenoh has it: without its own sequence numbers, it
            # drops what is older than the last message of the same session, so publishers of two
            # threads lose messages. On the wire both are the same.
            return self._core.session.declare_subscriber(self.token.data_key, handler)
        options: dict[str, Any] = {}
        if self.qos.reliability == Reliability.RELIABLE:
            options["recovery"] = ext.RecoveryConfig(heartbeat=True, periodic_queries=None)
        return ext.declare_advanced_subscriber(
            self._core.session,
            self.token.data_key,
            handler,
            subscriber_detection=True,
            history=ext.HistoryConfig(detect_late_publishers=True, max_samples=self.qos.depth),
            **options,
        )

    def _on_sample(self, sample: zenoh.Sample) -> None:
        """Queue the message; runs on the subscription's own thread."""
        try:
            attachment, cdr = _read(sample)
        except ValueError:
            self._warn_of_loss(sample)
            return
        info = MessageInfo(
            attachment.source_timestamp_ns,
            time.time_ns(),
            attachment.gid,
            attachment.sequence_number,
        )
        with self._lock:
            if not self._closed:
                self._count_lost(attachment)
                self._queue.append((cdr, info))
                self._tell()

    def _warn_of_loss(self, sample: zenoh.Sample) -> None:
        """Log why a sample is not a message."""
        try:
            _read(sample)
        except ValueError as error:
            warn_once(f"lost {self.topic}", f"a message on {self.topic} was lost: {error}")

    def _count_lost(self, attachment: Attachment) -> None:
        number, gid = attachment.sequence_number, attachment.gid
        missing = number - self._last_numbers.get(gid, number - 1) - 1
        self._last_numbers[gid] = number
        if missing > 0:
            self._report_lost(missing)

    def _report_lost(self, missing: int) -> None:
        """Report lost messages; call with the lock held."""
        self._lost_count += missing
        self._event(EventKind.MESSAGE_LOST).add(EventStatus(self._lost_count, missing))

    def _tell(self) -> None:
        """Wake the threads that wait for the message; called with the lock held."""
        if self._on_message is not None and not self._is_delivering:
            self._is_delivering = True
            self._core.reader.submit(self._deliver)
        self.tell_watchers()

    def _deliver(self) -> None:
        """Hand over all waiting messages; on the reader thread."""
        assert self._on_message is not None
        with self._lock:
            self._is_delivering = False
            messages = list(self._queue)
            self._queue.clear()
        deliver(messages, self._on_message, lambda: self._closed)

    def part(self, partner: Token) -> None:
        super().part(partner)
        self._last_numbers.pop(partner.gid, None)

    @property
    def is_waiting(self) -> bool:
        """True if messages are waiting."""
        return bool(self._queue)

    def take(self, limit: int = 32) -> list[tuple[bytes, MessageInfo]]:
        with self._lock:
            return [self._queue.popleft() for _ in range(min(limit, len(self._queue)))]

    def publisher_count(self) -> int:
        return len(self.partners)

    def close(self) -> None:
        super().close()
        for watcher in list(self.watchers):
            watcher.detach(self)
        with self._lock:
            self._queue.clear()


def _read(sample: zenoh.Sample) -> tuple[Attachment, bytes]:
    """Return a message's attachment and its bytes.

    Raises:
        ValueError: The sample is not a message of rmw_zenoh_cpp's protocol.
    """
    if sample.attachment is None:
        raise ValueError(
            "it has no attachment, so its publisher does not speak rmw_zenoh_cpp's protocol"
        )
    attachment = Attachment.unpack(bytes(sample.attachment))
    cdr = bytes(sample.payload)
    if len(cdr) <= HEADER_SIZE:
        raise ValueError(f"{len(cdr)} bytes are not a message")
    return attachment, cdr
