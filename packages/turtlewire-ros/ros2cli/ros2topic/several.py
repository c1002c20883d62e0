"""Several topics for the verbs ``hz`` and ``bw``, and the table of their figures."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.completion import topic_names
from ros2cli.helpers import OPTIONAL, select_topic
from ros2cli.json_lines import remark_printer
from ros2cli.qos import asked_for, with_options

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode

_BLANKS = 3


SEVERAL_TOPICS = (
    argument(
        "topic_name",
        nargs="*",
        help="Names of the topics, for example /tf",
        completer=topic_names,
    ),
    argument("-a", "--all", action="store_true", help="All topics that there are now"),
)


def refused(args: argparse.Namespace) -> str | None:
    """Return why the choice of topics on a command line is wrong; None if it is right.

    Raises:
        SystemExit: There is no topic; the usage of the verb is shown.
    """
    if args.all and args.topic_name:
        return "Cannot specify both --all/-a and topic names"
    if not args.all and not args.topic_name and OPTIONAL is None:
        args.parser.error("the following arguments are required: topic_name")
    return None


def choose(direct: DirectNode, args: argparse.Namespace, verb: str) -> bool:
    """Let the user choose a topic if the command line has none; returns whether there is one."""
    if not args.all and not args.topic_name:
        name = select_topic(direct.graph, f"Select topic for {verb}:")
        args.topic_name = [] if name is None else [name]
    return bool(args.all or args.topic_name)


def subscribe(
    direct: DirectNode,
    args: argparse.Namespace,
    topics: list[str],
    callback: Callable[[str], Callable[[Any], None]],
    *,
    raw: bool,
) -> None:
    """Subscribe to the topics on a command line.

    Topics that do not exist yet are waited for, while the callbacks of the others run.

    Args:
        direct: The node that subscribes.
        args: The command line.
        topics: The names of the topics are added to it, in order.
        callback: Returns the callback for messages of a topic.
        raw: Whether callbacks get undecoded messages.
    """
    from rclpy.qos import qos_profile_sensor_data
    from ros2cli.graph import topics as topics_of

    qos = with_options(args, "sensor_data") if asked_for(args) else qos_profile_sensor_data
    known = [name for name, _ in topics_of(direct.graph)]
    if args.all:
        topics += known
        if not args.json:
            print(f"Subscribing to all {len(known)} available topics...")
    else:
        topics += dict.fromkeys(map(direct.node.resolve_topic_name, args.topic_name))
    # Those that exist come first, because the wait for another one has no end.
    for topic in sorted(topics, key=lambda name: name not in known):
        kind = _kind(direct, topic, args)
        if kind is not None:
            direct.node.create_subscription(kind, topic, callback(topic), qos, raw=raw)


def _kind(direct: DirectNode, topic: str, args: argparse.Namespace) -> Any:
    from ros2topic.api import type_of_topic

    try:
        return type_of_topic(direct, topic, blocking=not args.all, as_json=args.json)
    except RuntimeError:
        if not args.all:
            raise
        remark = remark_printer(as_json=args.json)
        remark(f"WARNING: failed to find message type for topic [{topic}]")
        return None


def print_table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print ROS 2's table, and an empty line.

    Args:
        columns: Names of the columns, which are centred.
        rows: The cells of each row, in order of the columns.
    """
    widths = [max(map(len, column)) for column in zip(columns, *rows, strict=True)]
    blanks = " " * _BLANKS
    print(blanks.join(name.center(width) for name, width in zip(columns, widths, strict=True)))
    print("=" * (sum(widths) + _BLANKS * (len(widths) - 1)))
    for row in rows:
        print(blanks.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)))
    print()
