"""Two cores and Debian's real tf2 agree on random worlds; the laws of rigid motion hold."""

from __future__ import annotations

import json
import math
import random
import secrets
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tests.needs import COMPILED_CORE

from turtlewire import errors, msg
from turtlewire.geometry import quaternions
from turtlewire.tf import faults, plain

if TYPE_CHECKING:
    import turtlewire

DEBIAN = "/usr/bin/python3"
ADAPTER = Path(__file__).parent / "rivals" / "debian_tf2.py"


def perform(buffer: turtlewire.Buffer, operation: tuple[Any, ...]) -> Any:
    """Add a sample, or look up; return the result.

    A rejected sample returns the reason, a lookup an int, [stamp, numbers] or the exception. As in
    ROS, the time 0 requests the latest, and means no time in a result.
    """
    kind, *arguments = operation
    if kind == "set":
        parent, child, stamp, pose, static = arguments
        return buffer._set_transform(
            parent, child, stamp, pose[:3], pose[3:], static, "default_authority"
        )
    if kind == "clear":
        return buffer.clear()
    try:
        if kind == "common":
            return buffer._latest_common_time(*arguments)
        if kind == "lookup":
            target, source, stamp = arguments
            found = buffer.lookup_transform(target, source, stamp or None)
        else:
            target, target_stamp, source, stamp, fixed = arguments
            found = buffer.lookup_transform(
                target,
                source,
                stamp or None,
                fixed_frame=fixed,
                target_stamp_ns=target_stamp or None,
            )
    except errors.TransformException as error:
        return error
    return [found.stamp_ns or 0, *found.translation, *found.rotation]


def same_numbers(a: list[float], b: list[float], tolerance: float) -> bool:
    """Equal stamps and poses; a quaternion whose sign hangs on rounding may have either."""
    near = [
        math.isclose(x, y, rel_tol=tolerance, abs_tol=tolerance)
        for x, y in zip(a[1:], b[1:], strict=True)
    ]
    turned = all(
        math.isclose(x, -y, rel_tol=tolerance, abs_tol=tolerance)
        for x, y in zip(a[4:], b[4:], strict=True)
    )
    return a[0] == b[0] and all(near[:3]) and (all(near[3:]) or turned)


@settings(max_examples=150)
@given(st.integers(0, 2**32))
def test_cores_agree(make_world: Callable[..., Any], seed: int) -> None:
    native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    fast, clear = native.Buffer(), plain.Buffer()
    for operation in make_world(seed, wild=True).operations:
        a, b = perform(fast, operation), perform(clear, operation)
        assert fast._fault() == ""
        assert clear._fault() == ""
        if isinstance(b, list):
            assert isinstance(a, list), (operation, a, b)
            assert same_numbers(a, b, 1e-12), (operation, a, b)
        elif isinstance(b, Exception):
            assert (type(a), str(a), a.hint) == (type(b), str(b), b.hint)
        else:
            assert a == b, operation
    assert fast.frames() == clear.frames()
    assert fast.to_yaml(now_ns=10**18) == clear.to_yaml(now_ns=10**18)
    assert fast.to_dot(now_ns=10**18) == clear.to_dot(now_ns=10**18)
    assert [row[:7] for row in fast._describe_links(1000)] == [
        row[:7] for row in clear._describe_links(1000)
    ]
    assert fast._describe_refusals() == clear._describe_refusals()


def answer_of(buffer: Any, question: tuple[str, tuple[Any, ...], dict[str, Any]]) -> Any:
    """The answer, or the texts of its error; a transform is its stamp and matrix."""
    method, arguments, options = question
    try:
        found = getattr(buffer, method)(*arguments, **options)
    except errors.TransformException as error:
        return [type(error), str(error), error.hint]
    return [found.stamp_ns, found.as_matrix()] if hasattr(found, "as_matrix") else [found]


