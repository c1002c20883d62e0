"""Errors of arguments say what was given and what to write; both cores use the same words."""

from __future__ import annotations

import datetime as dt
import math
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import turtlewire

SECOND = 1_000_000_000
DATE = dt.datetime.fromisoformat("2026-05-01")
STAMPS = np.arange(5) * SECOND
STAMPS_ARE = "stamps must be integers of nanoseconds or numpy.datetime64, not "
TRANSLATION_IS = "translation must have 3 numbers (x, y, z in metres), "
ROTATION_IS = "rotation must have 4 numbers (a quaternion x, y, z, w), "
STAMP_IS = "stamp_ns must be an int of nanoseconds or a numpy.datetime64, not "


@pytest.fixture
def filled(buffer: turtlewire.Buffer) -> turtlewire.Buffer:
    for second in range(5):
        buffer.set_transform("world", "turtle", second * SECOND, (second, 2, 0))
    return buffer


def text_of(kind: type[Exception], call: Any, *arguments: Any, **keywords: Any) -> str:
    with pytest.raises(kind) as caught:
        call(*arguments, **keywords)
    assert type(caught.value) is kind
    return str(caught.value)


@pytest.mark.parametrize(
    ("stamps", "rest"),
    [
        (STAMPS / 1e9, "float64; for seconds, write np.round(seconds * 1e9).astype(np.int64)"),
        ([1.5], "float64; for seconds, write np.round(seconds * 1e9).astype(np.int64)"),
        (1.5, "float64; for seconds, write np.round(seconds * 1e9).astype(np.int64)"),
        (["2026-05-01"], "str; write np.array(stamps, dtype='datetime64[ns]')"),
        ([DATE], "datetime; write np.array(stamps, dtype='datetime64[ns]')"),
        (
            np.array([1], dtype="m8[s]"),
            "timedelta64[s]; write stamps.astype('timedelta64[ns]').astype(np.int64)",
        ),
        ([True], "bool"),
        ([None], "NoneType"),
    ],
)
def test_stamps_of_another_type(filled: turtlewire.Buffer, stamps: Any, rest: str) -> None:
    poses = np.tile([0, 0, 0, 0, 0, 0, 1], (len(np.atleast_1d(stamps)), 1))
    for call, *arguments in (
        (filled.lookup_transforms, stamps),
        (filled.set_transforms, stamps, poses),
        (filled.transform_points, poses[:, :3], stamps),
        (filled.lookup_velocity, stamps),
    ):
        assert text_of(TypeError, call, "world", "turtle", *arguments) == STAMPS_ARE + rest


def test_no_stamps(filled: turtlewire.Buffer) -> None:
    text = text_of(TypeError, filled.lookup_transforms, "world", "turtle", None)
    assert text == STAMPS_ARE + "NoneType; for the latest, call lookup_transform"


def test_stamps_that_follow_the_advice_are_taken(filled: turtlewire.Buffer) -> None:
    seconds = np.array([0.1, 1.5])
    stamps = np.round(seconds * 1e9).astype(np.int64)
    assert filled.lookup_transforms("world", "turtle", stamps)[:, 0].tolist() == [0.1, 1.5]
    dates = np.array(
        ["1970-01-01T00:00:02", dt.datetime.fromisoformat("1970-01-01")], dtype="datetime64[ns]"
    )
    assert filled.lookup_transforms("world", "turtle", dates)[:, 0].tolist() == [2.0, 0.0]


@pytest.mark.parametrize(
    ("stamps", "rest"),
    [
        (SECOND, "(); for a single time, call lookup_transform or set_transform"),
        (np.datetime64(1, "s"), "(); for a single time, call lookup_transform or set_transform"),
        (STAMPS[:, None], "(5, 1); write stamps.ravel()"),
        (np.zeros((2, 3), dtype=np.int64), "(2, 3)"),
    ],
)
def test_stamps_of_another_shape(filled: turtlewire.Buffer, stamps: Any, rest: str) -> None:
    text = text_of(ValueError, filled.lookup_transforms, "world", "turtle", stamps)
    assert text == "stamps must have the shape (N,), not " + rest


@pytest.mark.parametrize(
    ("points", "error", "rest"),
    [
        (np.zeros((3, 5)), ValueError, "have the shape (N, 3), not (3, 5); write points.T"),
        (
            np.zeros(3),
            ValueError,
            "have the shape (N, 3), not (3,); write [point] for a single one",
        ),
        (
            np.zeros((5, 4)),
            ValueError,
            (
                "have the shape (N, 3), not (5, 4); write points[:, :3] if the first columns are "
                "x, y, z"
            ),
        ),
        (
            np.zeros((2, 5, 3)),
            ValueError,
            "have the shape (N, 3), not (2, 5, 3); write points.reshape(-1, 3)",
        ),
        (np.zeros((5, 2)), ValueError, "have the shape (N, 3), not (5, 2)"),
        (7.0, ValueError, "have the shape (N, 3), not ()"),
        ([[1, 2, 3], [1, 2]], ValueError, "be one array, not rows of different lengths"),
        ("abc", TypeError, "be an array of numbers, not text"),
        ([[1, 2, None], [object()] * 3], TypeError, "be an array of numbers, not NoneType"),
        (np.datetime64(5, "ns"), TypeError, "be an array of numbers, not datetime64"),
    ],
)
def test_points(filled: turtlewire.Buffer, points: Any, error: type[Exception], rest: str) -> None:
    text = text_of(error, filled.transform_points, "world", "turtle", points, SECOND)
    assert text == "points must " + rest


