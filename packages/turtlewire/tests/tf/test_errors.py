"""Attributes of errors."""

from __future__ import annotations

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest

import turtlewire
from turtlewire import errors

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
        ("map", "turtle2", None),
        ("map", "palm", None),
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


def test_explain_returns_what_a_lookup_raises_between_two_times(
    buffer: turtlewire.Buffer,
) -> None:
    for child in ("target", "source"):
        buffer.set_transform("fixed", child, SECOND, NO_MOVE, NO_TURN)
        buffer.set_transform("fixed", child, 2 * SECOND, NO_MOVE, NO_TURN)
    names: Any = ("target", "source", 5 * SECOND)
    how: Any = {"fixed_frame": "fixed", "target_stamp_ns": 7 * SECOND}
    with pytest.raises(errors.ExtrapolationException, match=r"Requested time 5\.") as caught:
        buffer.lookup_transform(*names, **how)
    reason = buffer.explain(*names, **how)
    assert (type(reason), str(reason)) == (errors.ExtrapolationException, str(caught.value))
    # As in tf2, whose canTransform begins with the half of the target.
    assert "Requested time 7." in buffer._can_transform_reason(*names, **how)


def test_copies_keep_the_hint_and_the_attributes(buffer: turtlewire.Buffer) -> None:
    """A copy in another process cannot ask the buffer any more."""
    for error in failures(buffer):
        for again in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
            assert (type(again), str(again)) == (type(error), str(error))
            assert again.hint == error.hint != ""
            assert attributes(again) == attributes(error)
    assert "turtle1" in pickle.loads(pickle.dumps(failures(buffer)[0])).hint


def hint_of(call: Any, *arguments: Any, **keywords: Any) -> str:
    with pytest.raises(errors.TurtlewireError) as caught:
        call(*arguments, **keywords)
    return caught.value.hint


def test_a_quaternion_of_zeros(buffer: turtlewire.Buffer) -> None:
    advice = (
        "A rotation is a quaternion of length 1 in the order x, y, z, w; leave it out, or pass "
        "(0, 0, 0, 1), for no rotation."
    )
    with pytest.raises(errors.InvalidTransformError) as caught:
        buffer.set_transform("a", "b", 1, NO_MOVE, (0, 0, 0, 0))
    assert (caught.value.reason, caught.value.hint) == ("zero quaternion", advice)
    assert str(caught.value).startswith("TF_NAN_INPUT: Ignoring transform for child_frame_id")
    hint = hint_of(buffer.set_transforms, "a", "b", [1, 2], np.zeros((2, 7)))
    assert hint == f"It is row 0 of the batch. {advice}"
    with pytest.raises(errors.InvalidTransformError) as caught:
        buffer.set_transform("a", "b", 1, (float("nan"), 0, 0), NO_TURN)
    assert caught.value.reason == "nan"


def test_frames_with_a_slash_or_without_a_name(buffer: turtlewire.Buffer) -> None:
    buffer.set_static_transform("map", "b", NO_MOVE)
    assert hint_of(buffer.lookup_transform, "/map", "b") == "Write 'map', without the slash."
    assert hint_of(buffer.lookup_transform, "map", "") == "Name a frame."
    assert hint_of(buffer.lookup_transform, "/", "b") == "Name a frame."


@pytest.mark.parametrize(
    ("stamps", "asked", "advice"),
    [
        ((1, 2, 5), 3, "Times are in nanoseconds: for 3 s, write 3_000_000_000."),
        ((1, 2, 5), 8, "Times are in nanoseconds: for 8 s, write 8_000_000_000."),
        ((1, 2, 5), 0, "0 is a time; leave out the time to get the latest."),
        (
            (1_700_000_000, 1_700_000_004),
            3,
            (
                "Times are in nanoseconds: for 3 s, write 3_000_000_000; the data begins at "
                "1_700_000_000_000_000_000."
            ),
        ),
        (
            (1_700_000_000, 1_700_000_004),
            1_700_000_003,
            "Times are in nanoseconds: for 1700000003 s, write 1_700_000_003_000_000_000.",
        ),
        (
            (1_700_000_000, 1_700_000_004),
            1_700_000_003_500,
            ("Times are in nanoseconds: for 1700000003500 ms, write 1_700_000_003_500_000_000."),
        ),
        (
            (1_700_000_000, 1_700_000_004),
            1_700_000_003_500_000,
            ("Times are in nanoseconds: for 1700000003500000 us, write 1_700_000_003_500_000_000."),
        ),
        ((0, 4e-9), 3 * SECOND, "Stamps are in nanoseconds: is the newest one, 4, in seconds?"),
    ],
)
def test_times_in_another_unit(
    buffer: turtlewire.Buffer, stamps: tuple[float, ...], asked: int, advice: str
) -> None:
    for stamp in stamps:
        buffer.set_transform("map", "base", round(stamp * 10**9), NO_MOVE, NO_TURN)
    assert hint_of(buffer.lookup_transform, "map", "base", asked).endswith(f" {advice}")
    assert hint_of(buffer.lookup_transforms, "map", "base", [asked]).endswith(f" {advice}")


