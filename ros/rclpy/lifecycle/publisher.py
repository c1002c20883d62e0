"""Publishers of a managed node."""

from __future__ import annotations

from typing import Any

from rclpy.publisher import Publisher

from .managed_entity import SimpleManagedEntity

__all__ = ["LifecyclePublisher"]


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """Publishes while its node is active, and drops messages otherwise."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        SimpleManagedEntity.__init__(self)
        Publisher.__init__(self, *args, **kwargs)

    @SimpleManagedEntity.when_enabled
    def publish(self, msg: Any) -> None:
        """Send a message if the node is active."""
        Publisher.publish(self, msg)
