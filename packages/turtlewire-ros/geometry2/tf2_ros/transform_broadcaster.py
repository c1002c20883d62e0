"""Publishes transforms that change over time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.experimental import AsyncNode
    from rclpy.node import Node


class TransformBroadcaster:
    """Publishes where frames are at the moment.

    Args:
        node: The publishing node.
        qos: Quality of service of ``/tf``, or a depth; by default depth 100.

    Attributes:
        pub_tf: The publisher.
    """

    def __init__(self, node: Node | AsyncNode, qos: QoSProfile | int | None = None) -> None:
        self.pub_tf = node.create_publisher(
            TFMessage, "/tf", QoSProfile(depth=100) if qos is None else qos
        )

    def sendTransform(  # noqa: N802 -- ROS 2's name
        self, transform: TransformStamped | Iterable[TransformStamped]
    ) -> None:
        """Publish one transform, or several in one message.

        Each is the pose of ``child_frame_id`` in ``header.frame_id``.
        """
        self.pub_tf.publish(TFMessage(transforms=as_list(transform)))


def as_list(transform: TransformStamped | Iterable[TransformStamped]) -> list[TransformStamped]:
    """Return one or several transforms as a list."""
    return [*transform] if hasattr(transform, "__iter__") else [transform]
