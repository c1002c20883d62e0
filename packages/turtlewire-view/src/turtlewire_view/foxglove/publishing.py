"""The topics that one client publishes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import CdrError, InterfaceError, WireError
from turtlewire.msg import type_hash
from turtlewire.msg.json_messages import cdr_from_json
from turtlewire.msg.registry import load_message
from turtlewire.wire.base import TypeId
from turtlewire.wire.names import validate_full_topic_name
from turtlewire.wire.qos import Durability, QoS
from turtlewire_view.foxglove.protocol import ENCODINGS, ProtocolError
from turtlewire_view.foxglove.schemas import full_name

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph, Node, Publisher
    from turtlewire_view.foxglove.options import Patterns

__all__ = ["Publishing"]

#: How many channels a client may have.
_MOST = 1000


class _Channel(NamedTuple):
    topic: str
    type_name: str
    encoding: str
    publisher: Publisher


class Publishing:
    """The channels of a client, each with a publisher on the wire.

    Args:
        node: Whose publishers they are.
        graph: Tells who subscribes.
        allowed: On which topics clients may publish.
    """

    def __init__(self, node: Node, graph: Graph, allowed: Patterns) -> None:
        self._node = node
        self._graph = graph
        self._allowed = allowed
        self._channels: dict[int, _Channel] = {}

    def advertise(self, channel_id: int, topic: str, encoding: str, schema_name: str) -> None:
        """Begin to publish on a topic.

        Args:
            channel_id: The client's number of the channel.
            topic: Name of the topic; one without a leading slash gets one.
            encoding: How the client's messages are encoded.
            schema_name: Their type, ``geometry_msgs/msg/Twist`` or ``geometry_msgs/Twist``.

        Raises:
            ProtocolError: This cannot be; the text says why.
        """
        topic = topic if topic.startswith("/") else f"/{topic}"
        if channel_id in self._channels:
            raise ProtocolError(f"channel {channel_id} is advertised already")
        if len(self._channels) >= _MOST:
            raise ProtocolError(f"a client has at most {_MOST} channels")
        if encoding not in ENCODINGS:
            raise ProtocolError(
                f"{topic}: there is no encoding {encoding!r}; choose from {', '.join(ENCODINGS)}"
            )
        fault = validate_full_topic_name(topic)
        if fault is not None:
            raise ProtocolError(f"'{topic}' is not the name of a topic: {fault.message}")
        if not self._allowed.match(topic):
            raise ProtocolError(f"client_topic_whitelist does not allow {topic}")
        type_name = full_name(schema_name)
        try:
            load_message(type_name)
            type_id = TypeId(type_name, type_hash(type_name))
            publisher = self._node.create_publisher(topic, type_id, self._qos(topic))
        except (InterfaceError, WireError, ValueError) as error:
            hint = getattr(error, "hint", "")
            raise ProtocolError(f"{topic}: {error} {hint}".rstrip()) from error
        self._channels[channel_id] = _Channel(topic, type_name, encoding, publisher)

    def publish(self, channel_id: int, payload: bytes) -> None:
        """Publish a message.

        Raises:
            ProtocolError: The channel does not exist, or the payload is not a message of its type.
        """
        channel = self._channels.get(channel_id)
        if channel is None:
            raise ProtocolError(f"there is no channel {channel_id}: advertise it first")
        try:
            if channel.encoding == "json":
                payload = cdr_from_json(channel.type_name, payload)
            channel.publisher.publish(payload)
        except (CdrError, WireError) as error:
            raise ProtocolError(f"a message on {channel.topic} was lost: {error}") from error

    def unadvertise(self, channel_id: int) -> bool:
        """Publish on a channel no longer; False if there is no such channel."""
        channel = self._channels.pop(channel_id, None)
        if channel is None:
            return False
        channel.publisher.close()
        return True

    def close(self) -> None:
        """End all channels."""
        for channel_id in list(self._channels):
            self.unadvertise(channel_id)

    def _qos(self, topic: str) -> QoS:
        """Reliable; latched as well if a subscription wants that, which would not match else."""
        latched = any(
            end.qos.durability == Durability.TRANSIENT_LOCAL
            for end in self._graph.endpoints_of(topic, "subscription")
        )
        durability = Durability.TRANSIENT_LOCAL if latched else Durability.VOLATILE
        return QoS(depth=10, durability=durability)
