"""Changes messages between two topics."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rclpy.node import Node


class DataRepublisher:
    """Sends each message of a topic, changed, on another topic. The node must be spun.

    Args:
        node: Subscribes and publishes.
        listen_topic: The topic to subscribe to.
        publish_topic: The topic to publish.
        msg_type: The type of both.
        transform_fn: Returns the message to send for one that came, or None to send none.
    """

    def __init__(
        self,
        node: Node,
        listen_topic: str,
        publish_topic: str,
        msg_type: Any,
        transform_fn: Callable[[Any], Any],
    ) -> None:
        self._node = node
        self._transform = transform_fn
        self._lock = threading.Lock()
        self._received = 0
        self._sent: list[Any] = []
        self._publisher: Any = node.create_publisher(msg_type, publish_topic, 10)
        self._subscription: Any = node.create_subscription(
            msg_type, listen_topic, self._on_message, 10
        )

    def _on_message(self, message: Any) -> None:
        changed = self._transform(message)
        with self._lock:
            self._received += 1
            if changed is not None:
                self._sent.append(changed)
        if changed is not None:
            self._publisher.publish(changed)

    def get_num_received(self) -> int:
        """Return the number of messages received."""
        with self._lock:
            return self._received

    def get_num_republished(self) -> int:
        """Return the number of messages sent."""
        with self._lock:
            return len(self._sent)

    def get_republished(self) -> list[Any]:
        """Return the messages that were sent."""
        with self._lock:
            return list(self._sent)

    def shutdown(self) -> None:
        """Destroy subscription and publisher."""
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._publisher)
