"""``ros2 action type``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.completion import action_names
from ros2cli.discovery import GraphNode

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    argument(
        "action_name",
        help="Name of the action, for example /turtle1/rotate_absolute",
        completer=action_names,
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the type; status 1 when there is no such action."""
    from ros2cli.graph import actions
    from ros2cli.suggestion import say_what_was_meant

    with GraphNode() as graph:
        known = dict(actions(graph))
    types = known.get(args.action_name, [])
    for name in types:
        print(name)
    say_what_was_meant(args.action_name, known)
    return 0 if types else 1
