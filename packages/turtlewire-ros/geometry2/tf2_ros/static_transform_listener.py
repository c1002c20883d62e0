"""Fills a buffer with the transforms of ``/tf_static``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .transform_listener import DEFAULT_STATIC_TF_TOPIC, DEFAULT_TF_TOPIC, TransformListener

if TYPE_CHECKING:
    from rclpy.experimental import AsyncNode
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

    from .buffer import Buffer

__all__ = ["DEFAULT_STATIC_TF_TOPIC", "DEFAULT_TF_TOPIC", "StaticTransformListener"]


class StaticTransformListener(TransformListener):
    """A :class:`TransformListener` that listens to ``/tf_static`` only.

    Args:
        buffer: The buffer to fill.
        node: The node that owns the subscription; None makes one in the default context.
        spin_thread: Spin the node in its own thread, for its other callbacks.
        static_qos: Quality of service, or a depth; by default depth 100 and transient local.
        tf_static_topic: The topic of static transforms.
    """

    def __init__(
        self,
        buffer: Buffer,
        node: Node | AsyncNode | None,
        *,
        spin_thread: bool = False,
        static_qos: QoSProfile | int | None = None,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None:
        super().__init__(
            buffer,
            node,
            spin_thread=spin_thread,
            static_qos=static_qos,
            tf_static_topic=tf_static_topic,
            static_only=True,
        )
