"""The filter that subscribes to a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._typing import MsgT

from .one_message_filter import OneMessageFilter

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.subscription import Subscription

__all__ = ["Subscriber"]


class Subscriber(OneMessageFilter[MsgT]):
    """Passes on the messages of a topic.

    Type checkers know its messages: ``Subscriber[PointStamped]`` refuses callbacks of others.

    Args:
        node: The subscribing node.
        msg_type: Class of the messages.
        topic: Name of the topic.
        args: Further arguments of :meth:`Node.create_subscription
            <rclpy.node.Node.create_subscription>`, after the callback.
        qos_profile: Quality of service, or a depth; by default depth 10.
        kwargs: Further keywords of ``create_subscription``.

    Attributes:
        node: The subscribing node.
        topic: Name of the topic, as given.
        sub: The subscription.
    """

    def __init__(
        self, node: Node, msg_type: type[MsgT], topic: str, *args: Any, **kwargs: Any
    ) -> None:
        super().__init__()
        if not args:
            kwargs.setdefault("qos_profile", 10)
        self.node = node
        self.topic = topic
        self.sub: Subscription[MsgT] = node.create_subscription(
            msg_type, topic, self.callback, *args, **kwargs
        )

    def callback(self, msg: MsgT) -> None:
        """Take a message from the subscription."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802 -- ROS 2's name
        """Name of the topic, as given."""
        return self.topic

    def unsubscribe(self) -> None:
        """End the subscription."""
        self.node.destroy_subscription(self.sub)

    def __getattr__(self, name: str) -> Any:
        # As in ROS 2, a Subscriber also has the attributes of its subscription.
        if name == "sub":
            raise AttributeError(name)
        return getattr(self.sub, name)
