"""Errors of the engine travel between processes with their hints."""

from __future__ import annotations

import pickle
import sys
import traceback

import pytest
from tests.places import GOLDEN

from turtlewire import Buffer
from turtlewire.errors import BagError, LookupException, WireError
from turtlewire.trajectory import Trajectory


@pytest.mark.parametrize(
    "error", [LookupException("no frame"), WireError("no network"), BagError("no bag")]
)
def test_a_pickled_error_keeps_the_hint_that_it_was_given(error):
    copy = pickle.loads(pickle.dumps(error.with_hint("Start a broadcaster.")))
    assert (type(copy), str(copy)) == (type(error), str(error))
    assert copy.hint == "Start a broadcaster."


@pytest.mark.parametrize(
    ("text", "hint", "line"),
    [
        ("no network", "", "no network"),
        ("no network", "Plug it in.", "no network. Plug it in."),
        ("no network?", "Plug\nit in.", "no network? Plug it in."),
    ],
)
def test_text_and_hint_in_one_line(text, hint, line):
    assert WireError(text).with_hint(hint).in_one_line() == line


@pytest.mark.skipif(sys.version_info < (3, 11), reason="exceptions have no notes")
def test_a_traceback_shows_the_hint():
    path = GOLDEN / "bag" / "d_mcap"
    for call, hint in (
        (lambda: Buffer.from_bag(path, topics=["/tf", "/tff"]), "Topics of type tf2_msgs"),
        (
            lambda: Trajectory.from_bag(path, "/odm"),
            "Did you mean: /odom. Topics with poses: /goal",
        ),
    ):
        with pytest.raises(BagError) as caught:
            call()
        assert hint in caught.value.hint
        assert hint not in str(caught.value)
        assert f"\n{hint}" in "".join(traceback.format_exception(caught.value))


def test_a_pickled_error_keeps_the_hint_that_only_the_buffer_could_give():
    buffer = Buffer()
    buffer.set_transform("world", "robot", 1, (0, 0, 0), (0, 0, 0, 1))
    with pytest.raises(LookupException) as caught:
        buffer.lookup_transform("world", "robto")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert "robot" in caught.value.hint
    assert copy.hint == caught.value.hint
