"""The commands of pages."""

from __future__ import annotations

import json

import pytest

from turtlesim.page_commands import (
    READER,
    Background,
    Cancel,
    Clear,
    Drive,
    Kill,
    PenChange,
    Reset,
    Rotate,
    Spawn,
    Speed,
    Teleport,
    Unwatch,
    Watch,
)
from turtlewire.web.commands import CommandError


@pytest.mark.parametrize(
    ("message", "command"),
    [
        (
            {"type": "drive", "turtle": "turtle1", "linear": 2, "angular": -0.5},
            Drive("turtle1", 2.0, -0.5),
        ),
        ({"type": "rotate", "turtle": "turtle1", "theta": 3.1416}, Rotate("turtle1", 3.1416)),
        ({"type": "cancel", "turtle": "turtle1"}, Cancel("turtle1")),
        ({"type": "spawn", "x": 1.5, "y": 2, "theta": 0, "name": ""}, Spawn(1.5, 2.0, 0.0, "")),
        (
            {"type": "teleport", "turtle": "t", "x": 1, "y": 2, "theta": 3},
            Teleport("t", 1.0, 2.0, 3.0),
        ),
        ({"type": "kill", "turtle": "t"}, Kill("t")),
        ({"type": "clear"}, Clear()),
        ({"type": "reset"}, Reset()),
        (
            {"type": "watch", "target": "turtle2", "source": "", "axes": True},
            Watch("turtle2", "", True),
        ),
        (
            {"type": "pen", "turtle": "t", "r": 255, "g": 0, "b": 7, "width": 3, "off": False},
            PenChange("t", 255, 0, 7, 3, False),
        ),
        ({"type": "background", "r": 1, "g": 2, "b": 3}, Background(1, 2, 3)),
        ({"type": "speed", "factor": 0.25}, Speed(0.25)),
        ({"type": "unwatch"}, Unwatch()),
    ],
)
def test_commands(message, command):
    parsed = READER.read(json.dumps(message))
    assert parsed == command
    assert type(parsed) is type(command)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        (
            "[1]",
            (
                "type is one of drive, rotate, cancel, spawn, teleport, kill, pen, background, "
                "speed, clear, reset, watch, unwatch"
            ),
        ),
        ('{"type": "background", "r": 256, "g": 0, "b": 0}', "r must be a whole number from 0 to"),
        ('{"type": "speed", "factor": -0.1}', "factor must be a number from 0 to 100"),
        ('{"type": "speed", "factor": 100.1}', "factor must be a number from 0 to 100"),
    ],
)
def test_invalid_commands(text, part):
    with pytest.raises(CommandError, match=part):
        READER.read(text)
