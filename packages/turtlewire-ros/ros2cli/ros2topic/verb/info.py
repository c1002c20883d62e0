"""``ros2 topic info``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import topic_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "InfoVerb", "main"]


ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument("topic_name", help="Name of the topic, for example /tf", completer=topic_names),
    argument(
        "-v", "--verbose", action="store_true", help="Show each end: node, QoS, hash of the type"
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Print type and counts; in detail each end."""
    from ros2cli.graph import endpoints_of_topic, topics
    from ros2cli.suggestion import did_you_mean

    with discovered_graph(args.spin_time) as graph:
        known = dict(topics(graph, hidden=True))
        if args.topic_name not in known:
            return f"Unknown topic '{args.topic_name}'{did_you_mean(args.topic_name, known)}"
        types = known[args.topic_name]
        print(f"Type: {types[0] if len(types) == 1 else types}")
        gap = "\n" if args.verbose else ""
        for title, kind in (("Publisher", "publisher"), ("Subscription", "subscription")):
            ends = endpoints_of_topic(graph, args.topic_name, kind)
            print(f"{gap}{title} count: {len(ends)}")
            if args.verbose:
                from rclpy.topic_endpoint_info import TopicEndpointInfo

                for end in ends:
                    print(f"\n{TopicEndpointInfo.from_wire(end)}")
        print(end=gap)
    return None


@verb_of_module
class InfoVerb(VerbExtension):
    """Show who publishes and subscribes to a topic."""
