"""``ros2 topic pub``."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ros2cli.arguments import (
    argument,
    exclusive,
    positive_float,
    positive_int,
    read_documents,
    read_values,
    shortened,
)
from ros2cli.arguments import unsigned_int as nonnegative_int
from ros2cli.completion import files, message_values, topic_names, topic_types
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.output import tell
from ros2cli.qos import QOS_ARGUMENTS, with_options
from ros2topic.verb import VerbExtension
from turtlewire.distro import KILTED, since

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
    from ros2cli.node.direct import DirectNode

__all__ = [
    "ARGUMENTS",
    "DEFAULT_WAIT_TIME",
    "PubVerb",
    "main",
    "nonnegative_int",
    "publisher",
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
    from ros2cli.node.direct import DirectNode

    asked = 1 if args.once else args.times
    wanted = args.wait_matching_subscriptions
    try:
        plan = _plan(
            args.message_type,
            args.topic_name,
            sys.stdin.read() if args.stdin else args.values,
            args.yaml_file,
            period=1.0 / args.rate,
            print_nth=args.print,
            times=asked,
            subscriptions=(1 if asked else 0) if wanted is None else wanted,
            max_wait_time=args.max_wait_time_secs,
            keep_alive=args.keep_alive,
        )
    except _WrongValuesError as error:
        return str(error)
    with DirectNode(args, node_name=args.node_name, lingers=True) as direct:
        return _publish(direct, plan, with_options(args, "default"))


def publisher(
    node: Any,
    message_type: str,
    topic_name: str,
    values: str,
    yaml_file: str | None,
    period: float,
    print_nth: int,
    times: int,
    wait_matching_subscriptions: int,
    max_wait_time: float | None,
    qos_profile: QoSProfile,
    keep_alive: float,
) -> str | None:
    """Publish messages from a node until all are sent or Ctrl-C comes.

    In Jazzy, there is no ``yaml_file``.

    Args:
        node: The node, which the caller owns.
        message_type: Type of the messages, for example ``std_msgs/msg/String``.
        topic_name: Name of the topic.
        values: Values of the message as YAML.
        yaml_file: A file of such values, one document for each message; None uses ``values``.
        period: Seconds between messages.
        print_nth: Shows only every message of this number.
        times: Number of messages; 0 publishes without an end, and each message of a file once.
        wait_matching_subscriptions: Number of subscriptions to wait for.
        max_wait_time: Seconds for this wait; None waits without a limit.
        qos_profile: Quality of service of the publisher.
        keep_alive: Seconds to stay after the last message.

    Returns:
        The text of an error, or None.

    Raises:
        KeyboardInterrupt: At Ctrl-C.
        RuntimeError: The type is not a message, or the file cannot be read.
        yaml.YAMLError: The values are not YAML.
    """
    from ros2cli.node.direct import DirectNode

    try:
        plan = _plan(
            message_type,
            topic_name,
            values,
            yaml_file,
            period=period,
            print_nth=print_nth,
            times=times,
            subscriptions=wait_matching_subscriptions,
            max_wait_time=max_wait_time,
            keep_alive=keep_alive,
        )
    except _WrongValuesError as error:
        return str(error)
    return _publish(DirectNode.around(node), plan, qos_profile)


if not (TYPE_CHECKING or since(KILTED)):
    _publisher = publisher

    def publisher(
        node: Any,
        message_type: str,
        topic_name: str,
        values: str,
        period: float,
        *others: Any,
        **options: Any,
    ) -> str | None:
        """Publish messages as Kilted's function does, without a file of values."""
        return _publisher(node, message_type, topic_name, values, None, period, *others, **options)


class _WrongValuesError(Exception):
    """Values do not fit the type of the messages; the text is for the user."""


