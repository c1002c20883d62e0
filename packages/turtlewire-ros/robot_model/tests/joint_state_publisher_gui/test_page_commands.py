"""What a page may send."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from joint_state_publisher_gui.page_commands import (
    Center,
    JointCommandError,
    Play,
    Randomize,
    Set,
    parse_command,
)


@pytest.mark.parametrize(
    ("text", "command"),
    [
        ('{"type": "set", "joint": "a", "position": 1}', Set("a", 1.0)),
        ('{"type": "randomize"}', Randomize()),
        ('{"type": "center"}', Center()),
        ('{"type": "play", "on": true}', Play(True)),
    ],
)
def test_commands(text, command):
    assert parse_command(text) == command


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "nested too deeply"),
        ("[]", "expected an object whose type is one of set, randomize, center, play"),
        ('{"type": "reset"}', "expected an object"),
        ('{"type": "set", "joint": "a"}', "set has joint, position; got joint"),
        ('{"type": "set", "joint": 1, "position": 1}', "joint must be a string"),
        ('{"type": "set", "joint": "a", "position": NaN}', "position is a finite number"),
        (
            '{"type": "set", "joint": "a", "position": 1%s}' % ("0" * 400),
            "position is a finite number",
        ),
        ('{"type": "play", "on": 1}', "on is true or false"),
    ],
)
def test_unknown_page_commands(text, error):
    with pytest.raises(JointCommandError, match=error):
        parse_command(text)


@given(st.text() | st.binary())
def test_anything_else_is_one_error(text):
    with pytest.raises(JointCommandError):
        parse_command(text)
