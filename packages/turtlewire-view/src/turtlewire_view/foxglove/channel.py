"""One topic that clients may subscribe to."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from turtlewire.wire.qos import Durability, QoS, Reliability
from turtlewire_view.foxglove.schemas import ENCODING

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, MessageInfo, Node, Subscription, TypeId
    from turtlewire_view.foxglove.outbox import Outbox

__all__ = ["FoxgloveChannel"]

#: How many messages may wait for the wire's reader thread, which only puts them into queues.
_DEPTH = 100


class FoxgloveChannel:
    """A topic with one type: its subscriptions on the wire, and the clients that receive from them.

    It is on the wire only while a client wants it. Clients share one subscription. A publisher that
    keeps messages for late joiners sends them once, when a subscription begins: clients of such
    topics have a subscription each, so that each gets what every publisher keeps.

    All methods are for the server's thread; messages come on threads of the wire.

    Args:
        number: Its number, which no other channel of the server ever has.
        topic: Fully qualified name.
        type_id: The type.
        schema: The type's definition.
        node: Whose subscriptions it makes.
        now_ns: The simulation's time; 0 without one.
    """

    def __init__(
        self,
        number: int,
        topic: str,
        type_id: TypeId,
        schema: str,
        node: Node,
        now_ns: Callable[[], int],
    ) -> None:
        self.number = number
        self.topic = topic
        self._type = type_id
        self._schema = schema
        self._node = node
        self._now_ns = now_ns
        self._durable: QoS | None = None  # how to subscribe to publishers that keep messages
        self._volatile: QoS | None = None  # and to the others
        self._keepers: frozenset[bytes] = frozenset()  # gids of the former
        self._others: frozenset[bytes] = frozenset()  # and of the latter
        # Replaced, never changed: threads of the wire read it.
        self._receivers: tuple[tuple[Outbox, int], ...] = ()
        self._shared: Subscription | None = None
        self._own: dict[Outbox, Subscription] = {}

    def advertisement(self) -> dict[str, Any]:
        """Return the announcement for clients."""
        return {
            "id": self.number,
            "topic": self.topic,
            "encoding": "cdr",
            "schemaName": self._type.name,
            "schema": self._schema,
            "schemaEncoding": ENCODING,
        }

    def fit(self, publishers: Iterable[EndpointInfo]) -> None:
        """Subscribe so that all of these publishers match, if any client receives."""
        publishers = list(publishers)
        keepers = [end for end in publishers if end.qos.durability == Durability.TRANSIENT_LOCAL]
        others = [end for end in publishers if end.qos.durability != Durability.TRANSIENT_LOCAL]
        durable = _fitting(keepers, Durability.TRANSIENT_LOCAL) or self._durable
        volatile = _fitting(others, Durability.VOLATILE) or self._volatile
        self._keepers = frozenset(end.gid for end in keepers)
        self._others = frozenset(end.gid for end in others)
        if durable != self._durable:
            self._durable = durable
            for outbox, number in self._receivers:
                self._subscribe_own(outbox, number)
        if volatile != self._volatile:
            self._volatile = volatile
            self._subscribe_shared()

    def add(self, outbox: Outbox, subscription_id: int) -> None:
        """Give a client what is published from now on, and what publishers keep.

        Raises:
            WireError: The wire refuses the subscription.
        """
        number = outbox.begin(subscription_id)
        self._receivers = (*self._receivers, (outbox, number))
        try:
            self._subscribe_own(outbox, number)
            if self._shared is None:
                self._subscribe_shared()
        except BaseException:
            self.remove(outbox)
            raise

    def remove(self, outbox: Outbox) -> None:
        """Stop sending messages to a client."""
        numbers = [number for each, number in self._receivers if each is outbox]
        self._receivers = tuple(each for each in self._receivers if each[0] is not outbox)
        own = self._own.pop(outbox, None)
        if own is not None:
            own.close()
        for number in numbers:  # the wire's threads may still use the former receivers
            outbox.end(number)
        if not self._receivers and self._shared is not None:
            self._shared.close()
            self._shared = None

    def close(self) -> None:
        """Leave the wire."""
        for outbox, _ in self._receivers:
            self.remove(outbox)

    def _subscribe_own(self, outbox: Outbox, number: int) -> None:
        if self._durable is None:
            return
        former = self._own.pop(outbox, None)
        if former is not None:
            former.close()

        def receive(cdr: bytes, info: MessageInfo) -> None:
            if info.publisher_gid in self._others:  # Zenoh: the shared one also gets it
                return
            outbox.put(number, self._now_ns() or info.received_timestamp_ns, cdr)

        self._own[outbox] = self._subscribe(self._durable, receive)

    def _subscribe_shared(self) -> None:
        if self._shared is not None:
            self._shared.close()
            self._shared = None
        if self._receivers and self._volatile is not None:
            self._shared = self._subscribe(self._volatile, self._spread)

    def _subscribe(
        self, qos: QoS, on_message: Callable[[bytes, MessageInfo], None]
    ) -> Subscription:
        return self._node.create_subscription(self.topic, self._type, qos, on_message)

    def _spread(self, cdr: bytes, info: MessageInfo) -> None:
        """Give a message to all clients, on a thread of the wire."""
        if info.publisher_gid in self._keepers:  # the clients' own subscriptions deliver it
            return
        time_ns = self._now_ns() or info.received_timestamp_ns
        for outbox, number in self._receivers:
            outbox.put(number, time_ns, cdr)


def _fitting(publishers: list[EndpointInfo], durability: Durability) -> QoS | None:
    """Return the QoS of a subscription that matches all publishers; None without publishers."""
    if not publishers:
        return None
    reliable = all(end.qos.reliability == Reliability.RELIABLE for end in publishers)
    return QoS(
        depth=_DEPTH,
        reliability=Reliability.RELIABLE if reliable else Reliability.BEST_EFFORT,
        durability=durability,
    )
