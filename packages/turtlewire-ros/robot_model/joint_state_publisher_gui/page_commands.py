"""The commands of the page, see :mod:`turtlewire.web.commands`."""

from __future__ import annotations

from typing import NamedTuple

from turtlewire.web.commands import CommandReader


class Set(NamedTuple):
    """A new position of one joint [rad or m]."""

    joint: str
    position: float


class Randomize(NamedTuple):
    """A random position for each joint."""


class Center(NamedTuple):
    """Move each joint to its zero position."""


class Play(NamedTuple):
    """Start or stop moving the joints between their limits."""

    on: bool


Command = Set | Randomize | Center | Play

READER = CommandReader({"set": Set, "randomize": Randomize, "center": Center, "play": Play})
