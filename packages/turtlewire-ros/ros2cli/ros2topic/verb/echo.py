"""``ros2 topic echo``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import topic_names, topic_types
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.output import tell
from ros2cli.qos_options import QOS_ARGUMENTS, asked_for, matching_publishers, with_options
from ros2cli.values import positive_float, unsigned_int
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from ros2cli.node.direct import DirectNode

__all__ = ["ARGUMENTS", "DEFAULT_TRUNCATE_LENGTH", "EchoVerb", "main", "make_filter"]

DEFAULT_TRUNCATE_LENGTH = 128

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument("topic_name", help="Name of the topic, for example /tf", completer=topic_names),
    argument(
        "message_type",
        nargs="?",
        help="Type of the messages (default: the topic's type)",
        completer=topic_types,
    ),
    *QOS_ARGUMENTS,
    argument(
        "--csv", action="store_true", help="One line of comma-separated values for each message"
    ),
    argument("--field", metavar="FIELD", help="Only this field, for example pose.position.x"),
    argument("-f", "--full-length", action="store_true", help="Do not shorten arrays and strings"),
    argument(
        "-l",
        "--truncate-length",
        type=unsigned_int,
        default=DEFAULT_TRUNCATE_LENGTH,
        help="Length to which arrays and strings are shortened",
    ),
    argument("--no-arr", action="store_true", help="Show only the types of arrays"),
    argument("--no-str", action="store_true", help="Show only the lengths of strings"),
    argument("--flow-style", action="store_true", help="Write sequences on one line"),
    argument(
        "--lost-messages",
        action="store_true",
        help="Accepted for compatibility: lost messages are reported by default",
    ),
    argument("--no-lost-messages", action="store_true", help="Do not report lost messages"),
    argument("--raw", action="store_true", help="Show the bytes of the messages"),
    argument(
        "--filter",
        dest="filter_expr",
        metavar="FILTER-EXPR",
        help="Only messages m for which this Python expression is true",
    ),
    argument("--once", action="store_true", help="End after the first message"),
    argument(
        "--timeout", metavar="N", type=positive_float, help="End after N seconds without messages"
    ),
    argument(
        "-i",
        "--include-message-info",
        action="store_true",
        help="Show when a message was sent and received",
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the messages until there is an end."""
    from rclpy.impl.unheard import warn_if_silent
    from rclpy.task import Future
    from ros2cli.node.direct import DirectNode
    from ros2cli.suggestion import say_what_was_meant, warn_of_other_type
    from ros2topic.api import message_class, type_of_topic
    from turtlewire.msg import type_name

    if args.message_type is not None:
        message_class(args.message_type)  # refused before anything is started
    keep = make_filter(args.filter_expr)
    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = (
            type_of_topic(direct, topic)
            if args.message_type is None
            else message_class(args.message_type)
        )
        if kind is None:
            raise RuntimeError("Could not determine the type for the passed topic")
        if not direct.node.count_publishers(topic):  # of publishers the subscription will warn
            known = direct.graph.topic_names_and_types()
            warn_of_other_type("topic", topic, type_name(kind), known)
            say_what_was_meant(topic, known)
        _check_field(kind, args.field)
        qos = (
            with_options(args, "sensor_data")
            if asked_for(args)
            else matching_publishers(direct.graph, topic)
        )
        end = Future()
        printer = _Printer(args, keep, end)
        direct.node.create_subscription(
            kind, topic, printer.show, qos, raw=args.raw, event_callbacks=_lost(args)
        )
        printer.end_after_silence(direct)
        warn_if_silent(direct.node, topic, tell)
        direct.result(end)
    return None


class _Printer:
    """Shows messages as the options say."""

    def __init__(
        self, args: argparse.Namespace, keep: Callable[[Any], bool] | None, end: Any
    ) -> None:
        self._args = args
        self._keep = keep
        self._end = end
        self._timer: Any = None

    def end_after_silence(self, direct: DirectNode) -> None:
        """Apply ``--timeout``."""
        if self._args.timeout is not None:
            self._timer = direct.node.create_timer(self._args.timeout, self._finish)

    def _finish(self) -> None:
        if not self._end.done():
            self._end.set_result(None)

    def show(self, message: Any, info: dict[str, Any]) -> None:
        """Print one message."""
        if self._end.done() or (self._keep is not None and not self._keep(message)):
            return
        if self._timer is not None:
            self._timer.reset()
        value = _field(message, self._args.field)
        self._print(value, info if self._args.include_message_info else {})
        if self._args.once:
            self._finish()

    def _print(self, value: Any, info: dict[str, Any]) -> None:
        """Print a value, after the information about its message if there is any."""
        args = self._args
        length = None if args.full_length else args.truncate_length
        if args.raw or not hasattr(value, "SLOT_TYPES"):
            if info:
                print(f"---Got new message, message info:---\n{info}\n---Message data:---")
            print(value, end="\n" if args.csv else "\n---\n")
        elif args.csv:
            from rosidl_runtime_py import message_to_csv

            text = message_to_csv(
                value, truncate_length=length, no_arr=args.no_arr, no_str=args.no_str
            )
            print(",".join([*map(str, info.values()), text]))
        else:
            import yaml

            from rosidl_runtime_py import message_to_yaml

            text = message_to_yaml(
                value,
                truncate_length=length,
                no_arr=args.no_arr,
                no_str=args.no_str,
                flow_style=args.flow_style,
            )
            if info:
                print(yaml.dump(info), end="---\n")
            print(text, end="---\n")


def _field(message: Any, path: str | None) -> Any:
    """Return a field of a message: names joined by dots, with indices in brackets.

    Raises:
        RuntimeError: The field does not exist.
    """
    for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path or ""):
        try:
            message = getattr(message, name) if name else message[int(index)]
        except (AttributeError, IndexError, TypeError) as error:  # noqa: PERF203
            from ros2cli.suggestion import field_meant

            raise RuntimeError(f"Invalid field '{path}': {error}{field_meant(error)}") from error
    return message


def _check_field(kind: Any, path: str | None) -> None:
    """Refuse a field that no message of the type has, before the first one arrives."""
    if path is not None and "[" not in path:
        _field(kind(), path)


def make_filter(expression: str | None) -> Callable[[Any], bool] | None:
    """Return a predicate over messages from a Python expression in ``m``.

    Raises:
        RuntimeError: ``expression`` is not a Python expression.
    """
    if expression is None:
        return None
    try:
        code = compile(expression, "<filter>", "eval")
    except SyntaxError as error:
        raise RuntimeError(f"Invalid filter expression '{expression}': {error}") from error
    # The expression is the user's own, as a Python program would be.
    return lambda message: bool(eval(code, {}, {"m": message}))  # noqa: S307


def _lost(args: argparse.Namespace) -> Any:
    if args.no_lost_messages:
        return None
    from rclpy.event_handler import SubscriptionEventCallbacks

    def report(status: Any) -> None:
        print(
            f"A message was lost!!!\n\ttotal count change:{status.total_count_change}\n"
            f"\ttotal count: {status.total_count}",
            end="---\n",
        )

    return SubscriptionEventCallbacks(message_lost=report)


@verb_of_module
class EchoVerb(VerbExtension):
    """Show the messages of a topic."""
