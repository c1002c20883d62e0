"""The publishers of a player: one for each topic, whose messages stay bytes."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from rosbag2_transport.action_topics import action_topic
from rosbag2_transport.player_qos import publisher_qos
from rosbag2_transport.player_requests import ServiceRequests
from rosbag2_transport.topic_filter import is_service_event
from turtlewire.errors import InterfaceError, WireError
from turtlewire.msg import type_hash
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rclpy.node import Node
    from rosbag2_transport.options import PlayOptions
    from rosbag2_transport.played_bags import PlayedBags
    from turtlewire.bag import BagMessage, TopicInfo
    from turtlewire.wire.base import Publisher

__all__ = ["PlayerOutputs"]

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
        self._requests = ServiceRequests(node, options.service_requests_source)
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
        type_id = TypeId(topic.type, _known_hash(topic.type) or topic.type_hash)
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
        except WireError as error:
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


def _known_hash(type_name: str) -> str:
    try:
        return type_hash(type_name)
    except InterfaceError:
        return ""
