"""``ros2 topic delay``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import topic_names
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.values import positive_int
from ros2topic.statistics import Delays
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

    from rclpy.clock import Clock

__all__ = ["ARGUMENTS", "DelayVerb", "age", "main"]


ARGUMENTS = (
    argument(
        "topic_name", help="Name of a topic whose messages have a header", completer=topic_names
    ),
    argument(
        "-w",
        "--window",
        metavar="WINDOW",
        type=positive_int,
        default=10000,
        help="How many messages count",
    ),
    *SPIN_ARGUMENTS,
)


def main(args: argparse.Namespace) -> None:
    """Print the delay every second, while messages come."""
    from rclpy.qos import qos_profile_sensor_data
    from ros2cli.direct_node import DirectNode
    from ros2topic.topic_type import type_of_topic

    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = type_of_topic(direct, topic, blocking=True)
        if "header" not in kind.get_fields_and_field_types():
            raise RuntimeError("msg does not have header")
        delays = Delays(args.window)
        clock = direct.node.get_clock()

        def note(message: Any) -> None:
            delays.add(age(message, clock))

        direct.node.create_subscription(kind, topic, note, qos_profile_sensor_data)
        direct.node.create_timer(1.0, lambda: print(end=delays.report()))
        direct.spin()


def age(message: Any, clock: Clock) -> float:
    """Seconds since the stamp in the header of a message."""
    stamp = message.header.stamp
    stamp_ns: int = stamp.sec * 1_000_000_000 + stamp.nanosec
    return (clock.now().nanoseconds - stamp_ns) / 1e9


@verb_of_module
class DelayVerb(VerbExtension):
    """Show the delay of a topic, by the stamps in its headers."""
