"""Publishers of the in-process middleware."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire.base import MessageInfo, Publisher
from turtlewire.wire.encapsulation import joined, require_message
from turtlewire.wire.qos import Durability

from .endpoint import LocalEndpoint

if TYPE_CHECKING:
    from turtlewire.wire.encapsulation import Cdr

    from .endpoint import LocalEndpointSpec, Message
    from .node_state import LocalNodeState

__all__ = ["LocalPublisher"]


class LocalPublisher(LocalEndpoint, Publisher):
    """Hands its messages to the queues of the matching subscriptions."""

    def __init__(self, node: LocalNodeState, spec: LocalEndpointSpec) -> None:
        super().__init__(spec, node.info, node.bus.lock)
        self._core = node
        self._published = 0
        with self._lock:
            node.bus.add_publisher(self)
            node.endpoints.add(self)
        node.bus.changed()

    def publish(self, cdr: Cdr) -> None:
        cdr = joined(cdr)
        require_message(cdr, self.topic)
        now = time.time_ns()
        with self._lock:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            self._published += 1
            message = (cdr, MessageInfo(now, now, self.gid, self._published))
            if self._core.bus.tamper is None:
                self.deliver(message)
            else:
                self._core.bus.tamper(self, message)

    def deliver(self, message: Message) -> None:
        """Hand a message to the matching subscriptions; nothing happens after the end."""
        with self._lock:
            if self._closed:
                return
            if self.qos.durability == Durability.TRANSIENT_LOCAL:
                self._queue.append(message)
            for subscription in self.matched:
                subscription.receive(message)

    def kept(self) -> list[Message]:
        oldest = time.time_ns() - self.qos.lifespan_ns if self.qos.lifespan_ns else 0
        return [message for message in self._queue if message[1].source_timestamp_ns >= oldest]

    def subscription_count(self) -> int:
        return len(self.matched)

    def assert_liveliness(self) -> None:
        """Do nothing: publishers of one process end together."""

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:  # noqa: ARG002 - see below
        """Return True: messages arrive as they are published."""
        return True

    def _leave(self) -> None:
        self._core.endpoints.discard(self)
        self._core.bus.remove_publisher(self)
        self._core.bus.changed()
