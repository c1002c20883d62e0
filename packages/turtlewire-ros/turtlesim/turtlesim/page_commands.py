"""The commands of a page: JSON from the browser, checked and turned into plain tuples."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

__all__ = [
    "Background",
    "Cancel",
    "Clear",
    "Command",
    "Drive",
    "Kill",
    "Pen",
    "Reset",
    "Rotate",
    "Spawn",
    "Speed",
    "Teleport",
    "TurtleCommandError",
    "Unwatch",
    "Watch",
    "parse_command",
]

#: All other fields are numbers.
_TEXT_FIELDS = frozenset({"turtle", "name", "target", "source"})
_FLAG_FIELDS = frozenset({"axes", "off"})
#: Whole numbers up to 255.
_BYTE_FIELDS = frozenset({"r", "g", "b", "width"})
#: Largest speed that a page may ask for.
_LARGEST_FACTOR = 100.0
#: Longest name that a page may send.
_MAX_NAME = 255
#: Largest number that a page may send, positive or negative.
_LARGEST_NUMBER = 1_000_000


class TurtleCommandError(ValueError):
    """The browser sent something that is not a command; the text names the mistake."""


class Drive(NamedTuple):
    """One velocity command: metres per second ahead, radians per second to the left."""

    turtle: str
    linear: float
    angular: float


class Rotate(NamedTuple):
    """A rotation to the heading theta [rad]."""

    turtle: str
    theta: float


class Cancel(NamedTuple):
    """The end of a rotation that was asked for in the page."""

    turtle: str


class Spawn(NamedTuple):
    """A new turtle at (x, y) [m] with heading theta [rad]; an empty name is replaced."""

    x: float
    y: float
    theta: float
    name: str


class Teleport(NamedTuple):
    """A turtle's new place (x, y) [m] and heading theta [rad]."""

    turtle: str
    x: float
    y: float
    theta: float


class Kill(NamedTuple):
    """The end of a turtle."""

    turtle: str


class Pen(NamedTuple):
    """A turtle's pen: colour (0..255 each), width [pixels], lifted or not."""

    turtle: str
    r: int
    g: int
    b: int
    width: int
    off: bool


class Background(NamedTuple):
    """The colour of the field, 0..255 each."""

    r: int
    g: int
    b: int


class Speed(NamedTuple):
    """Simulated seconds in a second; 0 pauses."""

    factor: float


class Clear(NamedTuple):
    """An empty picture."""


class Reset(NamedTuple):
    """The world as it was at the start."""


class Watch(NamedTuple):
    """Send the frames, and the transform between two of them; empty names: no transform.

    With ``axes``, the places of the frames in the field come with each tick.
    """

    target: str
    source: str
    axes: bool


class Unwatch(NamedTuple):
    """Stop sending frames."""


Command = (
    Drive
    | Rotate
    | Cancel
    | Spawn
    | Teleport
    | Kill
    | Pen
    | Background
    | Speed
    | Clear
    | Reset
    | Watch
    | Unwatch
)
_KINDS: tuple[type[Any], ...] = (
    Drive,
    Rotate,
    Cancel,
    Spawn,
    Teleport,
    Kill,
    Pen,
    Background,
    Speed,
    Clear,
    Reset,
    Watch,
    Unwatch,
)
_COMMANDS = {kind.__name__.lower(): kind for kind in _KINDS}


def parse_command(text: str | bytes) -> Command:
    """Return the command in a message.

    An example: ``{"type": "drive", "turtle": "turtle1", "linear": 2.0, "angular": 0.0}``.

    Raises:
        TurtleCommandError: The text is not JSON or too deeply nested, the type is unknown, or a
            field is missing, unknown or of the wrong kind.
    """
    try:
        message = json.loads(text)
    except ValueError as error:
        raise TurtleCommandError(f"not JSON: {error}") from error
    except RecursionError as error:
        raise TurtleCommandError("not a command: the JSON is nested too deeply") from error
    if (
        not isinstance(message, dict)
        or not isinstance(message.get("type"), str)
        or message["type"] not in _COMMANDS
    ):
        raise TurtleCommandError(f"expected an object whose type is one of {', '.join(_COMMANDS)}")
    kind = _COMMANDS[message.pop("type")]
    if message.keys() != set(kind._fields):
        expected, got = (", ".join(names) or "no fields" for names in (kind._fields, message))
        raise TurtleCommandError(f"{kind.__name__.lower()} has {expected}; got {got}")
    command: Command = kind(**{name: _checked(name, message[name]) for name in kind._fields})
    return command


def _checked(name: str, value: object) -> str | float | bool:
    if name in _FLAG_FIELDS:
        if not isinstance(value, bool):
            raise TurtleCommandError(f"{name} is true or false")
        return value
    if name in _TEXT_FIELDS:
        if not isinstance(value, str) or len(value) > _MAX_NAME:
            raise TurtleCommandError(f"{name} must be a string of at most {_MAX_NAME} characters")
        return value
    if (
        isinstance(value, bool)
        or not isinstance(value, (int, float))
        or not abs(value) <= _LARGEST_NUMBER  # true for NaN, too
    ):
        raise TurtleCommandError(
            f"{name} is a number between -{_LARGEST_NUMBER} and {_LARGEST_NUMBER}"
        )
    if name in _BYTE_FIELDS and not (value == int(value) and 0 <= value <= 255):
        raise TurtleCommandError(f"{name} is a whole number between 0 and 255")
    if name == "factor" and not 0.0 <= value <= _LARGEST_FACTOR:
        raise TurtleCommandError(f"factor is a number between 0 and {_LARGEST_FACTOR:.0f}")
    return int(value) if name in _BYTE_FIELDS else float(value)
