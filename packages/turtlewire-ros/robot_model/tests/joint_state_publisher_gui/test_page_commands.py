"""The commands of a page."""

from __future__ import annotations

import pytest

from joint_state_publisher_gui.page_commands import READER, Center, Play, Randomize, Set
from turtlewire.web.commands import CommandError


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
    assert READER.read(text) == command


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("[]", "expected an object whose type is one of set, randomize, center, play"),
        ('{"type": "set", "joint": "a", "position": NaN}', "position must be a number from"),
        ('{"type": "play", "on": 1}', "on must be true or false"),
    ],
)
def test_unknown_page_commands(text, error):
    with pytest.raises(CommandError, match=error):
        READER.read(text)
