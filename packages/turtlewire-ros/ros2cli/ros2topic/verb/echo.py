"""``ros2 topic echo``."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, positive_float
from ros2cli.completion import topic_names, topic_types
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.helpers import OPTIONAL, select_topic
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.message_text import DEFAULT_TRUNCATE_LENGTH, TEXT_ARGUMENTS, message_csv, message_yaml
from ros2cli.output import clear_terminal, tell
from ros2cli.qos import QOS_ARGUMENTS, choose_qos
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
    from ros2cli.node.direct import DirectNode

__all__ = [
    "ARGUMENTS",
    "DEFAULT_TRUNCATE_LENGTH",
    "EchoVerb",
    "clear_terminal",
    "main",
    "make_filter",
]

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "topic_name",
        nargs=OPTIONAL,
        help="Name of the topic, for example /tf",
        completer=topic_names,
    ),
    argument(
        "message_type",
        nargs="?",
        help="Type of the messages (default: the topic's type)",
        completer=topic_types,
    ),
    *QOS_ARGUMENTS,
    argument(
        "--field",
        dest="fields",
        metavar="FIELD",
        action="append",
        default=[],
        help="Only this field, for example pose.position.x or ranges.[0]; may be repeated",
    ),
    *TEXT_ARGUMENTS,
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
    argument("-c", "--clear", action="store_true", help="Clear the terminal before each message"),
    argument("-n", "--node-name", help="Name of the listening node"),
    JSON_ARGUMENT,
)

#: Options that change the text of a message; JSON shows decoded messages whole, in one format.
_TEXT_ONLY = ("csv", "flow_style", "no_arr", "no_str", "raw", "clear")


def main(args: argparse.Namespace) -> str | None:
    """Print the messages until there is an end."""
    from ros2cli.node.direct import DirectNode
    from ros2cli.suggestion import say_what_was_meant, warn_of_other_type
    from ros2topic.api import message_class, type_of_topic
    from turtlewire.msg import type_name

    if told := _refused(args):
        return told
    # Wrong words are rejected before anything is started.
    if args.message_type is not None:
        message_class(args.message_type)
    make_filter(args.filter_expr)
    with DirectNode(args, node_name=args.node_name) as direct:
        name = args.topic_name or select_topic(direct.graph, "Select topic to echo:")
        if name is None:
            return None
        topic = direct.node.resolve_topic_name(name)
        kind = (
            type_of_topic(direct, topic, as_json=args.json)
            if args.message_type is None
            else message_class(args.message_type)
        )
        if kind is None:
            raise RuntimeError("Could not determine the type for the passed topic")
        if not direct.node.count_publishers(topic):  # otherwise the subscription itself warns
            known = direct.graph.topic_names_and_types()
            warn_of_other_type("topic", topic, type_name(kind), known)
            say_what_was_meant(topic, known)
        for field in args.fields:
            _check_field(kind, field)
        _print_messages(direct, topic, kind, choose_qos(direct, topic, args), args)
    return None


def _print_messages(
    direct: DirectNode, topic: str, kind: Any, qos: QoSProfile, args: argparse.Namespace
) -> None:
    from rclpy.impl.unheard import warn_if_silent
    from rclpy.task import Future

    end = Future()
    printer = _Printer(args, make_filter(args.filter_expr), end)
    subscription = direct.node.create_subscription(
        kind, topic, printer.show, qos, raw=args.raw, event_callbacks=_lost(args)
    )
    printer.end_after_silence(direct)
    warn_if_silent(direct.node, topic, tell)
    try:
        direct.result(end)
    finally:
        direct.node.destroy_subscription(subscription)


def _refused(args: argparse.Namespace) -> str | None:
    """Return an error if an option does not apply to JSON; None otherwise."""
    found = [f"--{name.replace('_', '-')}" for name in _TEXT_ONLY if getattr(args, name)]
    if args.truncate_length != DEFAULT_TRUNCATE_LENGTH:
        found.append("--truncate-length")
    if not args.json or not found:
        return None
    return (
        f"Cannot specify both --json and {' or '.join(found)}: --json prints each message whole, "
        "as one JSON object per line"
    )


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
        if self._args.clear:
            clear_terminal()
        if self._args.json:
            self._print_json(message, info)
        else:
            self._print_text(message, info)
        if self._args.once:
            self._finish()

    def _print_json(self, message: Any, info: dict[str, Any]) -> None:
        fields = {field: _field(message, field) for field in self._args.fields}
        shown = fields or message
        print_json({"info": info, "message": shown} if self._args.include_message_info else shown)

    def _print_text(self, message: Any, info: dict[str, Any]) -> None:
        values = [_field(message, field) for field in self._args.fields] or [message]
        for index, value in enumerate(values):
            # The information precedes the first field.
            self._print(value, info if self._args.include_message_info and index == 0 else {})
        if not self._args.csv:
            print("---")

    def _print(self, value: Any, info: dict[str, Any]) -> None:
        """Print a value, after the information about its message if there is any."""
        args = self._args
        # A field may be a plain value.
        if args.raw or not hasattr(value, "SLOT_TYPES"):
            if info:
                print(f"---Got new message, message info:---\n{info}\n---Message data:---")
            print(value)
        elif args.csv:
            print(",".join([*map(str, info.values()), message_csv(value, args)]))
        else:
            text = message_yaml(value, args)
            if info:
                import yaml

                print(yaml.dump(info), end="---\n")
            print(text, end="")


def _field(message: Any, path: str) -> Any:
    """Return a field of a message: names joined by dots, with indices in brackets.

    Raises:
        RuntimeError: The field does not exist.
    """
    for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path):
        try:
            message = getattr(message, name) if name else message[int(index)]
        except (AttributeError, IndexError, TypeError) as error:  # noqa: PERF203
            from ros2cli.suggestion import field_meant

            raise RuntimeError(f"Invalid field '{path}': {error}{field_meant(error)}") from error
    return message


def _check_field(kind: Any, path: str) -> None:
    """Reject a field that no message of the type has, before the first one arrives."""
    # An index may be valid in a message, but not in the empty sequence of a default value.
    if "[" not in path:
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
        text = (
            f"A message was lost!!!\n\ttotal count change:{status.total_count_change}\n"
            f"\ttotal count: {status.total_count}"
        )
        if args.json:
            tell(text)
        else:
            print(text, end="---\n")

    return SubscriptionEventCallbacks(message_lost=report)


class EchoVerb(VerbExtension, module=__name__):
    """Show the messages of a topic."""

    def choose_qos(self, node: Any, args: argparse.Namespace) -> QoSProfile:
        """Return the quality of service that fits the publishers of the topic of ``args``."""
        from ros2cli.node.direct import DirectNode

        direct = DirectNode.around(node)
        return choose_qos(direct, direct.node.resolve_topic_name(args.topic_name), args)

    def subscribe_and_spin(
        self,
        node: Any,
        topic_name: str,
        message_type: Any,
        qos_profile: QoSProfile,
        no_report_lost_messages: bool,
        raw: bool,
    ) -> None:
        """Print the messages of a topic, as without options, until Ctrl-C.

        Args:
            node: The node that subscribes, which the caller owns.
            topic_name: Name of the topic.
            message_type: Class of the messages.
            qos_profile: Quality of service of the subscription.
            no_report_lost_messages: Whether lost messages are not reported.
            raw: Whether the bytes of the messages are printed.

        Raises:
            KeyboardInterrupt: At Ctrl-C.
        """
        import argparse

        from ros2cli.node.direct import DirectNode

        parser = argparse.ArgumentParser()
        self.add_arguments(parser, "ros2 topic echo")
        args = parser.parse_args([topic_name])
        args.raw, args.no_lost_messages = raw, no_report_lost_messages
        direct = DirectNode.around(node)
        topic = direct.node.resolve_topic_name(topic_name)
        _print_messages(direct, topic, message_type, qos_profile, args)
