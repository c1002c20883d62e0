"""The commands of a page, see :mod:`turtlewire.web.commands`."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from turtlewire.web.commands import Between, CommandReader

_Byte = Annotated[int, Between(0, 255)]


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


class PenChange(NamedTuple):
    """A turtle's pen: colour (0..255 each), width [pixels], lifted or not."""

    turtle: str
    r: _Byte
    g: _Byte
    b: _Byte
    width: _Byte
    off: bool


class Background(NamedTuple):
    """The colour of the field, 0..255 each."""

    r: _Byte
    g: _Byte
    b: _Byte


class Speed(NamedTuple):
    """Simulated seconds in a second; 0 pauses."""

    factor: Annotated[float, Between(0, 100)]


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
    | PenChange
    | Background
    | Speed
    | Clear
    | Reset
    | Watch
    | Unwatch
)
READER = CommandReader(
    {
        "drive": Drive,
        "rotate": Rotate,
        "cancel": Cancel,
        "spawn": Spawn,
        "teleport": Teleport,
        "kill": Kill,
        "pen": PenChange,
        "background": Background,
        "speed": Speed,
        "clear": Clear,
        "reset": Reset,
        "watch": Watch,
        "unwatch": Unwatch,
    }
)
