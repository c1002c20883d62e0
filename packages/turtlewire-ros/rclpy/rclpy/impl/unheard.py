"""Warns about topics without a matching endpoint, a sign of a wrong domain."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.publisher import Publisher

#: Time for discovery [s]; it usually takes less.
_PATIENCE_S = 2.0


def warn_if_unheard(
    node: Node, publisher: Publisher, warn: Callable[[str], object] | None = None
) -> None:
    """Warn once if, two seconds from now, no node subscribes to what a publisher publishes.

    The warning names the other domains in which this computer has nodes.

    Args:
        node: The publisher's node.
        publisher: The publisher.
        warn: Called with the warning; by default the node logs it.
    """
    text = f"No node subscribes to {publisher.topic_name}"
    question = "Is the node that should receive it running?"
    _warn_later(node, publisher.get_subscription_count, text, question, warn)


def warn_if_silent(node: Node, topic: str, warn: Callable[[str], object] | None = None) -> None:
    """Warn once if, two seconds from now, no node publishes a topic; see `warn_if_unheard`."""
    text = f"No node publishes {topic}"
    question = "Is the node that should publish it running?"
    _warn_later(node, lambda: node.count_publishers(topic), text, question, warn)


def _warn_later(
    node: Node,
    count: Callable[[], int],
    text: str,
    question: str,
    warn: Callable[[str], object] | None,
) -> None:
    def look() -> None:
        node.destroy_timer(timer)
        if not count():
            from turtlewire.doctor.network import other_domains_hint

            domain = node.context.get_domain_id()
            warning = f"{text} on domain {domain}. {other_domains_hint(domain) or question}"
            (warn or node.get_logger().warning)(warning)

    real_time = Clock(clock_type=ClockType.STEADY_TIME)  # a simulated clock may stand still
    timer = node.create_timer(_PATIENCE_S, look, clock=real_time)
