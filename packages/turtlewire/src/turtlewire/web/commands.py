"""The commands of a page, and the server's side of one browser's connection.

Commands are JSON from the browser, checked and turned into tuples: objects with a ``type``. A kind
of command is a class of named tuples. Its annotations are the types of the fields: text,
true or false, numbers, lists or objects.
``Annotated[float, Between(0, 10)]`` narrows the size of a number or the length of a text. A field
with a default may be missing, and is null if the annotation is a union with None.

A page receives JSON, and packets, which also carry arrays (:mod:`turtlewire.web.packets`). The
answer to a wrong command is ``{"type": "error", "text": ...}``.
"""

from __future__ import annotations

import json
import logging
import sys
import typing
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, Protocol, TypeGuard

from turtlewire.terminal.printable import printable

if typing.TYPE_CHECKING:
    from collections.abc import Mapping


class CommandError(ValueError):
    """The browser sent something that is not a command; the text names the mistake."""


class Between(NamedTuple):
    """The least and the most that a field takes, both included."""

    least: float
    most: float


_LENGTHS = Between(0, 1024)
_NUMBERS = Between(-1_000_000, 1_000_000)
_WORDS = {bool: "true or false", list: "a list", dict: "an object"}


def is_finite_number(value: object) -> TypeGuard[float]:
    """Return True if a value of JSON or YAML is a number, and not too large for a float."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return -sys.float_info.max <= value <= sys.float_info.max  # also False for NaN


class CommandReader:
    """Reads commands of some kinds.

    Args:
        kinds: Classes of named tuples, by the ``type`` of the command.
    """

    def __init__(self, kinds: Mapping[str, type[Any]]) -> None:
        self._kinds = dict(kinds)
        self._fields = {
            name: typing.get_type_hints(kind, include_extras=True) for name, kind in kinds.items()
        }

    def read(self, text: str | bytes) -> Any:
        """Return the command in a message, such as ``{"type": "kill", "turtle": "turtle1"}``.

        Raises:
            CommandError: The text is not JSON or too deeply nested, the type is unknown, or a
                field is missing, unknown or of the wrong kind.
        """
        try:
            message = json.loads(text)
        except ValueError as error:
            raise CommandError(f"not JSON: {error}") from error
        except RecursionError as error:
            raise CommandError("not a command: the JSON is nested too deeply") from error
        name = message.pop("type", None) if isinstance(message, dict) else None
        if not isinstance(name, str) or name not in self._kinds:
            known = ", ".join(self._kinds)
            raise CommandError(f"expected an object whose type is one of {known}")
        kind, fields = self._kinds[name], self._fields[name]
        optional = kind._field_defaults.keys()
        if not fields.keys() - optional <= message.keys() <= fields.keys():
            expected, got = (", ".join(names) or "no fields" for names in (fields, message))
            raise CommandError(f"{name} has {expected}; got {got}")
        return kind(**{each: _checked(each, fields[each], message[each]) for each in message})


def _checked(name: str, hint: Any, value: Any) -> Any:
    """Return a field's value.

    Raises:
        CommandError: The field does not accept the value.
    """
    limits = None
    if typing.get_origin(hint) is Annotated:
        hint, limits = typing.get_args(hint)
    if isinstance(hint, UnionType):  # with None
        if value is None:
            return None
        (hint,) = set(typing.get_args(hint)) - {NoneType}
    kind = typing.get_origin(hint) or hint
    if kind in (int, float):
        return _number(name, kind, limits or _NUMBERS, value)
    if kind is str:
        return _text(name, limits or _LENGTHS, value)
    if not isinstance(value, kind):
        raise CommandError(f"{name} must be {_WORDS[kind]}")
    return value


def _number(name: str, kind: type[int | float], limits: Between, value: Any) -> int | float:
    is_within = is_finite_number(value) and limits.least <= value <= limits.most
    if not is_within or kind(value) != value:
        word = "number" if kind is float else "whole number"
        raise CommandError(
            f"{name} must be a {word} from {limits.least:.15g} to {limits.most:.15g}"
        )
    return kind(value)


def _text(name: str, limits: Between, value: Any) -> str:
    if not isinstance(value, str) or not len(value) <= limits.most:
        raise CommandError(f"{name} must be a string of at most {limits.most:.15g} characters")
    return value


_logger = logging.getLogger(__name__)


class PageSession(Protocol):
    """One browser's connection. The server's thread calls all methods, so they must be short."""

    def outgoing(self) -> list[str | bytes]:
        """Return the messages that this browser does not have yet.

        Called after :meth:`turtlewire.web.Server.notify`, and only when the browser has taken the
        last messages: values that became outdated in between are never sent, so a slow browser
        sees fewer frames, not old ones.
        """
        ...

    def receive(self, message: str | bytes) -> None:
        """Take a message of the browser; the session answers a wrong one itself."""
        ...

    def closed(self) -> None:
        """The browser has disconnected."""
        ...


class CommandSession:
    """A session that takes commands, and answers those that make no sense.

    Args:
        reader: Reads the commands.
    """

    def __init__(self, reader: CommandReader) -> None:
        self._reader = reader
        self._answers: list[str | bytes] = []

    def outgoing(self) -> list[str | bytes]:
        """Return the answers and the news."""
        answers, self._answers = self._answers, []
        return [*answers, *self.news()]

    def receive(self, message: str | bytes) -> None:
        """Carry out a command, or answer why not."""
        try:
            self.obey(self._reader.read(message))
        except CommandError as error:
            self.refuse(error)
        except Exception:  # it would close the connection: the page would lose all that it shows
            _logger.exception("A command of a page failed")
            self.answer({"type": "error", "text": "This command failed; the log says why."})

    def refuse(self, error: Exception) -> None:
        """Answer that something went wrong."""
        self.answer({"type": "error", "text": printable(str(error))})

    def answer(self, fields: dict[str, Any]) -> None:
        """Send an answer as soon as the browser has taken the last messages."""
        self._answers.append(json.dumps(fields))

    def news(self) -> list[str | bytes]:
        """Return the messages that this browser does not have yet, except answers."""
        raise NotImplementedError

    def obey(self, command: Any) -> None:
        """Carry out a command.

        Raises:
            CommandError: The command cannot be carried out; the text is the answer.
        """
        raise NotImplementedError

    def closed(self) -> None:
        """The browser has disconnected."""
