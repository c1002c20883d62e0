"""Text from other processes cannot reach a terminal's controls.

Suggestions for names that do not exist.
"""

from __future__ import annotations

import sys

import pytest

from turtlewire.terminal.printable import printable, printable_lines
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wire.report import warn


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("/turtle1/pose", "/turtle1/pose"),
        ("Schildkröte 🐢 カメ", "Schildkröte 🐢 カメ"),
        ("\x1b[2J\x1b]0;owned\x07", r"\x1b[2J\x1b]0;owned\x07"),
        ("good\rbad", r"good\rbad"),
        ("one\ntwo\tthree", r"one\ntwo\tthree"),
        ("\x9b31m", r"\x9b31m"),  # the one-byte CSI of eight-bit terminals
        ("\x7f\x00", r"\x7f\x00"),
        ("\u202etxt.exe\u2069\u200f", r"\u202etxt.exe\u2069\u200f"),
        ("a\u200bb\ufeff\u2028", r"a\u200bb\ufeff\u2028"),
        ("\udc9b", r"\udc9b"),  # an undecodable byte, as os.fsdecode keeps it
        ("\U000e0041", r"\U000e0041"),
        ("1\u00a0000 👩\u200d🚀", "1\u00a0000 👩\u200d🚀"),
    ],
)
def test_printable(text: str, shown: str) -> None:
    assert printable(text) == shown


def test_lines_and_tabs_can_be_kept() -> None:
    assert printable_lines("one\n\ttwo\x1b[A\r") == "one\n\ttwo\\x1b[A\\r"


def test_no_character_leaves_a_control_behind() -> None:
    everything = "".join(map(chr, range(sys.maxunicode + 1)))
    left = {letter for letter in printable_lines(everything) if not letter.isprintable()}
    assert left == {"\n", "\t", "\u00a0", "\u3000", "\u200c", "\u200d"}


def test_a_warning_of_the_wire_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    warn("a peer on /\x1b[2J\n[INFO] is fine")
    assert capsys.readouterr().err.endswith(": a peer on /\\x1b[2J\\n[INFO] is fine\n")


@pytest.mark.parametrize(
    ("name", "known", "suggestion"),
    [
        ("/joint_state", ["/joint_states", "/tf_static", "/tf"], "Did you mean: /joint_states"),
        (
            "my_interface/msg/Foo",
            ["my_interfaces/msg/Foo", "example_interfaces/msg/Bool", "rcl_interfaces/msg/Log"],
            "Did you mean: my_interfaces/msg/Foo",
        ),
        ("turtle", ["turtle2", "turtle1"], "Did you mean: turtle2, turtle1"),
        ("x", ["turtle"], ""),
    ],
)
def test_names_much_less_similar_than_the_nearest_are_left_out(name, known, suggestion):
    assert did_you_mean(name, known) == suggestion
