"""A warning for a program that publishes what nothing subscribes to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.publisher import Publisher

__all__ = ["warn_if_unheard"]

#: How long a publisher may be without a subscription: discovery takes less [s].
_PATIENCE_S = 2.0


def warn_if_unheard(node: Node, publisher: Publisher) -> None:
    """Warn once if, two seconds from now, nothing subscribes to what a node publishes.

    The warning names the other domains in which this computer has nodes.
    """

    def look() -> None:
        node.destroy_timer(timer)
        if not publisher.get_subscription_count():
            node.get_logger().warning(_unheard(publisher.topic_name, node.context.get_domain_id()))

    real_time = Clock(clock_type=ClockType.STEADY_TIME)  # a simulated clock may stand still
    timer = node.create_timer(_PATIENCE_S, look, clock=real_time)


def _unheard(topic: str, domain: int) -> str:
    from turtlewire.doctor.network import domains_of, udp_ports

    text = f"No node subscribes to {topic} on domain {domain}."
    others = sorted(domains_of(udp_ports()) - {domain})
    if not others:
        return f"{text} Is the node running that it is for?"
    return (
        f"{text} This computer has nodes on domain {', '.join(map(str, others))}: to reach "
        f"them, end this program and type: export ROS_DOMAIN_ID={others[0]}"
    )
