"""Subscriptions, also those whose messages go to a native sink, in batches."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING

import zenoh
from zenoh import ext
from zenoh.handlers import FifoChannel

from turtlewire.guarded import call_guarded
from turtlewire.wire.base import EventKind, EventStatus, MessageInfo, Subscription
from turtlewire.wire.encapsulation import HEADER_SIZE
from turtlewire.wire.qos import Durability, History, Reliability
from turtlewire.wire.queue_wait_set import Queued
from turtlewire.wire.reader_thread import deliver
from turtlewire.wire.report import warn_once

from .endpoint import ZenohEndpoint
from .protocol import SUBSCRIPTION, Attachment

if TYPE_CHECKING:
    from typing import Any

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS
    from turtlewire.wire.queue_wait_set import Watcher

    from .context_state import Owner, ZenohContextState
    from .endpoint import Declared
    from .protocol import Token

    OnMessage = Callable[[bytes, MessageInfo], None]
    from turtlewire.wire.base import Sink


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

    def publisher_count(self) -> int:
        return len(self.partners)

    def _close(self) -> None:
        super()._close()
        self.leave_watchers()
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


#: Maximum number of messages in the channel; then Zenoh receives no more from their sender.
_CAPACITY = 1000


class ZenohSinkSubscription(ZenohSubscription):
    """A subscriber with a channel, which a thread empties into a sink.

    Whatever waits in the channel goes over in one native call, so a busy main thread, which lets
    this thread run every 5 ms, holds up a batch and not each message.

    The library's ``recv()`` wakes an idle thread several times a second (6.6 times in one
    measurement), and we found no option against it. Its callbacks do not, but need the GIL for each
    message.
    """

    def __init__(
        self,
        core: ZenohContextState,
        node: Owner,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: OnMessage | None,
        sink: Sink,
    ) -> None:
        from turtlewire._native import ZenohInlet

        self._sink = sink  # for which native code has no reference
        self._native = ZenohInlet(sink)
        self._receiving = threading.Lock()
        self._is_left = False
        super().__init__(core, node, topic, type_id, qos, on_message)

    def _subscribe(self) -> Declared:
        subscriber = self._declare(FifoChannel(_CAPACITY))
        channel: Any = subscriber.handler  # type: ignore[attr-defined]
        self._core.threads.start(lambda: self._receive(channel), "turtlewire-intake")
        return subscriber

    def _receive(self, channel: Any) -> None:
        """Empty the channel until the subscriber is taken back; on its own thread."""
        try:
            while True:
                batch = [channel.recv()]
                while len(batch) < _CAPACITY and (sample := channel.try_recv()) is not None:
                    batch.append(sample)
                call_guarded(self._hand_over, batch)
        except zenoh.ZError:  # the channel is closed
            return

    def _hand_over(self, batch: list[zenoh.Sample]) -> None:
        with self._receiving:  # so that nothing comes after close()
            if self._closed:
                return
            is_left, lost, refused = self._native.receive(batch)
        if lost or is_left:
            with self._lock:
                if lost:
                    self._report_lost(lost)
                if is_left and not self._closed:
                    self._is_left = True
                    self._tell()
        for sample in refused:
            self._warn_of_loss(sample)

    def _deliver(self) -> None:
        """Serve the sink, and hand over what it leaves; on the reader thread."""
        assert self._on_message is not None
        with self._lock:
            self._is_delivering = False
        while not self._closed and (messages := self._serve()):
            deliver(messages, self._on_message, lambda: self._closed)

    def _serve(self) -> list[tuple[bytes, MessageInfo]]:
        gid_of = self._native.gid_of
        left = self._sink.serve(gid_of)
        now = time.time_ns()
        return [
            (data, MessageInfo(sent, now, gid_of(publisher) or publisher.to_bytes(16, "little")))
            for data, publisher, sent in left
        ]

    def part(self, partner: Token) -> None:
        super().part(partner)
        self._native.forget(partner.gid)

    @property
    def is_waiting(self) -> bool:
        """True if the sink needs service."""
        return self._is_left

    def take(self, limit: int = 32) -> list[tuple[bytes, MessageInfo]]:  # noqa: ARG002 - all
        """Take the messages that the sink leaves."""
        with self._lock:
            self._is_left = False  # what comes from now on sets it again
        messages = self._serve()
        if messages:  # there may be more: the sink is served until it leaves nothing
            with self._lock:
                self._is_left = True
        return messages

    def _close(self) -> None:
        super()._close()
        with self._receiving:  # the sink gets nothing more when this returns
            return
