"""The class of ``ros2 node info``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.builtin import BuiltinVerb
from ros2node.api import INFO_NONUNIQUE_WARNING_TEMPLATE
from ros2node.verb import VerbExtension

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["INFO_NONUNIQUE_WARNING_TEMPLATE", "InfoVerb", "print_names_and_types"]


class InfoVerb(BuiltinVerb, VerbExtension):
    """Show what a node publishes, subscribes to and offers."""

    _module = "node.info"


def print_names_and_types(names_and_types: Iterable[tuple[str, list[str]]]) -> None:
    """Print topics, services or actions with their types, indented."""
    for name, types in names_and_types:
        print(f"    {name}: {', '.join(types)}")
