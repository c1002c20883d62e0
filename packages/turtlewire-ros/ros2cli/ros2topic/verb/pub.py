"""``ros2 topic pub``."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, exclusive
from ros2cli.builtin import verb_of_module
from ros2cli.completion import files, message_values, topic_names, topic_types
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.output import tell
from ros2cli.qos import QOS_ARGUMENTS, with_options
from ros2cli.values import positive_float, positive_int, read_documents, read_values, shortened
from ros2cli.values import unsigned_int as nonnegative_int
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator

    from ros2cli.node.direct import DirectNode

__all__ = [
    "ARGUMENTS",
    "DEFAULT_WAIT_TIME",
    "PubVerb",
    "main",
    "nonnegative_int",
    "read_msg_from_yaml",
]

DEFAULT_WAIT_TIME = 0.1

_SAY_WAITING_EVERY_S = 1.0


ARGUMENTS = (
    argument(
        "topic_name", help="Name of the topic, for example /turtle1/cmd_vel", completer=topic_names
    ),
    argument(
        "message_type",
        help="Type of the messages, for example geometry_msgs/msg/Twist",
        completer=topic_types,
    ),
    exclusive(
        argument(
            "values",
            nargs="?",
            default="{}",
            help="Values as YAML, for example '{linear: {x: 2.0}}'; a header may be 'auto'",
            completer=message_values,
        ),
        argument("--stdin", action="store_true", help="Read the values from stdin"),
        argument(
            "--yaml-file",
            metavar="FILE",
            help="Publish the YAML documents of this file, one after the other, and exit",
            completer=files,
        ),
    ),
    argument(
        "-r", "--rate", metavar="N", type=positive_float, default=1.0, help="Messages a second"
    ),
    argument(
        "-p",
        "--print",
        metavar="N",
        type=positive_int,
        default=1,
        help="Show only every Nth message",
    ),
    exclusive(
        argument("-1", "--once", action="store_true", help="Publish one message"),
        argument(
            "-t", "--times", type=positive_int, default=0, help="Publish this number of messages"
        ),
    ),
    argument(
        "-w",
        "--wait-matching-subscriptions",
        type=nonnegative_int,
        help="Number of subscriptions to wait for; 1 by default with --once and --times",
    ),
    argument(
        "--max-wait-time-secs", type=positive_float, help="Longest time to wait for subscriptions"
    ),
    argument(
        "--keep-alive",
        metavar="N",
        type=positive_float,
        default=DEFAULT_WAIT_TIME,
        help="Stay for N seconds after the last message",
    ),
    argument("-n", "--node-name", help="Name of the publishing node"),
    *QOS_ARGUMENTS,
    *SPIN_ARGUMENTS,
)


def main(args: argparse.Namespace) -> str | None:
    """Publish."""
    from rclpy.impl.unheard import warn_if_unheard
    from ros2cli.node.direct import DirectNode
    from ros2cli.suggestion import field_meant, say_what_was_meant, warn_of_other_type
    from ros2topic.api import message_class
    from turtlewire.msg import type_name

    kind = message_class(args.message_type)
    documents = _documents(args)
    try:
        messages = [_filled(kind, values) for values in documents]
    except Exception as error:  # noqa: BLE001  any value may be wrong in any way
        return f"Failed to populate field: {shortened(error)}{field_meant(error)}"
    asked = 1 if args.once else args.times
    times = min(asked or len(messages), len(messages)) if args.yaml_file else asked
    with DirectNode(args, node_name=args.node_name, lingers=True) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        if not direct.node.count_subscribers(topic):  # otherwise the publisher itself warns
            known = direct.graph.topic_names_and_types()
            warn_of_other_type("topic", topic, type_name(kind), known)
            say_what_was_meant(topic, known)
        publisher = direct.node.create_publisher(
            kind, args.topic_name, with_options(args, "default")
        )
        warn_if_unheard(direct.node, publisher, tell)
        wanted = args.wait_matching_subscriptions
        message_or_none = _wait_for_subscriptions(
            direct,
            publisher,
            (1 if asked else 0) if wanted is None else wanted,
            args.max_wait_time_secs,
        )
        if message_or_none is not None:
            return message_or_none
        print("publisher: beginning loop")
        _publish(args, direct, publisher, messages, times)
        if times:
            direct.pause(args.keep_alive)
    return None


def _documents(args: argparse.Namespace) -> list[dict[str, Any]]:
    """Return the values of the messages on the command line.

    Raises:
        RuntimeError: The values are wrong, or their file cannot be read or is empty.
        yaml.YAMLError: The values are not YAML.
    """
    if args.yaml_file is None:
        return [read_values(sys.stdin.read() if args.stdin else args.values)]
    documents = list(read_msg_from_yaml(args.yaml_file))
    if not documents:
        raise RuntimeError(f"The file '{args.yaml_file}' holds no YAML document")
    return documents


def read_msg_from_yaml(yaml_file: str) -> Iterator[dict[str, Any]]:
    """Yield the values of a message for each document of a YAML file.

    Raises:
        RuntimeError: The file cannot be read, or a document is not a mapping.
        yaml.YAMLError: The file is not YAML.
    """
    try:
        text = Path(yaml_file).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not text"
        raise RuntimeError(f"Cannot read '{yaml_file}': {reason}") from None
    yield from read_documents(text)


def _filled(kind: Any, values: dict[str, Any]) -> tuple[Any, list[Any]]:
    """Return a message, and the stamps in it that are set when it is published."""
    from rosidl_runtime_py import set_message_fields

    message = kind()
    stamps = set_message_fields(message, values, expand_header_auto=True, expand_time_now=True)
    return message, stamps


def _wait_for_subscriptions(
    direct: DirectNode, publisher: Any, wanted: int, limit: float | None
) -> str | None:
    """Wait; return a message after a timeout."""
    deadline = None if limit is None else time.monotonic() + limit
    while (count := publisher.get_subscription_count()) < wanted:
        print(f"Waiting for at least {wanted} matching subscription(s)...")
        rest = (
            _SAY_WAITING_EVERY_S
            if deadline is None
            else min(_SAY_WAITING_EVERY_S, deadline - time.monotonic())
        )
        if rest <= 0:
            return (
                f"Timed out waiting for subscribers: Expected {wanted} subscribers"
                f" but only got {count} subscribers"
            )
        direct.wait_for(lambda: publisher.get_subscription_count() >= wanted, rest)
    return None


def _publish(
    args: argparse.Namespace,
    direct: DirectNode,
    publisher: Any,
    messages: list[tuple[Any, list[Any]]],
    times: int,
) -> None:
    from rclpy.task import Future

    count = 0
    end = Future()

    def publish_next() -> None:
        nonlocal count
        if end.done():
            return
        message, stamps = messages[count % len(messages)]
        now = direct.node.get_clock().now().to_msg()
        # Stamps that the user wrote as `now`, or in a header `auto`.
        for stamp in stamps:
            stamp.sec, stamp.nanosec = now.sec, now.nanosec
        count += 1
        if count % args.print == 0:
            print(f"publishing #{count}: {message!r}\n")
        publisher.publish(message)
        if count == times:
            end.set_result(None)

    # At once, because the timer waits for a period.
    publish_next()
    timer = direct.node.create_timer(1.0 / args.rate, publish_next)
    direct.result(end)
    direct.node.destroy_timer(timer)


@verb_of_module
class PubVerb(VerbExtension):
    """Publish messages to a topic."""