@settings(max_examples=150)
@given(st.integers(0, 2**32))
def test_cores_agree_beyond_tf2(make_world: Callable[..., Any], seed: int) -> None:
    native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    fast, clear = native.Buffer(), plain.Buffer()
    world = make_world(seed, wild=True)
    for operation in world.operations:
        if operation[0] in {"set", "clear"}:
            assert perform(fast, operation) == perform(clear, operation)
            continue
        question = world.question_beyond_tf2()
        a, b = answer_of(fast, question), answer_of(clear, question)
        for one, other in zip(a, b, strict=True):
            if isinstance(other, np.ndarray):
                np.testing.assert_allclose(one, other, rtol=1e-6, atol=1e-6, err_msg=str(question))
            else:
                assert one == other, question


def compare_with_debian(make_world: Callable[..., Any], seeds: range) -> int:
    native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    if (
        subprocess.run(
            [DEBIAN, "-c", "import tf2_py, rospy"], capture_output=True, check=False
        ).returncode
        != 0
    ):
        pytest.skip(
            "Debian's python3-tf2 is not installed: apt install python3-tf2 python3-tf2-ros"
        )
    worlds = [make_world(seed, wild=False) for seed in seeds]
    asked = json.dumps([world.operations for world in worlds])
    run = subprocess.run(
        [DEBIAN, str(ADAPTER)], input=asked, capture_output=True, check=True, text=True
    )
    expected = iter(json.loads(run.stdout))
    cases = 0
    for seed, world in zip(seeds, worlds, strict=True):
        buffer = native.Buffer()
        for operation in world.operations:
            answer = perform(buffer, operation)
            if operation[0] in {"set", "clear"}:
                continue
            truth = next(expected)
            cases += 1
            if isinstance(truth, str):
                assert truth == type(answer).__name__, (seed, operation, truth, answer)
            elif isinstance(truth, list):
                assert isinstance(answer, list), (seed, operation, truth, answer)
                assert same_numbers(answer, truth, 1e-9), (seed, operation, truth, answer)
            else:
                assert answer == truth, (seed, operation, truth, answer)
    return cases


def test_equals_debian(make_world: Callable[..., Any]) -> None:
    assert compare_with_debian(make_world, range(800)) >= 20_000


@pytest.mark.slow
def test_equals_debian_in_more_worlds(make_world: Callable[..., Any]) -> None:
    first = 800 if settings().derandomize else secrets.randbelow(2**32)
    assert compare_with_debian(make_world, range(first, first + 8000)) >= 200_000


numbers = st.floats(-100, 100)
angles = st.one_of(
    st.floats(-math.pi, math.pi),
    st.floats(-1e-6, 1e-6),
    st.floats(math.pi - 1e-6, math.pi),
    st.sampled_from([0.0, math.pi, -math.pi]),
)


@st.composite
def poses(
    draw: Callable[[Any], Any],
) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
    axis = [draw(st.floats(-1, 1)) for _ in range(3)]
    length = math.sqrt(sum(a * a for a in axis))
    assume(length > 1e-3)
    half = draw(angles) / 2
    x, y, z = (math.sin(half) * a / length for a in axis)
    return (draw(numbers), draw(numbers), draw(numbers)), (x, y, z, math.cos(half))


