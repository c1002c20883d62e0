"""The command line of a verb as data: each verb's module has a tuple ``ARGUMENTS``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterable

    Completer = Callable[..., list[str]]

__all__ = ["Argument", "Exclusive", "add_arguments", "argument", "exclusive"]


class Argument(NamedTuple):
    """An option or a positional argument."""

    names: tuple[str, ...]
    options: dict[str, Any]
    completer: Completer | None


class Exclusive(NamedTuple):
    """Arguments of which one may be given at most."""

    members: tuple[Argument, ...]
    required: bool


def argument(*names: str, completer: Completer | None = None, **options: Any) -> Argument:
    """An argument, described as for :meth:`argparse.ArgumentParser.add_argument`.

    Args:
        *names: Its flags, or one name.
        completer: Offers values to the shell.
        **options: Options of argparse: ``help``, ``type``, ``default`` and so on.
    """
    return Argument(names, options, completer)


def exclusive(*members: Argument, required: bool = False) -> Exclusive:
    """Arguments of which one may be given at most; exactly one if it is ``required``."""
    return Exclusive(members, required)


def add_arguments(
    parser: argparse.ArgumentParser, arguments: Iterable[Argument | Exclusive]
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