def test_single_points_are_converted_alike(filled: turtlewire.Buffer) -> None:
    points = np.arange(30, dtype=np.float32).reshape(10, 3)
    moved = filled.transform_points("world", "turtle", points[::2], SECOND)
    assert moved.dtype == np.float32
    assert moved.tolist() == (points[::2] + np.float32([1, 2, 0])).tolist()
    assert filled.transform_points("world", "turtle", [[1, 0, 0]], SECOND).tolist() == [[2, 2, 0]]


def test_counts_that_differ(filled: turtlewire.Buffer) -> None:
    points = np.zeros((5, 3))
    assert (
        text_of(
            ValueError, filled.transform_points, "world", "turtle", points, np.zeros(2, np.int64)
        )
        == "stamps must be one time, or one for each point: 5 points have 2 stamps"
    )
    text = text_of(
        ValueError, filled.set_transforms, "world", "turtle", STAMPS, np.eye(7)[[6, 6, 6]]
    )
    assert text == "poses must have the shape (5, 7), not (3, 7)"
    text = text_of(
        ValueError, filled.lookup_velocity, "world", "turtle", SECOND, out=np.zeros((2, 6))
    )
    assert text == "out must have the shape (6,), not (2, 6)"


@pytest.mark.parametrize(
    ("poses", "rest"),
    [
        (np.zeros(7), "(7,); write [pose] for a single one"),
        (np.eye(4), "(4, 4); write [matrix] for a single one"),
        (np.zeros((7, 5)), "(7, 5)"),
        (np.zeros((5, 6)), "(5, 6)"),
    ],
)
def test_poses(filled: turtlewire.Buffer, poses: Any, rest: str) -> None:
    text = text_of(ValueError, filled.set_transforms, "world", "turtle", STAMPS, poses)
    wanted = "poses must have the shape (N, 7), rows of x, y, z, qx, qy, qz, qw, or (N, 4, 4), not "
    assert text == wanted + rest
    text = text_of(TypeError, filled.set_transforms, "world", "turtle", STAMPS, "hello")
    assert text == "poses must be an array of numbers, not text"


@pytest.mark.parametrize(
    ("translation", "error", "rest"),
    [
        (
            (1, 2, 3, 0, 0, 0, 1),
            ValueError,
            "not 7; split a pose of 7 numbers into pose[:3] and pose[3:]",
        ),
        ((1, 2), ValueError, "not 2"),
        (
            np.eye(4),
            ValueError,
            (
                "not 4 rows; of a 4x4 matrix, pass Transform.from_matrix(target, source, "
                "matrix).translation"
            ),
        ),
        (SECOND, TypeError, "not int; static transforms take no stamp before it"),
        (None, TypeError, "not NoneType"),
        (
            turtlewire.Transform("a", "b", (1, 2, 3)),
            TypeError,
            "not Transform; pass its translation and its rotation",
        ),
        (
            SimpleNamespace(x=1, y=2, z=3),
            TypeError,
            "not SimpleNamespace; pass (v.x, v.y, v.z) of it",
        ),
        ("abc", TypeError, "but 'a' is of type str"),
        ((1, 2, "3"), TypeError, "but '3' is of type str"),
        ((1, 2, None), TypeError, "but None is of type NoneType"),
    ],
)
def test_translations(
    core: Any, buffer: turtlewire.Buffer, translation: Any, error: type[Exception], rest: str
) -> None:
    for call, *arguments in (
        (buffer.set_transform, "a", "b", 1, translation),
        (core.Transform, "a", "b", translation),
        (buffer.set_static_transform, "a", "b", translation),
    ):
        assert text_of(error, call, *arguments) == TRANSLATION_IS + rest
    assert buffer.frames() == []


@pytest.mark.parametrize(
    ("rotation", "error", "rest"),
    [
        (
            (0, 0, 1.5),
            ValueError,
            (
                "not 3; of roll, pitch and yaw, pass "
                "geometry.quaternion_from_euler((roll, pitch, yaw))"
            ),
        ),
        (
            np.eye(3),
            ValueError,
            (
                "not 3 rows; of a 4x4 matrix, pass Transform.from_matrix(target, source, "
                "matrix).rotation"
            ),
        ),
        (None, TypeError, "not NoneType; leave it out for no rotation"),
        (
            SimpleNamespace(x=0, y=0, z=0, w=1),
            TypeError,
            "not SimpleNamespace; pass (v.x, v.y, v.z, v.w) of it",
        ),
    ],
)
def test_rotations(
    buffer: turtlewire.Buffer, rotation: Any, error: type[Exception], rest: str
) -> None:
    text = text_of(error, buffer.set_transform, "a", "b", 1, (1, 2, 3), rotation)
    assert text == ROTATION_IS + rest


