"""The option ``--json``: one JSON object per line, for programs.

docs/reference/ros2_json.md lists the keys of each verb.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.output import tell

if TYPE_CHECKING:
    from ros2cli.graph import NamesAndTypes

JSON_ARGUMENT = argument("--json", action="store_true", help="Print one JSON object per line")


def print_json(data: Any) -> None:
    """Print a dictionary or a message as one line of JSON.

    Args:
        data: The values may be messages or fields of messages; see
            `turtlewire.msg.json_messages.json_value`.
    """
    import json

    from turtlewire.msg.json_messages import json_value

    line = json.dumps(json_value(data), allow_nan=False)
    # The output escapes this control character in Python's way, which is not JSON.
    print(line.replace("\x7f", "\\u007f"))


def print_json_list(rows: Sequence[Mapping[str, Any]], args: argparse.Namespace) -> None:
    """Print each row as a line, or the number of rows if the command line asks for the count."""
    for row in [{"count": len(rows)}] if args.count else rows:
        print_json(row)


def remark_printer(*, as_json: bool) -> Callable[[str], None]:
    """Return the function that prints a remark: to stdout as in ROS 2, or to stderr beside JSON."""
    return tell if as_json else print


def with_types(kind: str, found: NamesAndTypes) -> list[dict[str, Any]]:
    """Return a row for each name.

    Args:
        kind: The key of the name: ``topic``, ``service``, ``action`` or ``node``.
        found: The names and their types.
    """
    return [{kind: name, "types": types} for name, types in found]
