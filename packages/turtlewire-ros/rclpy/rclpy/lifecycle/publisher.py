"""Publishers that are silent while their node is not active."""

from __future__ import annotations

from typing import Any

from rclpy.publisher import Publisher

from .managed_entity import SimpleManagedEntity


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """Publishes while its node is active; messages at other times are dropped."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        SimpleManagedEntity.__init__(self)
        Publisher.__init__(self, *args, **kwargs)

    @SimpleManagedEntity.when_enabled
    def publish(self, msg: Any) -> None:
        """Send a message if the node is active; see :meth:`rclpy.publisher.Publisher.publish`."""
        Publisher.publish(self, msg)
