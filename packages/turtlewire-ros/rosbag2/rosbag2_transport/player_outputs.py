"""The outputs of a player: a publisher for each topic, whose messages stay bytes, and requests."""

from __future__ import annotations

import time
from collections.abc import Callable, Container, Iterable
from typing import TYPE_CHECKING

from rosbag2_transport.options import ServiceRequestsSource
from rosbag2_transport.topic_filter import action_topic, is_service_event
from turtlewire.bag.definitions import known_hash
from turtlewire.errors import CdrError, InterfaceError, UncallableServiceError, WireError
from turtlewire.msg import deserialize, get_message, serialize, type_hash
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import Durability, History, Liveliness, QoS, Reliability
from turtlewire.wire.services import require_callable

if TYPE_CHECKING:
    from rclpy.node import Node
    from rosbag2_transport.options import PlayOptions
    from rosbag2_transport.played_bags import PlayedBags
    from turtlewire.bag import BagMessage, TopicInfo
    from turtlewire.wire.base import Client, Publisher

#: How long a playback waits at its start for existing subscriptions.
_MATCHING_NS = 2_000_000_000


class PlayerOutputs:
    """Publishes the messages of a bag.

    Args:
        node: The node whose publishers they are; its remapping rules apply.
        bag: The bags.
        topics: Names of the topics to publish.
        options: Overrides of QoS, and whether requests are sent to services.

    Attributes:
        latched: How many messages late listeners get, of each latched topic.
    """

    def __init__(
        self, node: Node, bag: PlayedBags, topics: Iterable[str], options: PlayOptions
    ) -> None:
        self._node = node
        self._graph = node.context.wire.graph
        self._logger = node.get_logger()
        self._publishers: dict[str, Publisher] = {}
        self._send: dict[str, Callable[[bytes], None]] = {}
        self._requests = _ServiceRequests(node, options.service_requests_source)
        self._refused: set[str] = set()
        self.latched: dict[str, int] = {}
        for name in topics:
            topic = bag.topics[name]
            is_event = is_service_event(name, topic.type)
            if options.send_actions_as_client and action_topic(name, topic.type):
                if is_event:  # servers publish feedback and status themselves
                    bag.learn_types()
                    self._send[name] = self._requests.sender(topic)
            elif options.publish_service_requests and is_event:
                bag.learn_types()
                self._send[name] = self._requests.sender(topic)
            else:
                self._create(topic, options)

    def _create(self, topic: TopicInfo, options: PlayOptions) -> None:
        override = options.topic_qos_profile_overrides.get(topic.name)
        if override is not None:
            self._logger.info(f"Overriding QoS profile for topic {topic.name}")
            qos = override.to_wire()
        else:
            qos, warning = publisher_qos(topic)
            if warning is not None:
                self._logger.warning(warning)
        type_id = TypeId(topic.type, known_hash(topic.type) or topic.type_hash)
        name = self._node.resolve_topic_name(topic.name)
        # Below rclpy's publishers, because the bytes need no message class.
        publisher = self._node._rclpy_wire.create_publisher(name, type_id, qos)
        self._publishers[topic.name] = publisher
        self._send[topic.name] = publisher.publish
        if qos.durability == Durability.TRANSIENT_LOCAL:
            self.latched[topic.name] = qos.depth or 1

    def wait_for_listeners(self) -> None:
        """Wait until subscriptions and services that exist are known: they miss nothing then."""
        self._graph.wait_for(self._is_matched, _MATCHING_NS)

    def _is_matched(self) -> bool:
        if not self._graph.is_complete():
            return False
        # Servers on another middleware never match.
        uncallable = {server.service for server in self._graph.foreign_servers()}
        if not self._requests.are_matched(
            self._graph.service_names_and_types().keys() - uncallable
        ):
            return False
        heard = {each.topic for each in self._graph.endpoints() if each.kind == "subscription"}
        return all(
            publisher.topic not in heard or publisher.subscription_count() > 0
            for publisher in self._publishers.values()
        )

    def publish(self, message: BagMessage) -> None:
        """Send a message; says once of each topic why it cannot be sent."""
        send = self._send.get(message.topic)
        if send is None:
            return
        try:
            send(message.upgraded_data())
        except (CdrError, WireError) as error:
            if message.topic not in self._refused:
                self._refused.add(message.topic)
                self._logger.error(f"A message was not played: {error}")  # noqa: TRY400

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:
        """Wait until all reliable subscriptions have everything; False after the timeout.

        Args:
            timeout_ns: For all publishers together.
        """
        end = time.monotonic_ns() + timeout_ns
        done = True
        for publisher in self._publishers.values():
            done &= publisher.wait_for_acknowledgments(max(0, end - time.monotonic_ns()))
        return done

    def close(self) -> None:
        """Leave the graph."""
        for publisher in self._publishers.values():
            publisher.close()
        self._requests.close()


