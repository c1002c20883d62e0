"""The command line of a verb as data: each verb's module has a tuple ``ARGUMENTS``."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from ros2cli.values import positive_float

if TYPE_CHECKING:
    Completer = Callable[..., list[str]]


# Plain classes: a NamedTuple takes half a millisecond of each command to make.
class Argument:
    """An option or a positional argument."""

    def __init__(
        self, names: tuple[str, ...], options: dict[str, Any], completer: Completer | None
    ) -> None:
        self.names = names
        self.options = options
        self.completer = completer


class Exclusive:
    """Arguments of which one may be given at most."""

    def __init__(self, members: tuple[Argument, ...], *, required: bool) -> None:
        self.members = members
        self.required = required


def argument(*names: str, completer: Completer | None = None, **options: Any) -> Argument:
    """Return an argument, described as for :meth:`argparse.ArgumentParser.add_argument`.

    Args:
        *names: Its flags, or one name.
        completer: Offers values to the shell.
        **options: Options of argparse: ``help``, ``type``, ``default`` and so on.
    """
    return Argument(names, options, completer)


def exclusive(*members: Argument, required: bool = False) -> Exclusive:
    """Return the arguments of which one may be given at most; exactly one if it is ``required``."""
    return Exclusive(members, required=required)


def timeout_argument(default: float | None = None) -> Argument:
    """Return the option ``--timeout`` of verbs that wait for the answer of a node.

    Args:
        default: Seconds; None waits while the node exists.
    """
    shown = "no limit" if default is None else default
    return argument(
        "--timeout",
        metavar="N",
        type=positive_float,
        default=default,
        help=f"Wait at most N seconds for each answer (default: {shown})",
    )


def add_arguments(
    parser: argparse._ActionsContainer, arguments: Iterable[Argument | Exclusive]
) -> None:
    """Define a command line."""
    for item in arguments:
        if isinstance(item, Exclusive):
            group = parser.add_mutually_exclusive_group(required=item.required)
            for member in item.members:
                _add(group, member)
        else:
            _add(parser, item)


def _add(parser: argparse._ActionsContainer, item: Argument) -> None:
    action = parser.add_argument(*item.names, **item.options)
    if item.completer is not None:
        action.completer = item.completer  # type: ignore[attr-defined]  # argcomplete's convention
