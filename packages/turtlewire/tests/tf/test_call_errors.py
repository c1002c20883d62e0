"""Calls whose arguments do not fit: both cores raise the same texts, in Python's words."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import turtlewire
from turtlewire.call_errors import call_error

ALL_OF_LOOKUP = (
    "target_frame, source_frame, stamp_ns, timeout_ns, extrapolate_ns, fixed_frame, target_stamp_ns"
)
MATRIX_IS = "matrix must have the shape (4, 4), not "


def text_of(kind: type[Exception], call: Callable[[], object]) -> str:
    with pytest.raises(kind) as caught:
        call()
    assert type(caught.value) is kind
    return str(caught.value)


@pytest.mark.parametrize(
    ("method", "arguments", "keywords", "text"),
    [
        ("time_range", (), {}, ("missing 2 required positional arguments: 'target_frame' and "
         "'source_frame'")),
        ("set_transform", ("a",), {}, ("missing 3 required positional arguments: 'child_frame', "
         "'stamp_ns', and 'translation'; it takes parent_frame, child_frame, stamp_ns, "
         "translation, rotation, sender")),
        ("lookup_transform", ("a",), {}, ("missing 1 required positional argument: 'source_frame'; "
         f"it takes {ALL_OF_LOOKUP}")),
        ("lookup_transform", ("a", "b"), {"timeout": 1},
         "got an unexpected keyword argument 'timeout'; did you mean 'timeout_ns'?"),
        ("lookup_transform", ("a", "b"), {"seconds": 1},
         f"got an unexpected keyword argument 'seconds'; it takes {ALL_OF_LOOKUP}"),
        ("lookup_transform", ("a", "b"), {"source_frame": "b"},
         "got multiple values for argument 'source_frame'"),
        ("lookup_transform", ("a", "b", 1, 2), {}, ("takes at most 3 positional arguments "
         "(target_frame, source_frame, stamp_ns) but 4 were given; pass timeout_ns, "
         "extrapolate_ns, fixed_frame, target_stamp_ns by keyword")),
        ("lookup_transforms", ("a", "b", [1]), {"time": 1}, ("got an unexpected keyword argument "
         "'time'; it takes target_frame, source_frame, stamps, errors, extrapolate_ns, matrices, "
         "out")),
        ("lookup_transforms", ("a", "b", [1], "nan"), {}, ("takes 3 positional arguments "
         "(target_frame, source_frame, stamps) but 4 were given; pass errors, extrapolate_ns, "
         "matrices, out by keyword")),
        ("transform_points", (), {"point": 1},
         "got an unexpected keyword argument 'point'; did you mean 'points'?"),
        ("lookup_velocity", ("a", "b"), {"interval": 1},
         "got an unexpected keyword argument 'interval'; did you mean 'interval_ns'?"),
        ("lookup_newest", ("a", "b"), {"max_age": 1},
         "got an unexpected keyword argument 'max_age'; did you mean 'max_age_ns'?"),
        ("lookup_all", (), {}, ("missing 1 required positional argument: 'target_frame'; it takes "
         "target_frame, stamp_ns")),
        ("set_transforms", (1, 2, 3, 4, 5), {}, ("takes 4 positional arguments (parent_frame, "
         "child_frame, stamps, poses) but 5 were given; pass errors, sender by keyword")),
        ("samples", (), {}, "missing 1 required positional argument: 'child_frame'"),
        ("remove_frame", ("a", "b"), {}, ("takes 1 positional argument (child_frame) but 2 were "
         "given")),
        ("remove_stale", (), {"before": 1},
         "got an unexpected keyword argument 'before'; did you mean 'before_ns'?"),
        ("frames", (1,), {}, "takes no positional arguments but 1 was given"),
        ("clear", (), {"frame": 1},
         "got an unexpected keyword argument 'frame'; it takes no arguments"),
        ("to_yaml", (1,), {}, ("takes no positional arguments but 1 was given; pass now_ns by "
         "keyword")),
        ("to_dot", (), {"now": 1},
         "got an unexpected keyword argument 'now'; did you mean 'now_ns'?"),
        ("on_change", (), {}, "missing 1 required positional argument: 'call'"),
    ],
)  # fmt: skip
def test_methods_of_the_buffer(
    buffer: turtlewire.Buffer, method: str, arguments: Any, keywords: Any, text: str
) -> None:
    call = getattr(buffer, method)
    assert text_of(TypeError, lambda: call(*arguments, **keywords)) == f"{method}() {text}"


def test_constructors(core: Any) -> None:
    def ask(call: Callable[[], object]) -> str:
        return text_of(TypeError, call)

    assert ask(lambda: core.Buffer(cache_time=10)) == (
        "Buffer() got an unexpected keyword argument 'cache_time'; did you mean 'cache_time_ns'?"
    )
    assert ask(lambda: core.Buffer(1, 2, 3)) == (
        "Buffer() takes at most 2 positional arguments (cache_time_ns, max_frames) but 3 were given"
    )
    assert ask(lambda: core.Buffer(max_frames="2")) == "max_frames must be an int or None, not str"
    assert ask(lambda: core.Transform("a", "b", (1, 2, 3), (0, 0, 0, 1), 5)) == (
        "Transform() takes at most 4 positional arguments (target_frame, source_frame, "
        "translation, rotation) but 5 were given; pass stamp_ns by keyword"
    )
    assert ask(lambda: core.Transform("a", "b", translate=(1, 2, 3))) == (
        "Transform() got an unexpected keyword argument 'translate'; did you mean 'translation'?"
    )


def test_a_rotation_of_length_0(core: Any) -> None:
    for rotation in ((0, 0, 0, 0), (0, 1e-170, 0, 0)):  # the square of the second is 0 as well
        assert text_of(
            ValueError, lambda rotation=rotation: core.Transform("a", "b", (1, 2, 3), rotation)
        ) == ("rotation must not be (0, 0, 0, 0); the identity is (0, 0, 0, 1)")
    half_turn = core.Transform("a", "b", (1, 2, 3), (0, 0, 1e-150, 0))
    assert half_turn.apply((1, 0, 0)).tolist() == [0, 2, 3]


def test_methods_of_a_transform(core: Any) -> None:
    transform = core.Transform("a", "b", (1, 2, 3))

    def ask(call: Callable[[], object]) -> str:
        return text_of(TypeError, call)

    assert ask(transform.apply) == "apply() missing 1 required positional argument: 'points'"
    assert ask(lambda: transform.apply(point=1)) == (
        "apply() got an unexpected keyword argument 'point'; did you mean 'points'?"
    )
    assert ask(lambda: transform.interpolate(transform)) == (
        "interpolate() missing 1 required positional argument: 'stamp_ns'; it takes other, stamp_ns"
    )
    assert ask(lambda: core.Transform.from_matrix(np.eye(4))) == (
        "from_matrix() missing 2 required positional arguments: 'source_frame' and 'matrix'; it "
        "takes target_frame, source_frame, matrix, stamp_ns"
    )
    assert ask(lambda: core.Transform.from_matrix("a", "b", np.eye(4), 5)) == (
        "from_matrix() takes 3 positional arguments (target_frame, source_frame, matrix) but 4 "
        "were given; pass stamp_ns by keyword"
    )


def test_frames_that_come_last(core: Any, buffer: turtlewire.Buffer) -> None:
    buffer.set_static_transform("a", "b", (1, 2, 3))
    wanted = "target_frame must be str, not ndarray; the names of frames come before the other "
    for call in (
        lambda: core.Transform.from_matrix(np.eye(4), "a", "b"),
        lambda: buffer.transform_points(np.zeros((5, 3)), "a", "b"),  # type: ignore[arg-type]
        lambda: buffer.lookup_transforms(np.arange(3), "a", "b"),  # type: ignore[arg-type]
        lambda: buffer.lookup_transform(np.arange(3), "a", "b"),  # type: ignore[arg-type]
    ):
        assert text_of(TypeError, call) == wanted + "arguments"
    assert text_of(TypeError, lambda: buffer.time_range(b"a", "b")) == (  # type: ignore[arg-type]
        "target_frame must be str, not bytes; write name.decode()"
    )
    assert text_of(TypeError, lambda: buffer.time_range(None, "b")) == (  # type: ignore[arg-type]
        "target_frame must be str, not NoneType; Buffer.frames() lists the names"
    )


def test_a_transform_instead_of_an_array(core: Any, buffer: turtlewire.Buffer) -> None:
    transform: Any = core.Transform("a", "b", (1, 2, 3), stamp_ns=5)

    def ask(call: Callable[[], object]) -> str:
        return text_of(TypeError, call)

    points = "points must be an array, not Transform; pass [transform.translation] for its origin, "
    assert ask(lambda: buffer.transform_points("a", "b", transform)).startswith(points)
    assert ask(lambda: transform.apply(transform)) == points + "and chain transforms with a @ b"
    assert ask(lambda: core.Transform.from_matrix("a", "b", transform)) == (
        "matrix must be an array, not Transform; pass transform.as_matrix()"
    )
    assert ask(lambda: buffer.set_transforms("a", "b", [5], transform)) == (
        "poses must be an array, not Transform; write [transform] for a single one"
    )
    assert ask(lambda: buffer.lookup_transforms("a", "b", transform)) == (
        "stamps must be an array, not Transform; pass [transform.stamp_ns]"
    )
    assert buffer.set_transforms("a", "b", [transform.stamp_ns], [transform]) == 1
    assert buffer.lookup_transform("a", "b", 5).translation == (1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ("matrix", "rest"),
    [
        (np.eye(3), "(3, 3); write full = np.eye(4); full[:3, :3] = rotation"),
        (np.eye(4)[:3], "(3, 4); write np.vstack([matrix, [0, 0, 0, 1]])"),
        (np.zeros(7), ("(7,); for a pose of 7 numbers, write Transform(target, source, pose[:3], "
         "pose[3:])")),
        (np.zeros(16), "(16,); write matrix.reshape(4, 4)"),
        (np.zeros((2, 4, 4)), "(2, 4, 4); for several, pass them to Buffer.set_transforms"),
        (5, "()"),
    ],
)  # fmt: skip
def test_matrices_of_another_shape(core: Any, matrix: Any, rest: str) -> None:
    text = text_of(ValueError, lambda: core.Transform.from_matrix("a", "b", matrix))
    assert text == MATRIX_IS + rest


def test_matrices_that_are_no_rigid_motion(core: Any) -> None:
    moved = np.eye(4)
    moved[:3, 3] = 1, 2, 3
    for matrix, text in (
        (2 * np.eye(4), "matrix is not a rotation and a translation"),
        (
            moved.T,
            (
                "matrix is not a rotation and a translation; write matrix.T, so that it acts on "
                "columns"
            ),
        ),
    ):
        with pytest.raises(turtlewire.errors.InvalidTransformError) as caught:
            core.Transform.from_matrix("a", "b", matrix)
        assert str(caught.value) == text
        assert caught.value.hint.startswith("The upper left 3 by 3 numbers")  # and no row
    assert core.Transform.from_matrix("a", "b", moved).translation == (1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ("points", "rest"),
    [
        (np.zeros((3, 5)), "(3, 5); write points.T"),
        (np.zeros((5, 4)), "(5, 4); write points[:, :3] if the first columns are x, y, z"),
        (np.zeros(2), "(2,)"),
    ],
)
def test_points_of_a_transform(core: Any, points: Any, rest: str) -> None:
    transform = core.Transform("a", "b", (1, 2, 3))
    text = text_of(ValueError, lambda: transform.apply(points))
    assert text == f"points must have the shape (..., 3), not {rest}"
    assert text_of(TypeError, lambda: transform.apply("abc")) == (
        "points must be an array of numbers, not text"
    )


def test_errors_of_a_method_itself_stay(core: Any, buffer: turtlewire.Buffer) -> None:
    assert text_of(TypeError, lambda: buffer.lookup_transform("a", "b", 1.5)).startswith("stamp_ns")
    wrong: Any
    for wrong in ("x", 3):
        with pytest.raises(ValueError, match="errors must") as caught:
            buffer.lookup_transforms("a", "b", [1], errors=wrong)
        assert str(caught.value) == f"errors must be 'raise' or 'nan', not {wrong!r}"


def test_signatures_of_both_cores_agree() -> None:
    native = pytest.importorskip("turtlewire._native")
    from turtlewire.tf import plain

    def names(method: Any) -> list[tuple[str, Any]]:
        parameters = list(inspect.signature(method).parameters.values())[1:]  # without self
        return [(each.name, each.kind) for each in parameters]

    for name in vars(plain.Buffer).keys() | {"on_change"}:
        if callable(getattr(plain.Buffer, name)) and not name.startswith("_"):
            assert names(getattr(native.Buffer, name)) == names(getattr(plain.Buffer, name)), name


def test_python_lists_names_in_the_same_way() -> None:
    def three(one: int, two: int, three: int) -> None: ...

    with pytest.raises(TypeError) as caught:
        three()  # type: ignore[call-arg]
    ours = call_error("three", ["one", "two", "three"], 3, 3, 0, ())
    assert str(caught.value).endswith(str(ours))
