"""Publishers and subscriptions that are notified when others appear and disappear."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.event_handler import (
    PublisherEventCallbacks,
    QoSPublisherMatchedInfo,
    QoSSubscriptionMatchedInfo,
    SubscriptionEventCallbacks,
)
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String

_PUBLISHED, _SUBSCRIBED = "pub_topic_matched_event_detect", "sub_topic_matched_event_detect"


class MatchedEventDetectNode(Node):
    """Logs how many subscriptions and publishers match its own."""

    def __init__(self) -> None:
        super().__init__("matched_event_detection_node")
        self.changed: Future[bool] = Future()
        self.pub = self.create_publisher(
            String,
            _PUBLISHED,
            10,
            event_callbacks=PublisherEventCallbacks(
                matched=lambda info: self._tell("subscription", info)
            ),
        )
        self.sub = self.create_subscription(
            String,
            _SUBSCRIBED,
            lambda _message: None,
            10,
            event_callbacks=SubscriptionEventCallbacks(
                matched=lambda info: self._tell("publisher", info)
            ),
        )

    def _tell(self, what: str, info: QoSPublisherMatchedInfo | QoSSubscriptionMatchedInfo) -> None:
        change, count = info.current_count_change, info.current_count
        if change > 0 and count == change:
            self.get_logger().info(f"First {what} is connected.")
        elif count == 0:
            self.get_logger().info(f"Last {what} is disconnected.")
        else:
            self.get_logger().info(
                f"The changed number of connected {what} is {change:d} and current number of"
                f" connected {what} is {count:d}."
            )
        self.changed.set_result(True)


class MultiEndpointNode(Node):
    """Creates and destroys publishers or subscriptions.

    Args:
        name: Its name.
        what: ``publisher`` or ``subscription``.
    """

    def __init__(self, name: str, what: str) -> None:
        super().__init__(name)
        self._what = what
        self._endpoints: list[Any] = []

    def create_one(self) -> None:
        """Create an endpoint."""
        self.get_logger().info(f"Create a new {self._what}.")
        if self._what == "publisher":
            self._endpoints.append(self.create_publisher(String, _SUBSCRIBED, 10))
        else:
            made = self.create_subscription(String, _PUBLISHED, lambda _message: None, 10)
            self._endpoints.append(made)

    def destroy_one(self) -> None:
        """Destroy the oldest endpoint."""
        self.get_logger().info(f"Destroy a {self._what}.")
        endpoint = self._endpoints.pop(0)
        if self._what == "publisher":
            self.destroy_publisher(endpoint)
        else:
            self.destroy_subscription(endpoint)


def main(args: list[str] | None = None) -> None:
    """Create and destroy two subscriptions and two publishers."""
    with rclpy.init(args=args):
        detector = MatchedEventDetectNode()
        others = [
            MultiEndpointNode("multi_sub_node", "subscription"),
            MultiEndpointNode("multi_pub_node", "publisher"),
        ]
        executor = SingleThreadedExecutor()
        for node in (detector, *others):
            executor.add_node(node)
        for node in others:
            for act in (node.create_one, node.create_one, node.destroy_one, node.destroy_one):
                # A new future for each change: the spin below ends at the next event.
                detector.changed = Future()
                act()
                executor.spin_until_future_complete(detector.changed, timeout_sec=10.0)