def test_numbers_of_other_types_are_taken(buffer: turtlewire.Buffer) -> None:
    numbers: Any = (Fraction(1, 2), np.float32(2), np.int8(3))
    buffer.set_transform("a", "b", 1, numbers)
    assert buffer.lookup_transform("a", "b").translation == (0.5, 2.0, 3.0)


def test_an_iterator_that_ends_early(buffer: turtlewire.Buffer) -> None:
    text = text_of(ValueError, buffer.set_transform, "a", "b", 1, iter((1, 2)))
    assert text == TRANSLATION_IS + "not 2"


def test_errors_of_the_numbers_themselves_stay(buffer: turtlewire.Buffer) -> None:
    class Broken:
        def __float__(self) -> float:
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        buffer.set_transform("a", "b", 1, (1, 2, Broken()))  # type: ignore[arg-type]


MANY = "for several times, call lookup_transforms or set_transforms"


@pytest.mark.parametrize(
    ("stamp", "rest"),
    [
        (1.5, "float; for seconds, write round(seconds * 1e9)"),
        (math.nan, "float; for seconds, write round(seconds * 1e9)"),
        (STAMPS, "ndarray; " + MANY),
        ([1, 2], "list; " + MANY),
        ((1, 2, 3), "tuple; the translation comes after the stamp; " + MANY),
        ("2026-05-01", "str; write numpy.datetime64(time) for a date"),
        (DATE, "datetime; write round(time.timestamp() * 1e9)"),
        (
            SimpleNamespace(sec=1, nanosec=2),
            "SimpleNamespace; write time.sec * 1_000_000_000 + time.nanosec",
        ),
        (SimpleNamespace(nanoseconds=5), "SimpleNamespace; pass its nanoseconds"),
    ],
)
def test_times(filled: turtlewire.Buffer, stamp: Any, rest: str) -> None:
    for call, *arguments in (
        (filled.lookup_transform, "world", "turtle", stamp),
        (filled.can_transform, "world", "turtle", stamp),
        (filled.lookup_all, "world", stamp),
        (filled.set_transform, "world", "turtle", stamp, (1, 2, 3)),
    ):
        assert text_of(TypeError, call, *arguments) == STAMP_IS + rest


def test_a_sample_needs_a_time(buffer: turtlewire.Buffer) -> None:
    text = text_of(TypeError, buffer.set_transform, "a", "b", None, (1, 2, 3))
    advice = "for a transform that holds at all times, call set_static_transform"
    assert text == f"{STAMP_IS}NoneType; {advice}"


def test_timeouts(filled: turtlewire.Buffer) -> None:
    def ask(timeout: Any) -> str:
        return text_of(
            TypeError, filled.lookup_transform, "world", "turtle", timeout_ns=timeout
        ).partition("not ")[2]

    assert ask(0.5) == "float; for seconds, write round(seconds * 1e9)"
    assert ask(dt.timedelta(0, 1)) == "timedelta; write numpy.timedelta64(time)"
    assert ask([1]) == "list"


def test_frames_of_another_type(filled: turtlewire.Buffer) -> None:
    for call, *arguments in (
        (filled.lookup_transforms, STAMPS),
        (filled.transform_points, np.zeros((1, 3))),
        (filled.lookup_velocity,),
    ):
        assert text_of(TypeError, call, "a", 5, *arguments) == "source_frame must be str, not int"
        assert text_of(TypeError, call, 5, "b", *arguments) == "target_frame must be str, not int"
    for call, *arguments in (
        (filled.set_transforms, [1], [[0, 0, 0, 0, 0, 0, 1]]),
        (filled.set_transform, 1, (0, 0, 0)),
    ):
        assert text_of(TypeError, call, 5, "b", *arguments) == "parent_frame must be str, not int"
        assert text_of(TypeError, call, "a", 5, *arguments) == "child_frame must be str, not int"
    assert text_of(TypeError, filled.lookup_all, 5) == "target_frame must be str, not int"


def test_the_cache_time(core: Any) -> None:
    text = text_of(TypeError, core.Buffer, 10.0)
    assert text == (
        "cache_time_ns must be an int of nanoseconds or a numpy.timedelta64, not float; for "
        "seconds, write round(seconds * 1e9)"
    )
    assert core.Buffer(np.timedelta64(3, "s")).cache_time_ns == 3 * SECOND
    assert core.Buffer(None).cache_time_ns is None


def test_times_beyond_64_bits(filled: turtlewire.Buffer) -> None:
    text = text_of(OverflowError, filled.lookup_transform, "world", "turtle", 2**63)
    assert text == "stamp_ns does not fit into 64 bits of nanoseconds"
    text = text_of(OverflowError, filled.lookup_transforms, "world", "turtle", [2**64 - 1])
    assert text == "stamps do not fit into 64 bits (int64 nanoseconds)"
