"""Publishers of asynchronous nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._typing import MsgT
from rclpy.publisher import BasePublisher

if TYPE_CHECKING:
    from rclpy._execution.handle import EndpointImpl
    from rclpy.qos import QoSProfile


class AsyncPublisher(BasePublisher[MsgT]):
    """Sends messages to a topic; :meth:`publish` does not block, so nothing has to be awaited.

    Made by :meth:`AsyncNode.create_publisher`.

    Args:
        publisher_impl: The announced endpoint of the node.
        msg_type: Class of its messages.
        topic: Name of the topic, as it was given.
        qos_profile: Its quality of service.
        on_destroy: Called with the publisher after it has been destroyed.
    """

    def __init__(
        self,
        publisher_impl: EndpointImpl,
        msg_type: type[MsgT],
        topic: str,
        qos_profile: QoSProfile,
        on_destroy: Callable[[Any], None] | None,
    ) -> None:
        super().__init__(publisher_impl, msg_type, topic, qos_profile, on_destroy=on_destroy)
