"""The commands of the page: JSON from the browser, checked and turned into plain tuples."""

from __future__ import annotations

import json
import math
from typing import Any, NamedTuple

__all__ = ["Center", "Command", "JointCommandError", "Play", "Randomize", "Set", "parse_command"]

#: Longest name that a page may send.
_MAX_NAME = 1024


class JointCommandError(ValueError):
    """The browser sent something that is not a command; the text says what is wrong."""


class Set(NamedTuple):
    """A new position of one joint [rad or m]."""

    joint: str
    position: float


class Randomize(NamedTuple):
    """A random position for each joint."""


class Center(NamedTuple):
    """Each joint at its zero."""


class Play(NamedTuple):
    """Whether the joints move between their limits by themselves."""

    on: bool


Command = Set | Randomize | Center | Play

_KINDS: tuple[type[Any], ...] = (Set, Randomize, Center, Play)
_COMMANDS = {kind.__name__.lower(): kind for kind in _KINDS}


def parse_command(text: str | bytes) -> Command:
    """Return the command in a message.

    An example: ``{"type": "set", "joint": "elbow", "position": 0.5}``.

    Raises:
        JointCommandError: The text is not JSON or too deeply nested, the type is unknown, or a
            field is missing, unknown or of the wrong kind.
    """
    try:
        message = json.loads(text)
    except ValueError as error:
        raise JointCommandError(f"not JSON: {error}") from error
    except RecursionError as error:
        raise JointCommandError("not a command: the JSON is nested too deeply") from error
    if (
        not isinstance(message, dict)
        or not isinstance(message.get("type"), str)
        or message["type"] not in _COMMANDS
    ):
        raise JointCommandError(f"expected an object whose type is one of {', '.join(_COMMANDS)}")
    kind = _COMMANDS[message.pop("type")]
    if message.keys() != set(kind._fields):
        expected, got = (", ".join(names) or "no fields" for names in (kind._fields, message))
        raise JointCommandError(f"{kind.__name__.lower()} has {expected}; got {got}")
    command: Command = kind(**{name: _checked(name, message[name]) for name in kind._fields})
    return command


def _checked(name: str, value: object) -> str | float | bool:
    if name == "on":
        if not isinstance(value, bool):
            raise JointCommandError("on is true or false")
        return value
    if name == "joint":
        if not isinstance(value, str) or len(value) > _MAX_NAME:
            raise JointCommandError(f"joint must be a string of at most {_MAX_NAME} characters")
        return value
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not _finite(value):
        raise JointCommandError("position is a finite number")
    return float(value)


def _finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond all floats
        return False
