"""``ros2 topic info``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.completion import topic_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.helpers import OPTIONAL, select_topic
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "topic_name",
        nargs=OPTIONAL,
        help="Name of the topic, for example /tf",
        completer=topic_names,
    ),
    argument(
        "-v", "--verbose", action="store_true", help="Show each end: node, QoS, hash of the type"
    ),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> str | None:
    """Print type and counts; in detail each end."""
    from ros2cli.graph import endpoints_of_topic, topics
    from ros2cli.suggestion import did_you_mean

    with discovered_graph(args.spin_time) as graph:
        name = args.topic_name or select_topic(graph, "Select topic for info:")
        if name is None:
            return None
        known = dict(topics(graph, hidden=True))
        if name not in known:
            return f"Unknown topic '{name}'{did_you_mean(name, known)}"
        types = known[name]
        if args.json:
            _print_json(graph, name, types, verbose=args.verbose)
            return None
        print(f"Type: {types[0] if len(types) == 1 else types}")
        gap = "\n" if args.verbose else ""
        for title, kind in (("Publisher", "publisher"), ("Subscription", "subscription")):
            ends = endpoints_of_topic(graph, name, kind)
            print(f"{gap}{title} count: {len(ends)}")
            if args.verbose:
                from rclpy.endpoint_info import TopicEndpointInfo

                for end in ends:
                    print(f"\n{TopicEndpointInfo.from_wire(end)}")
        print(end=gap)
    return None


def _print_json(graph: Graph, name: str, types: list[str], *, verbose: bool) -> None:
    from rclpy.endpoint_info import TopicEndpointInfo
    from ros2cli.graph import endpoints_of_topic
    from ros2cli.json_lines import topic_endpoint_data

    data: dict[str, Any] = {"topic": name, "types": types}
    for kind in ("publisher", "subscription"):
        ends = endpoints_of_topic(graph, name, kind)
        data[f"{kind}_count"] = len(ends)
        if verbose:
            infos = map(TopicEndpointInfo.from_wire, ends)
            data[f"{kind}s"] = [topic_endpoint_data(info) for info in infos]
    print_json(data)


class InfoVerb(VerbExtension, module=__name__):
    """Show who publishes and subscribes to a topic."""
