"""``ros2 interface show``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, exclusive
from ros2cli.completion import interfaces
from ros2cli.helpers import OPTIONAL, interactive_select
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2interface.verb import VerbExtension
from turtlewire.msg.parser import without_comment

if TYPE_CHECKING:
    from turtlewire.msg.definition import Field, MessageDefinition

#: The line between the parts of a service or action.
SERVICE_REQUEST_RESPONSE_SEPARATOR = ACTION_REQUEST_RESPONSE_SEPARATOR = "---"
_SEPARATORS = (SERVICE_REQUEST_RESPONSE_SEPARATOR, ACTION_REQUEST_RESPONSE_SEPARATOR)


class ReadStdinPipe(argparse.Action):
    """Takes the value of an argument; ``-`` stands for the first line of stdin."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        option_string: str | None = None,
    ) -> None:
        """Set the value; the program ends with its usage if stdin has no value."""
        del option_string
        if values == "-":
            if sys.stdin is None or sys.stdin.isatty():
                parser.error("expected stdin pipe")
            values = sys.stdin.readline().strip()
            if not values:
                parser.error("the passed value is empty")
        setattr(namespace, self.dest, values)


ARGUMENTS = (
    argument(
        "type",
        action=ReadStdinPipe,
        nargs=OPTIONAL,
        help="Name of the interface, for example geometry_msgs/msg/Twist; '-' reads it from stdin",
        completer=interfaces,
    ),
    exclusive(
        argument(
            "--all-comments",
            action="store_true",
            help="Also show the comments of nested interfaces",
        ),
        argument("--no-comments", action="store_true", help="Without comments and blank lines"),
        JSON_ARGUMENT,
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the definition; fields of nested messages follow theirs, indented by a tab."""
    if args.type is None:
        name = interactive_select(interfaces(), "Select interface to show:")
        if name is None:
            return "No interface selected"
    else:
        name = args.type
    try:
        if args.json:
            print_json(_data(name))
            return None
        for line in _lines(
            name, comments=not args.no_comments, nested_comments=args.all_comments, depth=0
        ):
            print(line)
    except (LookupError, OSError, ValueError) as error:
        from ros2cli.suggestion import interface_meant

        kind = "ValueError: " if isinstance(error, ValueError) else ""
        return f"{kind}{error.args[-1]}{interface_meant(name)}"
    return None


class InterfaceTextLine:
    """One line of a definition.

    Args:
        pkg_name: Package of the interface.
        msg_name: Name of the interface.
        line_text: The line.
    """

    def __init__(self, pkg_name: str, msg_name: str, line_text: str) -> None:
        self._package = pkg_name
        self._name = msg_name
        self._text = line_text

    def __str__(self) -> str:
        return self._text

    @property
    def nested_type(self) -> str | None:
        """The message that the line has a field of, such as ``std_msgs/msg/Header``; or None."""
        words = without_comment(self._text).split()
        if len(words) < 2 or "=" in words[1][:1] or words[0].startswith(_SEPARATORS):
            return None
        kind = words[0].partition("[")[0].partition("<")[0]
        if not kind or not (kind.split("/")[-1][0].isupper()):
            return None
        parts = kind.split("/")
        if len(parts) == 1:
            # As in ROS 2, `Header` alone is that of std_msgs.
            owner = "std_msgs" if kind == "Header" else self._package
            return f"{owner}/msg/{kind}"
        return f"{parts[0]}/msg/{parts[-1]}"

    @property
    def trailing_comment(self) -> str | None:
        """The comment behind a field or constant, with its sign; None without one."""
        before = without_comment(self._text)
        return self._text[len(before) :].strip() or None if before.strip() else None

    def is_comment(self) -> bool:
        """Return True if the line is a comment and nothing else."""
        return self._text.lstrip().startswith("#")

    def is_trailing_comment(self) -> bool:
        """Return True if a comment follows a field or constant."""
        return self.trailing_comment is not None


def _lines(name: str, *, comments: bool, nested_comments: bool, depth: int) -> Iterator[str]:
    from rosidl_runtime_py import get_interface_path

    with open(get_interface_path(name), encoding="utf-8") as file:
        text = file.read()
    package, _, own_name = name.partition("/")
    for line in text.splitlines():
        shown = line.rstrip() if comments else without_comment(line).rstrip()
        if comments or shown:
            yield "\t" * depth + shown if shown else ""
        nested = InterfaceTextLine(package, own_name, line).nested_type
        if nested is not None:
            yield from _lines(
                nested,
                comments=comments and nested_comments,
                nested_comments=nested_comments,
                depth=depth + 1,
            )


def _data(name: str) -> dict[str, Any]:
    from rosidl_runtime_py import get_interface_path
    from turtlewire.msg.definition import ActionDefinition, MessageDefinition
    from turtlewire.msg.registry import load_interface

    get_interface_path(name)  # raises ROS 2's errors
    definition = load_interface(name.partition(".")[0])
    if isinstance(definition, MessageDefinition):
        return {"interface": definition.full_name, **_contents(definition)}
    parts = (
        ("goal", "result", "feedback")
        if isinstance(definition, ActionDefinition)
        else ("request", "response")
    )
    contents = {part: _contents(getattr(definition, part)) for part in parts}
    return {"interface": definition.full_name, **contents}


def _contents(definition: MessageDefinition) -> dict[str, Any]:
    from turtlewire.msg.types import type_in_msg_file

    constants = [
        {"name": each.name, "type": type_in_msg_file(each.type), "value": each.value}
        for each in definition.constants
    ]
    return {"fields": [_field(each) for each in definition.fields], "constants": constants}


def _field(field: Field) -> dict[str, Any]:
    from turtlewire.msg.registry import load_message
    from turtlewire.msg.types import AbstractNestedType, NamespacedType, type_in_msg_file

    data = {"name": field.name, "type": type_in_msg_file(field.type), "default": field.default}
    inner = field.type.value_type if isinstance(field.type, AbstractNestedType) else field.type
    if isinstance(inner, NamespacedType):
        data |= {"interface": inner.full_name, **_contents(load_message(inner.full_name))}
    return data


class ShowVerb(VerbExtension, module=__name__):
    """Show the definition of an interface."""
