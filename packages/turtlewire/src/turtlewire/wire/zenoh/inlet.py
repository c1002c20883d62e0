"""Subscriptions whose messages go to a native sink, in batches."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

import zenoh
from zenoh.handlers import FifoChannel

from turtlewire.guarded import call_guarded
from turtlewire.wire.base import MessageInfo
from turtlewire.wire.delivery import deliver

from .subscription import ZenohSubscription

if TYPE_CHECKING:
    from typing import Any

    from turtlewire.wire.base import Sink, TypeId
    from turtlewire.wire.qos import QoS

    from .context_state import Owner, ZenohContextState
    from .endpoint import Declared
    from .subscription import OnMessage
    from .token import Token

__all__ = ["ZenohSinkSubscription"]

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

    def close(self) -> None:
        super().close()
        with self._receiving:  # the sink gets nothing more when this returns
            return
