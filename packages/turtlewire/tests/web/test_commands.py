"""The commands of pages, and the answers to invalid ones."""

from __future__ import annotations

import json
from typing import Annotated, Any, NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.web import CommandSession
from turtlewire.web.commands import Between, CommandError, CommandReader


class Move(NamedTuple):
    turtle: str
    x: float
    on: bool = True


class Pen(NamedTuple):
    r: Annotated[int, Between(0, 255)]


class Speed(NamedTuple):
    factor: Annotated[float, Between(0, 100)]


class Load(NamedTuple):
    text: Annotated[str, Between(0, 3)]


class Show(NamedTuple):
    names: list[Any]
    options: dict[str, Any]
    target: str | None = None


class Clear(NamedTuple):
    pass


READER = CommandReader(
    {"move": Move, "pen": Pen, "speed": Speed, "load": Load, "show": Show, "clear": Clear}
)


@pytest.mark.parametrize(
    ("message", "command"),
    [
        ({"type": "move", "turtle": "t", "x": 2}, Move("t", 2.0)),
        ({"type": "move", "turtle": "", "x": -0.5, "on": False}, Move("", -0.5, False)),
        ({"type": "move", "turtle": "x" * 1024, "x": 1_000_000}, Move("x" * 1024, 1e6)),
        ({"type": "pen", "r": 0}, Pen(0)),
        ({"type": "pen", "r": 255.0}, Pen(255)),
        ({"type": "speed", "factor": 0}, Speed(0.0)),
        ({"type": "speed", "factor": 100}, Speed(100.0)),
        ({"type": "load", "text": "abc"}, Load("abc")),
        ({"type": "show", "names": [1], "options": {"a": []}}, Show([1], {"a": []})),
        ({"type": "show", "names": [], "options": {}, "target": None}, Show([], {})),
        ({"type": "show", "names": [], "options": {}, "target": "t"}, Show([], {}, "t")),
        ({"type": "clear"}, Clear()),
    ],
)
def test_commands(message, command):
    found = READER.read(json.dumps(message))
    assert found == command
    assert [type(found), *map(type, found)] == [type(command), *map(type, command)]


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "not JSON"),
        ("{", "not JSON"),
        (b"\xff\xfe\x00", "not JSON"),
        # Python 3.14 limits the depth by the size of the stack: it may reach the end of the text.
        ("[" * 60_000, "nested too deeply|Expecting value"),
        ('{"a":' * 10_000, "nested too deeply|Expecting value"),
        ("[1]", "an object whose type is one of move, pen, speed, load, show, clear"),
        ('{"turtle": "t", "x": 1}', "type is one of"),
        ('{"type": "explode"}', "type is one of"),
        ('{"type": ["move"]}', "type is one of"),
        ('{"type": "move"}', "move has turtle, x, on; got no fields"),
        ('{"type": "move", "x": 1}', "move has turtle, x, on; got x"),
        ('{"type": "clear", "x": 1}', "clear has no fields; got x"),
        ('{"type": "move", "turtle": 3, "x": 1}', "turtle must be a string of at most 1024"),
        ('{"type": "move", "turtle": null, "x": 1}', "turtle must be a string"),
        ('{"type": "move", "turtle": "' + 1025 * "x" + '", "x": 1}', "at most 1024 characters"),
        ('{"type": "load", "text": "abcd"}', "text must be a string of at most 3 characters"),
        (
            '{"type": "move", "turtle": "t", "x": NaN}',
            "x must be a number from -1000000 to 1000000",
        ),
        ('{"type": "move", "turtle": "t", "x": 1e400}', "x must be a number"),
        ('{"type": "move", "turtle": "t", "x": 1' + 400 * "0" + "}", "x must be a number"),
        ('{"type": "move", "turtle": "t", "x": 1000000.5}', "x must be a number"),
        ('{"type": "move", "turtle": "t", "x": true}', "x must be a number"),
        ('{"type": "move", "turtle": "t", "x": "1"}', "x must be a number"),
        ('{"type": "move", "turtle": "t", "x": 1, "on": 1}', "on must be true or false"),
        ('{"type": "pen", "r": 256}', "r must be a whole number from 0 to 255"),
        ('{"type": "pen", "r": -1}', "r must be a whole number from 0 to 255"),
        ('{"type": "pen", "r": 0.5}', "r must be a whole number from 0 to 255"),
        ('{"type": "speed", "factor": -0.01}', "factor must be a number from 0 to 100"),
        ('{"type": "speed", "factor": 100.01}', "factor must be a number from 0 to 100"),
        ('{"type": "show", "names": {}, "options": {}}', "names must be a list"),
        ('{"type": "show", "names": [], "options": null}', "options must be an object"),
        ('{"type": "show", "names": [], "options": {}, "target": 1}', "target must be a string"),
    ],
)
def test_invalid_commands(text, part):
    with pytest.raises(CommandError, match="(?s)" + part):
        READER.read(text)


@given(st.text() | st.binary())
def test_anything_else_is_one_error(text):
    with pytest.raises(CommandError):
        READER.read(text)


class Fragile(CommandSession):
    def news(self):
        return []

    def obey(self, command):
        raise ZeroDivisionError


def test_a_command_that_fails_is_answered_and_logged(caplog):
    session = Fragile(CommandReader({"clear": Clear}))
    session.receive('{"type": "clear"}')
    (answer,) = session.outgoing()
    expected = {"type": "error", "text": "This command failed; the log says why."}
    assert json.loads(answer) == expected
    assert "ZeroDivisionError" in caplog.text
