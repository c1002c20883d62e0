"""Fills buffers from the wire.

The bytes of each ``TFMessage`` go into the buffer as they are, on a thread of the wire.

No message object or executor is involved, so a lookup may wait for data wherever it is called. All
buffers of one context that listen to a topic share one subscription, and each keeps its own data.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from turtlewire import wire
from turtlewire.tf.channel import Channel, Member, channel_of
from turtlewire.tf.publishers import DepartureWatch, departed_frames
from turtlewire.tf.tf_topics import TF_TYPE
from turtlewire.wire.qos import Durability, QoS

if TYPE_CHECKING:
    from turtlewire.tf.channel import Store
    from turtlewire.wire import base

__all__ = [
    "NOTHING_RECEIVED",
    "QOS",
    "STATIC_QOS",
    "STATIC_TOPIC",
    "TOPIC",
    "TYPE_NAME",
    "TransformListener",
    "new_node_name",
]

#: The topic of transforms that change.
TOPIC = "/tf"
#: The topic of static transforms, latched for late joiners.
STATIC_TOPIC = "/tf_static"
TYPE_NAME = TF_TYPE
QOS = QoS(depth=100)
STATIC_QOS = QoS(depth=100, durability=Durability.TRANSIENT_LOCAL)
#: The hint of lookups in a buffer that a network fills, before the first transform.
NOTHING_RECEIVED = (
    "No transform has arrived yet. Is a program that sends transforms running in the same domain?"
)


def new_node_name() -> str:
    """Return a node name for a listener that no other process has, as in ROS 2."""
    return f"transform_listener_impl_{os.urandom(6).hex()}"


class TransformListener:
    """Keeps a buffer filled until it is closed; also a context manager.

    Args:
        buffer: What to fill.
        node: Whose subscription it is in the graph; close the listener before the node. None makes
            its own node.
        context: The participant that ``node`` belongs to; None joins the domain of the environment.
        topic: Fully qualified name of the topic of changing transforms; None listens to static ones
            only.
        static_topic: Fully qualified name of the topic of static transforms; None leaves them out.
        qos: Of the first subscription.
        static_qos: Of the second one.
        forget_after_ns: Remove a moving frame this long after its publisher has left the graph;
            None keeps it, as tf2 does.

    The authority in the buffer is the publishing node (``/namespace/name``), or the
    publisher's gid in hex while the graph knows none. Messages that are no ``TFMessage`` are
    counted in the buffer (:meth:`turtlewire.Buffer.problems`); the first is warned of.
    """

    def __init__(
        self,
        buffer: Store,
        node: base.Node | None = None,
        *,
        context: base.Context | None = None,
        topic: str | None = TOPIC,
        static_topic: str | None = STATIC_TOPIC,
        qos: QoS = QOS,
        static_qos: QoS = STATIC_QOS,
        forget_after_ns: int | None = None,
    ) -> None:
        if forget_after_ns is not None and forget_after_ns < 0:
            raise ValueError(f"forget_after_ns must not be negative: {forget_after_ns}")
        self._own_context = wire.open_context() if context is None else None
        context = context or self._own_context
        assert context is not None
        self._own_node = context.create_node(new_node_name()) if node is None else None
        node = node or self._own_node
        assert node is not None
        self._member = Member(node, context.graph, buffer)
        self._lock = threading.Lock()
        self._joined: list[Channel] = []
        self._calls: list[Callable[[], None]] = []
        self._seen: dict[Channel, int] = {}
        self._topic = topic
        self._departures: DepartureWatch | None = None
        try:
            for channel in self._wanted(context, topic, static_topic, qos, static_qos):
                # Before joining, which may bring latched messages at once.
                self._seen[channel] = channel.total()
                channel.join(self._member)
                self._joined.append(channel)
            if topic is not None and forget_after_ns is not None:
                self._departures = DepartureWatch(buffer, context.graph, topic, forget_after_ns)
        except BaseException:
            self.close()
            raise

    def departed_frames(self) -> list[str]:
        """Return the moving frames whose publisher has left the graph."""
        if self._topic is None:
            return []
        return departed_frames(self._member.store, self._member.graph, self._topic)

    def on_message(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on a thread of the wire after a message, until the listener is closed.

        Native code calls only after :meth:`expect_message`. A call may come without a message.
        """
        self._calls.append(call)
        for channel in self._seen:
            channel.arrivals.add(call)

    def expect_message(self, waker: tuple[int, int] | None = None) -> bool:
        """Return True if a message was stored since :meth:`take_arrivals`.

        If not, the next one leads to a call of what :meth:`on_message` was given.

        Args:
            waker: What native code does in place of the call where it stores the message; see
                :meth:`turtlewire.wire.base.WaitSet.native_waker`.
        """
        # A message that comes after its channel was asked is reported.
        return {channel: channel.expect(waker) for channel in self._seen} != self._seen

    def take_arrivals(self) -> bool:
        """Return True if a message was stored since the last call."""
        former = self._seen
        self._seen = {channel: channel.total() for channel in former}
        return self._seen != former

    @staticmethod
    def _wanted(
        context: base.Context,
        topic: str | None,
        static_topic: str | None,
        qos: QoS,
        static_qos: QoS,
    ) -> Iterator[Channel]:
        if topic is not None:
            yield channel_of(context, topic, qos, static=False)
        if static_topic is not None:
            yield channel_of(context, static_topic, static_qos, static=True)

    def close(self) -> None:
        """Stop filling the buffer; what is in it stays. Idempotent, callable from any thread."""
        with self._lock:
            joined, self._joined = self._joined, []
        if self._departures is not None:
            self._departures.close()
        for channel in joined:
            for call in self._calls:
                channel.arrivals.discard(call)
            channel.leave(self._member)
        if self._own_node is not None:
            self._own_node.close()
        if self._own_context is not None:
            self._own_context.close()

    def __enter__(self) -> TransformListener:  # noqa: PYI034 -- typing.Self comes with Python 3.11
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()