_DEFAULT_DEPTH = 10
_DIFFERENT = (
    "Not all original publishers on topic {topic} offered the same QoS profiles. Rosbag2 cannot "
    "yet choose an adapted profile to offer for this mixed case. "
    "Falling back to the rosbag2_transport default publisher offer."
)
_CHOSEN = (Reliability.RELIABLE, Reliability.BEST_EFFORT)


def publisher_qos(topic: TopicInfo) -> tuple[QoS, str | None]:
    """Return the QoS that the publishers of a recorded topic offered.

    A latched topic is as deep as it needs to be for one that joins late to get what all recorded
    publishers kept; rosbag2 gives the last ten messages, and loses parts of larger static trees.
    It is not deeper: what each round of a loop repeats would pile up.

    Returns:
        The QoS, and a warning if the recorded publishers differed.
    """
    offered = topic.qos
    if not offered:
        return QoS(), None
    alike = {(qos.reliability, qos.durability, qos.deadline_ns, qos.liveliness) for qos in offered}
    if len(alike) > 1:
        return QoS(), _DIFFERENT.format(topic=topic.name)
    first = offered[0]
    qos = QoS(
        reliability=first.reliability if first.reliability in _CHOSEN else Reliability.RELIABLE,
        deadline_ns=first.deadline_ns,
        liveliness=(
            Liveliness.SYSTEM_DEFAULT
            if first.liveliness == Liveliness.UNKNOWN
            else first.liveliness
        ),
        liveliness_lease_ns=first.liveliness_lease_ns,
    )
    if first.durability == Durability.TRANSIENT_LOCAL:
        qos = qos._replace(durability=first.durability, depth=_latched_depth(topic))
    return qos, None


def _latched_depth(topic: TopicInfo) -> int:
    """Return the number of latched messages for listeners that join late."""
    depths = [qos.depth if qos.history == History.KEEP_LAST else 0 for qos in topic.qos]
    kept = sum(depths) if all(depths) else topic.message_count
    if topic.type == "tf2_msgs/msg/TFMessage":  # each message may bring other frames
        kept = topic.message_count
    return min(max(_DEFAULT_DEPTH, kept), topic.message_count) or _DEFAULT_DEPTH


_REQUEST_SENT, _REQUEST_RECEIVED = 0, 1


class _ServiceRequests:
    """Clients of recorded services.

    Args:
        node: The node whose clients they are.
        source: Whose record of a request counts.
    """

    def __init__(self, node: Node, source: ServiceRequestsSource) -> None:
        self._node = node
        by_client = source is ServiceRequestsSource.CLIENT_INTROSPECTION
        self._kind = _REQUEST_SENT if by_client else _REQUEST_RECEIVED
        self._clients: list[Client] = []
        self._told: set[str] = set()

    def sender(self, topic: TopicInfo) -> Callable[[bytes], None]:
        """Return a function that sends the requests among a service's events."""
        service = self._node.resolve_service_name(topic.name.removesuffix("/_service_event"))
        type_name = topic.type.removesuffix("_Event")
        try:
            request, response = (
                TypeId(f"{type_name}_{part}", type_hash(f"{type_name}_{part}"))
                for part in ("Request", "Response")
            )
            types = ServiceTypes(type_name, request, response, type_hash)
        except InterfaceError as error:
            self._tell(service, f"no requests are sent to {service}: {error}")
            return lambda _event: None
        client = self._node._rclpy_wire.create_client(service, types, QoS())
        self._clients.append(client)
        return lambda event: self._send(client, topic.type, event)

    def are_matched(self, services: Container[str]) -> bool:
        """Return True if the clients of all services that exist can send."""
        return all(client.service not in services or client.is_ready() for client in self._clients)

    def _send(self, client: Client, event_type: str, data: bytes) -> None:
        client.take(1000)  # answers are discarded, because they must not accumulate
        if len(data) > 4 and data[4] != self._kind:  # the event's kind is its first byte
            return
        event = deserialize(get_message(event_type), data)
        requests = event.request  # each event type has it
        if not requests:
            self._tell(
                client.service,
                f"the events of {client.service} do not contain the requests: record with the "
                "introspection state 'contents'",
            )
        elif not client.is_ready():
            self._tell(client.service, f"no request is sent: {self._why_not_ready(client)}")
        else:
            client.send_request(serialize(requests[0]))

    def _why_not_ready(self, client: Client) -> str:
        try:
            require_callable(self._node.context.wire.graph, client.service)
        except UncallableServiceError as error:
            return error.in_one_line()
        return f"{client.service} has no server"

    def _tell(self, service: str, text: str) -> None:
        if service not in self._told:
            self._told.add(service)
            self._node.get_logger().warning(text)

    def close(self) -> None:
        """Leave the graph."""
        for client in self._clients:
            client.close()
