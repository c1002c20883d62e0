"""``ros2 interface show``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from ros2cli.arguments import argument, exclusive
from ros2cli.builtin import verb_of_module
from ros2cli.completion import interfaces
from ros2interface.verb import VerbExtension
from turtlewire.msg.parser import without_comment

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator

__all__ = ["ARGUMENTS", "ShowVerb", "main"]


ARGUMENTS = (
    argument(
        "type",
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
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the definition; fields of nested messages follow theirs, indented by a tab."""
    name = sys.stdin.readline().strip() if args.type == "-" else args.type
    try:
        for line in _lines(
            name, comments=not args.no_comments, nested_comments=args.all_comments, depth=0
        ):
            print(line)
    except (LookupError, OSError, ValueError) as error:
        from ros2cli.suggestion import interface_meant

        kind = "ValueError: " if isinstance(error, ValueError) else ""
        return f"{kind}{error.args[-1]}{interface_meant(name)}"
    return None


def _lines(name: str, *, comments: bool, nested_comments: bool, depth: int) -> Iterator[str]:
    from rosidl_runtime_py import get_interface_path

    with open(get_interface_path(name), encoding="utf-8") as file:
        text = file.read()
    for line in text.splitlines():
        shown = line.rstrip() if comments else without_comment(line).rstrip()
        if comments or shown:
            yield "\t" * depth + shown if shown else ""
        nested = _nested(line, name.partition("/")[0])
        if nested is not None:
            yield from _lines(
                nested,
                comments=comments and nested_comments,
                nested_comments=nested_comments,
                depth=depth + 1,
            )


def _nested(line: str, package: str) -> str | None:
    """Name of the message that a line has a field of, if any."""
    words = without_comment(line).split()
    if len(words) < 2 or "=" in words[1][:1] or words[0].startswith("---"):
        return None
    kind = words[0].partition("[")[0].partition("<")[0]
    if not kind or not (kind.split("/")[-1][0].isupper()):
        return None
    parts = kind.split("/")
    if len(parts) == 1:
        owner = "std_msgs" if kind == "Header" else package
        return f"{owner}/msg/{kind}"
    return f"{parts[0]}/msg/{parts[-1]}"


@verb_of_module
class ShowVerb(VerbExtension):
    """Show the definition of an interface."""
