"""``ros2 topic bw``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import topic_names
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.values import positive_int
from ros2topic.statistics import Sizes
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "BwVerb", "main"]


ARGUMENTS = (
    argument("topic_name", help="Name of the topic, for example /tf", completer=topic_names),
    argument(
        "-w",
        "--window",
        metavar="WINDOW",
        type=positive_int,
        default=100,
        help="How many messages count",
    ),
    *SPIN_ARGUMENTS,
)


def main(args: argparse.Namespace) -> None:
    """Print the bandwidth every second, while messages come."""
    from rclpy.qos import qos_profile_sensor_data
    from ros2cli.direct_node import DirectNode
    from ros2topic.topic_type import type_of_topic

    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = type_of_topic(direct, topic, blocking=True)
        sizes = Sizes(args.window)
        print(f"Subscribed to [{topic}]")
        direct.node.create_subscription(
            kind,
            topic,
            lambda cdr: sizes.add(time.monotonic(), len(cdr)),
            qos_profile_sensor_data,
            raw=True,
        )
        direct.node.create_timer(1.0, lambda: print(end=sizes.report(time.monotonic())))
        direct.spin()


@verb_of_module
class BwVerb(VerbExtension):
    """Show the bandwidth of a topic."""
