"""Shared parts of the verbs ``list``, ``find`` and ``type``."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.json_lines import print_json, print_json_list, with_types

if TYPE_CHECKING:
    from ros2cli.arguments import Argument
    from ros2cli.graph import NamesAndTypes

SHOW_TYPES = argument("-t", "--show-types", action="store_true", help="Also show the types")
HIDDEN_NODES = "Include nodes whose name starts with an underscore"


def count_argument(kind: str) -> Argument:
    """Return the option ``--count-topics`` for the kind ``topic``, and so on, as ``count``."""
    return argument(
        "-c",
        f"--count-{kind}s",
        dest="count",
        action="store_true",
        help="Show only their number",
    )


def hidden_argument(kind: str) -> Argument:
    """Return the option ``--include-hidden-topics`` for the kind ``topic``, and so on."""
    return argument(
        f"--include-hidden-{kind}s",
        action="store_true",
        help=f"Include {kind}s with a name part that starts with an underscore",
    )


def print_names_of_type(
    found: NamesAndTypes, type_name: str, kind: str, args: argparse.Namespace
) -> None:
    """Print the names that have a type, or how many there are.

    Without results, stderr says which interfaces of the kind (``msg`` or ``srv``) are meant.
    """
    from ros2cli.suggestion import say_interface_meant

    of_type = [name for name, types in found if type_name in types]
    print_names(of_type, args)
    if not of_type:
        say_interface_meant(type_name, kind)


def print_names(names: list[str], args: argparse.Namespace) -> None:
    """Print the names, or how many there are."""
    for line in [len(names)] if args.count else names:
        print(line)


def print_names_and_types(kind: str, found: NamesAndTypes, args: argparse.Namespace) -> None:
    """Print the topics, services or actions, with types if asked for, or how many there are.

    Args:
        kind: ``topic``, ``service`` or ``action``.
        found: The names and their types.
        args: The command line.
    """
    if args.json:
        print_json_list(with_types(kind, found), args)
        return
    shown = [f"{name} [{', '.join(types)}]" if args.show_types else name for name, types in found]
    print_names(shown, args)


def print_types(
    kind: str, name: str, known: Mapping[str, list[str]], *, as_json: bool = False
) -> int:
    """Print the types of a topic, service or action.

    Returns:
        The exit status: 1 if the name is not known, and stderr says which are.
    """
    from ros2cli.suggestion import say_what_there_is

    if name not in known:
        say_what_there_is(kind, name, known)
        return 1
    if as_json:
        print_json({kind: name, "types": known[name]})
        return 0
    for type_name in known[name]:
        print(type_name)
    return 0
