"""``ros2 topic hz``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import topic_names
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.values import positive_int
from ros2topic.statistics import Intervals
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "HzVerb", "main"]


ARGUMENTS = (
    argument("topic_name", help="Name of the topic, for example /tf", completer=topic_names),
    argument(
        "-w",
        "--window",
        metavar="WINDOW",
        type=positive_int,
        default=10000,
        help="How many messages count",
    ),
    argument(
        "--filter",
        dest="filter_expr",
        metavar="EXPR",
        help="Only messages m for which this Python expression is true",
    ),
    argument("--wall-time", action="store_true", help="Use the wall clock with simulated time too"),
    *SPIN_ARGUMENTS,
)


def main(args: argparse.Namespace) -> None:
    """Print the rate every second, while messages come."""
    from rclpy.qos import qos_profile_sensor_data
    from ros2cli.direct_node import DirectNode
    from ros2topic.topic_type import type_of_topic
    from ros2topic.verb.echo import make_filter

    keep = make_filter(args.filter_expr)
    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = type_of_topic(direct, topic, blocking=True)
        intervals = Intervals(args.window)
        clock = direct.node.get_clock()

        def note(message: Any) -> None:
            if keep is None or keep(message):
                intervals.add(
                    time.monotonic_ns()
                    if args.wall_time or not args.use_sim_time
                    else clock.now().nanoseconds
                )

        direct.node.create_subscription(
            kind, topic, note, qos_profile_sensor_data, raw=keep is None
        )
        direct.node.create_timer(1.0, lambda: print(end=intervals.report()))
        direct.spin()


@verb_of_module
class HzVerb(VerbExtension):
    """Show the rate of a topic."""
