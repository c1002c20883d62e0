"""Waiting for a single message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._node.endpoints import endpoints_of
from .callback_groups import MutuallyExclusiveCallbackGroup
from .executors import ExternalShutdownException, SingleThreadedExecutor
from .task import Future

if TYPE_CHECKING:
    from .node import Node
    from .qos import QoSProfile


def wait_for_message(
    msg_type: Any,
    node: Node,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Block until a message comes.

    You may spin the node meanwhile, but need not: a separate executor serves only the subscription
    that this function creates.

    Args:
        msg_type: Class of the message.
        node: Whose subscription it is.
        topic: Name of the topic.
        qos_profile: Quality of service, or a history depth.
        time_to_wait: Seconds; negative waits until the context is shut down.

    Returns:
        Whether a message came, and the message or None.
    """
    came = Future()
    # The node's own group may be held by the callback that waits here.
    group = MutuallyExclusiveCallbackGroup()
    subscription = endpoints_of(node).make_subscription(
        msg_type, topic, came.set_result, qos_profile, group
    )
    with SingleThreadedExecutor(context=node.context) as executor:
        executor._rclpy_scheduler.adopt(subscription)
        try:
            executor.spin_until_future_complete(came, None if time_to_wait < 0 else time_to_wait)
        except ExternalShutdownException:
            return False, None
        finally:
            subscription.destroy()
    return came.done(), came.result()