class _Plan(NamedTuple):
    """The messages to publish, and the options.

    Attributes:
        kind: Their class.
        topic_name: Name of the topic.
        messages: The messages with the stamps in them that are set when they are published.
        period: Seconds between messages.
        print_nth: Shows only every message of this number.
        times: Number of messages; 0 publishes without an end.
        subscriptions: Number of subscriptions to wait for.
        max_wait_time: Seconds for this wait; None waits without a limit.
        keep_alive: Seconds to stay after the last message.
    """

    kind: Any
    topic_name: str
    messages: list[tuple[Any, list[Any]]]
    period: float
    print_nth: int
    times: int
    subscriptions: int
    max_wait_time: float | None
    keep_alive: float


def _plan(
    message_type: str, topic_name: str, values: str, yaml_file: str | None, **options: Any
) -> _Plan:
    from ros2cli.suggestion import field_meant
    from ros2topic.api import message_class

    kind = message_class(message_type)
    documents = _documents(values, yaml_file)
    try:
        messages = [_filled(kind, each) for each in documents]
    except Exception as error:  # any value may be wrong in any way
        text = f"Failed to populate field: {shortened(error)}{field_meant(error)}"
        raise _WrongValuesError(text) from error
    plan = _Plan(kind, topic_name, messages, **options)
    if not yaml_file:
        return plan
    return plan._replace(times=min(plan.times or len(messages), len(messages)))


def _publish(direct: DirectNode, plan: _Plan, qos_profile: QoSProfile) -> str | None:
    from rclpy.impl.unheard import warn_if_unheard
    from ros2cli.suggestion import say_what_was_meant, warn_of_other_type
    from turtlewire.msg import type_name

    topic = direct.node.resolve_topic_name(plan.topic_name)
    if not direct.node.count_subscribers(topic):  # otherwise the publisher itself warns
        known = direct.graph.topic_names_and_types()
        warn_of_other_type("topic", topic, type_name(plan.kind), known)
        say_what_was_meant(topic, known)
    sender = direct.node.create_publisher(plan.kind, plan.topic_name, qos_profile)
    warn_if_unheard(direct.node, sender, tell)
    refused = _wait_for_subscriptions(direct, sender, plan.subscriptions, plan.max_wait_time)
    if refused is not None:
        return refused
    print("publisher: beginning loop")
    _loop(direct, sender, plan)
    if plan.times:
        direct.pause(plan.keep_alive)
    return None


def _documents(values: str, yaml_file: str | None) -> list[dict[str, Any]]:
    """Return the values of the messages on the command line.

    Raises:
        RuntimeError: The values are wrong, or their file cannot be read or is empty.
        yaml.YAMLError: The values are not YAML.
    """
    if yaml_file is None:
        return [read_values(values)]
    documents = list(read_msg_from_yaml(yaml_file))
    if not documents:
        raise RuntimeError(f"The file '{yaml_file}' holds no YAML document")
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
    direct: DirectNode, sender: Any, wanted: int, limit: float | None
) -> str | None:
    """Wait; return a message after a timeout."""
    deadline = None if limit is None else time.monotonic() + limit
    while (count := sender.get_subscription_count()) < wanted:
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
        direct.wait_for(lambda: sender.get_subscription_count() >= wanted, rest)
    return None


def _loop(direct: DirectNode, sender: Any, plan: _Plan) -> None:
    from rclpy.task import Future

    count = 0
    end = Future()

    def publish_next() -> None:
        nonlocal count
        if end.done():
            return
        message, stamps = plan.messages[count % len(plan.messages)]
        now = direct.node.get_clock().now().to_msg()
        # Stamps that the user wrote as `now`, or in a header `auto`.
        for stamp in stamps:
            stamp.sec, stamp.nanosec = now.sec, now.nanosec
        count += 1
        if count % plan.print_nth == 0:
            print(f"publishing #{count}: {message!r}\n")
        sender.publish(message)
        if count == plan.times:
            end.set_result(None)

    # At once, because the timer waits for a period.
    publish_next()
    timer = direct.node.create_timer(plan.period, publish_next)
    direct.result(end)
    direct.node.destroy_timer(timer)


class PubVerb(VerbExtension, module=__name__):
    """Publish messages to a topic."""
