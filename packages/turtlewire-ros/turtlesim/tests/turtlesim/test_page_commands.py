"""What pages may send, and what they are told when they send something else."""

from __future__ import annotations

import json

import pytest

from turtlesim.page_commands import (
    Background,
    Cancel,
    Clear,
    Drive,
    Kill,
    Pen,
    Reset,
    Rotate,
    Spawn,
    Speed,
    Teleport,
    TurtleCommandError,
    Unwatch,
    Watch,
    parse_command,
)


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
            Pen("t", 255, 0, 7, 3, False),
        ),
        ({"type": "background", "r": 1, "g": 2, "b": 3}, Background(1, 2, 3)),
        ({"type": "speed", "factor": 0.25}, Speed(0.25)),
        ({"type": "unwatch"}, Unwatch()),
    ],
)
def test_commands(message, command):
    parsed = parse_command(json.dumps(message))
    assert parsed == command
    assert type(parsed) is type(command)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "not JSON"),
        ("{", "not JSON"),
        (b"\xff\xfe\x00", "not JSON"),
        ("[" * 60_000, "nested too deeply"),
        ('{"a":' * 10_000, "nested too deeply"),
        (
            "[1]",
            (
                "type is one of drive, rotate, cancel, spawn, teleport, kill, pen, background, "
                "speed, clear, reset, watch, unwatch"
            ),
        ),
        ('{"type": "explode"}', "type is one of"),
        ('{"type": ["drive"]}', "type is one of"),
        ('{"type": "kill"}', "kill has turtle; got no fields"),
        ('{"type": "clear", "x": 1}', "clear has no fields; got x"),
        ('{"type": "kill", "turtle": 3}', "turtle must be a string"),
        ('{"type": "kill", "turtle": "' + 300 * "x" + '"}', "at most 255"),
        ('{"type": "drive", "turtle": "t", "linear": NaN, "angular": 0}', "linear is a number"),
        ('{"type": "drive", "turtle": "t", "linear": 1e400, "angular": 0}', "linear is a number"),
        (
            '{"type": "drive", "turtle": "t", "linear": 1' + 400 * "0" + ', "angular": 0}',
            "linear is a number between -1000000 and 1000000",
        ),
        ('{"type": "drive", "turtle": "t", "linear": true, "angular": 0}', "linear is a number"),
        ('{"type": "drive", "turtle": "t", "linear": 0, "angular": "1"}', "angular is a number"),
        ('{"type": "background", "r": 256, "g": 0, "b": 0}', "r is a whole number between 0 and"),
        ('{"type": "background", "r": 0.5, "g": 0, "b": 0}', "r is a whole number between 0 and"),
        ('{"type": "speed", "factor": -1}', "factor is a number between 0 and 100"),
        ('{"type": "speed", "factor": 101}', "factor is a number between 0 and 100"),
        ('{"type": "watch", "target": "", "source": "", "axes": 1}', "axes is true or false"),
    ],
)
def test_invalid_commands(text, part):
    with pytest.raises(TurtleCommandError, match="(?s)" + part.replace("(", r"\(")):
        parse_command(text)