@pytest.mark.parametrize(
    ("first", "asked"),
    [
        (1, SECOND // 2),
        (1, 3 * SECOND),
        (1, 3_000_000),
        (-5, 0),
        (1_700_000_000, 1_699_999_000 * SECOND),
        (1_700_000_000, 5 * SECOND),
        (-1, SECOND),
    ],
)
def test_times_in_nanoseconds(buffer: turtlewire.Buffer, first: int, asked: int) -> None:
    for stamp in (first, first + 1):
        buffer.set_transform("map", "base", stamp * SECOND, NO_MOVE, NO_TURN)
    hint = hint_of(buffer.lookup_transform, "map", "base", asked)
    assert " sample of the transform from 'base' to 'map' is " in hint
    assert "nanoseconds" not in hint
    assert "0 is a time" not in hint


def test_calls_that_can_fill_with_nan_say_so(buffer: turtlewire.Buffer) -> None:
    for stamp in (1, 2):
        buffer.set_transform("map", "base", stamp * SECOND, NO_MOVE, NO_TURN)
    for stamps in ([SECOND, 9 * SECOND], [SECOND // 2]):
        for call, *arguments in (
            (buffer.lookup_transforms, stamps),
            (buffer.transform_points, np.zeros((len(stamps), 3)), stamps),
            (buffer.lookup_velocity, stamps),
        ):
            hint = hint_of(call, "map", "base", *arguments)
            assert hint.endswith(" Pass errors='nan' to get NaN where the data does not reach.")
            assert "timeout" not in hint
    hint = hint_of(buffer.lookup_transform, "map", "base", 9 * SECOND)
    assert "errors=" not in hint
    assert "Give the lookup a timeout" in hint


def test_calls_without_a_timeout_do_not_advise_one() -> None:
    buffer = turtlewire.Buffer()
    for stamp in (1, 2):
        buffer.set_transform("map", "base", stamp * SECOND, NO_MOVE, NO_TURN)
    for call, *arguments in (
        (buffer.lookup_velocity, 9 * SECOND),
        (buffer.transform_points, np.zeros((1, 3)), 9 * SECOND),
    ):
        hint = hint_of(call, "map", "base", *arguments)
        assert "s older than the requested time. Pass errors='nan'" in hint
        assert "timeout" not in hint


def test_a_loop_of_frames(buffer: turtlewire.Buffer) -> None:
    for parent, child in (("a", "b"), ("b", "a"), ("b", "c"), ("map", "base")):
        buffer.set_transform(parent, child, SECOND, NO_MOVE, NO_TURN)
    with pytest.raises(errors.LookupException, match="contains a loop") as caught:
        buffer.lookup_transform("map", "c")
    assert caught.value.hint == (
        "A frame is below itself. Swap parent and child of the transform that closes the loop; "
        "turtlewire.Buffer.problems() names the frames."
    )


def test_a_frame_whose_transforms_were_refused() -> None:
    buffer = turtlewire.Buffer()
    buffer.set_transform("map", "base", 1, NO_MOVE, NO_TURN)
    for time in (1, 2):
        with pytest.raises(errors.InvalidTransformError):
            buffer.set_transform("map", "arm", time, (math.nan, 0, 0), NO_TURN)
    hint = hint_of(buffer.lookup_transform, "map", "arm")
    assert hint.startswith(
        "Refused transforms of 'arm': 2; the last: TF_NAN_INPUT: Ignoring transform for"
    )
    assert hint_of(buffer.lookup_transform, "map", "leg") == "The frames are 'base', 'map'."


def test_a_frame_that_arrives_before_the_hint_is_read() -> None:
    buffer = turtlewire.Buffer()
    buffer.set_static_transform("map", "base", NO_MOVE)
    with pytest.raises(errors.LookupException) as caught:
        buffer.lookup_transform("map", "leg")
    buffer.set_static_transform("base", "leg", NO_MOVE)
    assert caught.value.hint == "'leg' arrived just after this lookup; a timeout waits for it."


def test_an_empty_buffer() -> None:
    buffer = turtlewire.Buffer()
    assert hint_of(buffer.lookup_transform, "map", "base") == "No transform was set yet."
    for time in (1, 2):
        with pytest.raises(errors.InvalidTransformError):
            buffer.set_transform("base", "base", time, NO_MOVE, NO_TURN)
    with pytest.raises(errors.CdrError):
        buffer.add_tf_message(b"")
    hint = hint_of(buffer.lookup_transform, "map", "base")
    assert hint.startswith("Refused transforms and malformed messages: 3; for example, TF_SELF_")
    assert hint.endswith(" turtlewire.Buffer.problems() lists them.")
    with turtlewire.connect("one", middleware="local") as net:
        assert "has arrived yet" in hint_of(net.transforms().lookup_transform, "map", "base")


def test_an_error_that_no_buffer_raised_has_empty_attributes() -> None:
    error = errors.ExtrapolationException("late")
    assert (error.reason, error.target_frame, error.requested_ns, error.hint) == ("", "", None, "")
