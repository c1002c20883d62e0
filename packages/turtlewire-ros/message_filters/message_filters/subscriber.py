"""The filter that subscribes to a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._typing import MsgT

from .simple_filter import OneMessageFilter

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.subscription import Subscription
    from rclpy.subscription_content_filter_options import ContentFilterOptions


class Subscriber(OneMessageFilter[MsgT]):
    """Passes on the messages of a topic.

    Type checkers know its messages: ``Subscriber[PointStamped]`` rejects callbacks of others.

    Args:
        node: The subscribing node.
        msg_type: Class of the messages.
        topic: Name of the topic.
        qos_profile: Quality of service, or a depth.
        callback_group: As in :meth:`Node.create_subscription
            <rclpy.node.Node.create_subscription>`, like the arguments below.
        event_callbacks: Functions to call on events of the quality of service.
        qos_overriding_options: Which policies parameters may override.
        raw: Whether the serialized bytes of the messages are passed on.
        content_filter_options: Without effect.

    Attributes:
        node: The subscribing node.
        topic: Name of the topic, as given.
        sub: The subscription.
    """

    def __init__(
        self,
        node: Node,
        msg_type: type[MsgT],
        topic: str,
        qos_profile: QoSProfile | int = 10,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
        content_filter_options: ContentFilterOptions | None = None,
    ) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        self.sub: Subscription[MsgT] = node.create_subscription(
            msg_type,
            topic,
            self.callback,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
            content_filter_options=content_filter_options,
        )

    def callback(self, msg: MsgT) -> None:
        """Take a message from the subscription."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802 -- ROS 2's name
        """Return the name of the topic, as given."""
        return self.topic

    def unsubscribe(self) -> None:
        """End the subscription."""
        self.node.destroy_subscription(self.sub)

    def __getattr__(self, name: str) -> Any:
        # As in ROS 2, a Subscriber also has the attributes of its subscription.
        if name == "sub":
            raise AttributeError(name)
        return getattr(self.sub, name)