class TestLaws:
    @given(poses(), poses())
    def test_there_and_back(self, core: Any, one: Any, other: Any) -> None:
        buffer = core.Buffer()
        buffer.set_transform("a", "b", 1, *one)
        buffer.set_transform("b", "c", 1, *other)
        there, back = (
            buffer.lookup_transform("a", "c").as_matrix(),
            buffer.lookup_transform("c", "a").as_matrix(),
        )
        assert there @ back == pytest.approx(np.eye(4), abs=1e-11)
        assert buffer.lookup_transform("a", "c").inverse().as_matrix() == pytest.approx(
            back, abs=1e-11
        )

    @given(poses(), poses())
    def test_neighbours_cancel(self, core: Any, one: Any, other: Any) -> None:
        buffer = core.Buffer()
        buffer.set_transform("a", "b", 1, *one)
        buffer.set_transform("b", "c", 1, *other)
        product = (
            buffer.lookup_transform("a", "b").as_matrix()
            @ buffer.lookup_transform("b", "c").as_matrix()
        )
        assert buffer.lookup_transform("a", "c").as_matrix() == pytest.approx(product, abs=1e-11)

    @given(poses())
    def test_round_trip(self, core: Any, pose: Any) -> None:
        buffer = core.Buffer()
        buffer.set_transform("a", "b", 1, *pose)
        found = buffer.lookup_transform("a", "b")
        assert found.translation == pytest.approx(pose[0], abs=1e-12)
        sign = 1.0 if sum(x * y for x, y in zip(found.rotation, pose[1], strict=True)) > 0 else -1.0
        assert [sign * x for x in found.rotation] == pytest.approx(pose[1], abs=1e-12)
        assert math.hypot(*found.rotation) == pytest.approx(1.0, abs=1e-15)

    @given(poses(), poses(), st.integers(1, 999))
    def test_interpolation_moves_at_one_speed(
        self, core: Any, one: Any, other: Any, part: int
    ) -> None:
        cosine = abs(sum(x * y for x, y in zip(one[1], other[1], strict=True)))
        assume(cosine > 1e-3)  # beyond half a turn apart the shorter way is a matter of rounding
        buffer = core.Buffer()
        buffer.set_transform("a", "b", 1000, *one)
        buffer.set_transform("a", "b", 2000, *other)
        begin, middle, end = (
            buffer.lookup_transform("a", "b", t) for t in (1000, 1000 + part, 2000)
        )

        def angle(p: Any, q: Any) -> float:
            x, y, z, w = quaternions.multiply(quaternions.conjugate(p.rotation), q.rotation)
            return 2 * math.atan2(math.hypot(x, y, z), abs(w))

        assert angle(begin, middle) == pytest.approx(angle(begin, end) * part / 1000, abs=1e-7)
        assert angle(middle, end) == pytest.approx(angle(begin, end) * (1 - part / 1000), abs=1e-7)


# Broken bytes: a sample of what native/tests does a million times under the address sanitizer.

ROUNDS = 4000


def good_message() -> bytes:
    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")
    message = msg.get_message("tf2_msgs/msg/TFMessage")()
    for number in range(3):
        transform = stamped(child_frame_id=f"kind{number}ä")
        transform.header.frame_id = "eltern"
        transform.header.stamp.sec = 1 + number
        transform.transform.translation.x = number + 0.5
        message.transforms.append(transform)
    return msg.serialize(message)


def mutate(good: bytes, chance: random.Random) -> bytes:
    data = bytearray(good)
    for _ in range(chance.randrange(1, 4)):
        data[chance.randrange(len(data))] = chance.choice(
            [0, 1, 0x7F, 0x80, 0xFF, chance.randrange(256)]
        )
    del data[chance.choice([len(data), len(data), chance.randrange(len(data))]) :]
    return bytes(data)


def ingest(buffer, data: bytes) -> tuple[str, object]:
    try:
        return "accepted", buffer.add_tf_message(data)
    except errors.CdrError as error:
        return "refused", str(error)


def test_both_decoders_say_the_same_of_mutated_messages():
    native = pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    chance = random.Random(20)
    good = good_message()
    answers = {"accepted": 0, "refused": 0}
    for _ in range(ROUNDS):
        data = mutate(good, chance)
        fast, readable = native.Buffer(), plain.Buffer()
        answer = ingest(fast, data)
        assert answer == ingest(readable, data), data.hex(" ")
        assert fast.frames() == readable.frames(), data.hex(" ")
        assert fast.to_yaml(now_ns=10**18) == readable.to_yaml(now_ns=10**18), data.hex(" ")
        assert faults.malformed(fast) == faults.malformed(readable), data.hex(" ")
        assert fast._fault() == readable._fault() == "", data.hex(" ")
        answers[answer[0]] += 1
    assert min(answers.values()) > 500, answers
    assert native.Buffer().add_tf_message(good) == plain.Buffer().add_tf_message(good) == 3
