"""What errors carry beyond their text."""

from __future__ import annotations

import copy
import pickle
from typing import TYPE_CHECKING

import pytest

from turtlewire import errors

if TYPE_CHECKING:
    import turtlewire

SECOND = 1_000_000_000
NO_MOVE = (0.0, 0.0, 0.0)
NO_TURN = (0.0, 0.0, 0.0, 1.0)


def failures(buffer: turtlewire.Buffer) -> list[errors.TransformException]:
    """One error of each kind that has attributes."""
    for stamp in (1, 2):
        buffer.set_transform("map", "turtle1", stamp * SECOND, NO_MOVE, NO_TURN)
    buffer.set_transform("island", "palm", SECOND, NO_MOVE, NO_TURN)
    found = []
    for target, source, stamp in (
        ("map", "turtle2", 0),
        ("map", "palm", 0),
        ("map", "turtle1", SECOND // 2),
        ("map", "turtle1", 3 * SECOND),
        ("island", "palm", 3 * SECOND),
    ):
        with pytest.raises(errors.TransformException) as caught:
            buffer.lookup_transform(target, source, stamp)
        found.append(caught.value)
    return found


def attributes(error: errors.TransformException) -> dict[str, object]:
    return {name: value for name, value in vars(error).items() if not name.startswith("_")}


def test_attributes(buffer: turtlewire.Buffer) -> None:
    unknown, unconnected, early, late, lonely = failures(buffer)
    assert attributes(unknown)["frame"] == "turtle2"
    assert (
        attributes(unconnected).items()
        >= {
            "target_frame": "map",
            "source_frame": "palm",
            "target_root": "map",
            "source_root": "island",
        }.items()
    )
    assert (
        attributes(early).items()
        >= {
            "reason": "past",
            "target_frame": "map",
            "source_frame": "turtle1",
            "parent_frame": "map",
            "child_frame": "turtle1",
            "requested_ns": SECOND // 2,
            "oldest_ns": SECOND,
            "newest_ns": 2 * SECOND,
        }.items()
    )
    assert (attributes(late)["reason"], attributes(late)["requested_ns"]) == ("future", 3 * SECOND)
    assert (attributes(lonely)["reason"], attributes(lonely)["parent_frame"]) == (
        "no data",
        "island",
    )
    assert {type(error) for error in (early, late, lonely)} == {errors.ExtrapolationException}


def test_copies_keep_the_hint_and_the_attributes(buffer: turtlewire.Buffer) -> None:
    """A copy in another process cannot ask the buffer any more."""
    for error in failures(buffer):
        for again in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
            assert (type(again), str(again)) == (type(error), str(error))
            assert again.hint == error.hint != ""
            assert attributes(again) == attributes(error)
    assert "turtle1" in pickle.loads(pickle.dumps(failures(buffer)[0])).hint


def test_an_error_that_no_buffer_raised_has_empty_attributes() -> None:
    error = errors.ExtrapolationException("late")
    assert (error.reason, error.target_frame, error.requested_ns, error.hint) == ("", "", 0, "")
