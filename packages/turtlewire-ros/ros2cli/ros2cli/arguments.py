"""The command line of a verb as data, and the values on it.

Each verb's module has a tuple ``ARGUMENTS``.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    Completer = Callable[..., list[str]]

_Number = TypeVar("_Number", int, float)

#: How many values YAML aliases may add to the values that are written out.
_MOST_COPIES = 100_000
_LONGEST_ERROR = 1000


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


def read_values(text: str) -> dict[str, Any]:
    """Return the mapping in a YAML string; an empty string gives an empty mapping.

    Raises:
        RuntimeError: The text is not a mapping, contains an invalid date, or is too large because
            of aliases or nesting.
        yaml.YAMLError: The text is not YAML, or has several documents.
    """
    import yaml

    return next(_mappings(text, lambda: [yaml.safe_load(text)]), {})


def read_documents(text: str) -> list[dict[str, Any]]:
    """Return the mappings in a stream of YAML documents, without empty documents.

    Raises:
        RuntimeError: As in `read_values`, for any of them.
        yaml.YAMLError: The text is not YAML.
    """
    import yaml

    return list(_mappings(text, lambda: list(yaml.safe_load_all(text))))


def _mappings(text: str, load: Callable[[], list[Any]]) -> Iterator[dict[str, Any]]:
    try:
        documents = load()
        size = _size(documents, {})
    except RecursionError:
        raise RuntimeError("The passed value is nested too deeply") from None
    except ValueError as error:
        raise RuntimeError(f"The passed value holds what looks like a date: {error}") from None
    # Each value that is written out has its own character; the list of documents has none.
    if size - 1 > len(text) + _MOST_COPIES:
        raise RuntimeError("The aliases of the passed value expand to too many values")
    for values in documents:
        if isinstance(values, dict):
            yield values
        elif values is not None:
            raise RuntimeError("The passed value needs to be a dictionary in YAML format")


def _size(value: Any, known: dict[int, float]) -> float:
    """Count the values in ``value`` with its YAML aliases expanded."""
    parts = value.values() if isinstance(value, dict) else value
    if not isinstance(value, (dict, list)):
        return 1
    if id(value) not in known:
        known[id(value)] = float("inf")  # a value that contains itself is infinite
        known[id(value)] = 1 + sum(_size(part, known) for part in parts)
    return known[id(value)]


def shortened(error: object) -> str:
    """Return the text of an error, cut where it quotes a value of any length."""
    text = str(error)
    return text if len(text) <= _LONGEST_ERROR else f"{text[:_LONGEST_ERROR]}..."


def assignment(text: str) -> tuple[str, str]:
    """Return the name and value of ``name:=value``, for argparse."""
    name, separator, value = text.partition(":=")
    if not separator or not name:
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form name:=value")
    return name, value


def positive_float(inval: str) -> float:
    """Return a number above zero, for argparse."""
    value = float(inval)
    if not value > 0:
        raise argparse.ArgumentTypeError("value must be positive")
    return value


def regular_expression(text: str) -> str:
    """Return a regular expression on the command line.

    Raises:
        argparse.ArgumentTypeError: The text is not a regular expression.
    """
    import re

    try:
        re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not a regular expression: {error}") from None
    return text


def positive(type_: Callable[[str], _Number]) -> Callable[[str], _Number]:
    """Return a function that reads a number above zero, for argparse.

    Args:
        type_: ``int`` or ``float``.
    """

    def number(string: str) -> _Number:
        value = type_(string)
        if not value > 0:
            raise argparse.ArgumentTypeError("value must be positive")
        return value

    # argparse names the function in its error for other texts.
    number.__name__ = f"positive_{getattr(type_, '__name__', 'number')}"
    return number


positive_int = positive(int)


def unsigned_int(inval: str) -> int:
    """Return a whole number from zero, for argparse."""
    value = int(inval)
    if value < 0:
        raise argparse.ArgumentTypeError("value must be non-negative integer")
    return value
