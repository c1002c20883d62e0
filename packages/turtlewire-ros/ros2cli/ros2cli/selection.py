"""Lets the user choose a missing argument, in Lyrical: a topic, a node, a package.

Up to Kilted, argparse refuses such a command line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.helpers import interactive_select
from ros2cli.output import tell
from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

#: The number of words, for argparse, of an argument that can be chosen: at most one, or one.
OPTIONAL = "?" if since(LYRICAL) else None


def select_topic(graph: Graph, prompt: str) -> str | None:
    """Let the user choose a topic; returns None without topics or without a choice."""
    from ros2cli.graph import topics

    return _select("topics", [name for name, _ in topics(graph)], prompt)


def select_node(graph: Graph, prompt: str) -> str | None:
    """Let the user choose a node; returns None without nodes or without a choice."""
    from ros2cli.graph import node_names

    return _select("nodes", list(dict.fromkeys(node_names(graph))), prompt)


def _select(kind: str, names: list[str], prompt: str) -> str | None:
    if not names:
        tell(f"No {kind} available to select from.")
        return None
    return interactive_select(names, prompt)
