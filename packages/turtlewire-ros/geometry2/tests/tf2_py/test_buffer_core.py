"""The API of tf2_py: arguments and results; at the end, the answers of the real one."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import pytest
from tests.needs import COMPILED_CORE, only_first_is_fast

import tf2_py
from builtin_interfaces.msg import Duration as DurationMsg
from builtin_interfaces.msg import Time as TimeMsg
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from tests import places
from tf2_py import messages
from turtlewire import errors

SECOND = 1_000_000_000


def stamped(parent: str, child: str, stamp: int, x: float = 0.0) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp = TimeMsg(sec=stamp // SECOND, nanosec=stamp % SECOND)
    message.transform.translation.x = x
    return message


@pytest.fixture(params=["native", "python"])
def buffer(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> tf2_py.BufferCore:
    if request.param == "python":
        from turtlewire.tf import plain

        class Buffer(plain.Buffer):
            """A class that, like turtlewire's, may have the hint of an empty buffer."""

        monkeypatch.setattr("turtlewire.Buffer", Buffer)
        monkeypatch.setattr(messages, "CORE", "python")
    elif messages.CORE != "native":
        pytest.skip(COMPILED_CORE)
    core = tf2_py.BufferCore(Duration(seconds=5))
    for t in (1, 2):
        core.set_transform(stamped("map", "base", t * SECOND, x=float(t)), "me")
    core.set_transform_static(stamped("base", "camera", 0, x=0.5), "me")
    return core


def test_exceptions_are_those_of_the_engine() -> None:
    for name in (
        "Connectivity",
        "Extrapolation",
        "InvalidArgument",
        "Lookup",
        "Timeout",
        "Transform",
    ):
        assert getattr(tf2_py, name + "Exception") is getattr(errors, name + "Exception")


def test_lookup_returns_a_message(buffer: tf2_py.BufferCore) -> None:
    found = buffer.lookup_transform_core(
        target_frame="map", source_frame="camera", time=Time(nanoseconds=SECOND + SECOND // 2)
    )
    expected = stamped("map", "camera", SECOND + SECOND // 2, x=2.0)
    assert isinstance(found, TransformStamped)
    assert found == expected
    assert repr(found) == repr(expected)
    assert type(found.header.stamp) is TimeMsg
    found.transform.translation.y = 7.0  # the message is the caller's own
    assert (
        buffer.lookup_transform_core("map", "camera", Time(seconds=1.5)).transform.translation.y
        == 0.0
    )


def test_full_lookup(buffer: tf2_py.BufferCore) -> None:
    found = buffer.lookup_transform_full_core(
        "base", Time(seconds=2), "base", Time(seconds=1), "map"
    )
    assert (found.header.frame_id, found.child_frame_id, found.transform.translation.x) == (
        "base",
        "base",
        -1.0,
    )
    assert found.header.stamp.sec == 2


def test_can_transform(buffer: tf2_py.BufferCore) -> None:
    assert buffer.can_transform_core("map", "camera", Time()) == (1, "")
    assert buffer.can_transform_core("map", "nobody", Time()) == (
        0,
        (
            'Invalid frame ID "nobody" passed to canTransform argument source_frame - '
            "frame does not exist"
        ),
    )
    assert buffer.can_transform_full_core(
        "base", Time(seconds=2), "base", Time(seconds=1), "map"
    ) == (1, "")


@pytest.mark.parametrize(
    "time",
    [
        Time(seconds=2),
        TimeMsg(sec=2),
        SimpleNamespace(sec=2, nanosec=0),
        SimpleNamespace(nanoseconds=2 * SECOND),
    ],
)
def test_times_are_duck_typed(buffer: tf2_py.BufferCore, time: Any) -> None:
    assert buffer.lookup_transform_core("map", "base", time).transform.translation.x == 2.0
    assert buffer.can_transform_core("map", "base", time)[0] == 1


@pytest.mark.parametrize("seconds", [2**40, -(2**40), 2**63 - 1])
def test_times_beyond_64_bits(buffer: tf2_py.BufferCore, seconds: int) -> None:
    with pytest.raises(OverflowError):
        buffer.lookup_transform_core("map", "base", SimpleNamespace(sec=seconds, nanosec=0))


@pytest.mark.parametrize("time", [2, 2.0, None, "2"])
def test_numbers_are_no_times(buffer: tf2_py.BufferCore, time: Any) -> None:
    for call in (
        lambda: buffer.can_transform_core("map", "base", time),
        lambda: buffer.lookup_transform_core("map", "base", time),
    ):
        with pytest.raises(TypeError) as caught:
            call()
        assert str(caught.value) == "time must have sec and nanosec, or nanoseconds."


def test_cache_time() -> None:
    assert tf2_py.BufferCore().engine.cache_time_ns == 10 * SECOND
    assert tf2_py.BufferCore(DurationMsg(sec=3)).engine.cache_time_ns == 3 * SECOND
    assert (
        tf2_py.BufferCore(cache_time=Duration(seconds=3)).engine.cache_time_ns == 3 * SECOND
    )  # ROS 2 ignores the keyword
    with pytest.raises(TypeError, match="duration must have"):
        tf2_py.BufferCore(3)  # type: ignore[arg-type]


def test_latest_common_time(buffer: tf2_py.BufferCore) -> None:
    assert buffer.get_latest_common_time("map", "camera") == Time(seconds=2)
    with pytest.raises(
        tf2_py.LookupException,
        match=r'^"nobody" passed to get_latest_common_time does not exist\. ',
    ):
        buffer.get_latest_common_time("map", "nobody")


def test_velocity(buffer: tf2_py.BufferCore) -> None:
    linear, angular = buffer.lookupVelocityCore(
        "camera", "map", Time(seconds=1.5), Duration(seconds=0.5)
    )
    assert (linear, angular) == ((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    full = buffer.lookupVelocityFullCore(
        "camera",
        "map",
        "base",
        (1.0, 0.0, 0.0),
        "base",
        Time(seconds=1.5),
        DurationMsg(sec=0, nanosec=1000),
    )
    assert full[0] == pytest.approx((1.0, 0.0, 0.0))
    with pytest.raises(tf2_py.ExtrapolationException):
        buffer.lookupVelocityCore("camera", "map", Time(seconds=9), Duration(seconds=0.5))


def test_an_interval_of_a_velocity_does_not_reach_back_beyond_time_0(buffer) -> None:
    """A simulation begins at 0: ROS 2 takes what there is of the interval."""
    for t, x in ((10_000, 0.0), (SECOND // 2, 1.0), (SECOND, 2.0)):
        buffer.set_transform(stamped("odom", "wheel", t, x=x), "me")
    for stamp, interval in ((0, 1), (0, 3), (1, 3), (0.5, 2)):
        linear, _ = buffer.lookupVelocityCore(
            "wheel", "odom", Time(seconds=stamp), Duration(seconds=interval)
        )
        assert linear == pytest.approx((2.0, 0.0, 0.0), rel=1e-4)


def test_chain(buffer: tf2_py.BufferCore) -> None:
    buffer.set_transform_static(stamped("base", "arm", 0), "me")
    chain = buffer._chain("arm", Time(seconds=2), "camera", Time(seconds=1), "map")
    assert chain == ["camera", "base", "map", "base", "arm"]
    assert buffer._chain("arm", Time(), "camera", Time(), "base") == ["camera", "base", "arm"]
    with pytest.raises(tf2_py.LookupException):
        buffer._chain("arm", Time(), "nobody", Time(), "base")


def test_descriptions(buffer: tf2_py.BufferCore) -> None:
    assert (
        buffer.all_frames_as_string()
        == "Frame base exists with parent map.\nFrame camera exists with parent base.\n"
    )
    assert buffer.all_frames_as_yaml(1, "anything").startswith(
        "base: \n  parent: 'map'\n  broadcaster: 'me'\n"
    )
    assert buffer._allFramesAsDot().startswith(
        'digraph G {\n"map" -> "base"[label="Broadcaster: me\\nAverage rate: 2.000 Hz\\n'
    )
    assert "( 3.000 sec old)" in buffer._allFramesAsDot(Time(seconds=5))
    assert buffer._frameExists("camera")
    assert buffer._getFrameStrings() == ["base", "map", "camera"]
    buffer.clear()
    assert buffer.can_transform_core("base", "camera", Time())[0] == 1


def test_refusal_is_logged(buffer: tf2_py.BufferCore, capfd: pytest.CaptureFixture[str]) -> None:
    assert buffer.set_transform(stamped("map", "base", SECOND, x=math.nan), "me") is None  # type: ignore[func-returns-value]
    assert (
        'TF_NAN_INPUT: Ignoring transform for child_frame_id "base" from authority "me"'
        in capfd.readouterr().err
    )


def test_hints_say_what_to_do_in_ros_terms(buffer: tf2_py.BufferCore) -> None:
    for second in (1, 2):
        buffer.set_transform(stamped("map", "arm", second * SECOND), "me")
    late = Time(nanoseconds=2_065_094_400)
    with pytest.raises(errors.ExtrapolationException) as extrapolated:
        buffer.lookup_transform_core("map", "arm", late)
    assert extrapolated.value.hint == (
        "The newest sample of the transform from 'arm' to 'map' is 0.0651 s older than the "
        "requested time. Give the lookup a timeout to wait for it, or pass rclpy.time.Time() to "
        "get the latest."
    )
    buffer.set_transform(stamped("arm", "map", 2 * SECOND), "me")
    buffer.set_transform(stamped("elsewhere", "hand", 2 * SECOND), "me")
    with pytest.raises(errors.LookupException, match="contains a loop") as looped:
        buffer.lookup_transform_core("map", "hand", Time(seconds=2))
    assert looped.value.hint.endswith("buffer.engine.problems() names the frames.")


def test_the_hint_of_a_buffer_that_refused_all() -> None:
    buffer = tf2_py.BufferCore()
    buffer.set_transform(stamped("map", "map", SECOND), "me")
    with pytest.raises(errors.LookupException) as caught:
        buffer.lookup_transform_core("map", "base", Time())
    assert caught.value.hint.endswith(" buffer.engine.problems() lists them.")


def test_a_message_lookup_refuses_other_classes_and_buffers() -> None:
    if messages.CORE != "native":
        pytest.skip(COMPILED_CORE)
    import turtlewire
    from turtlewire import _native

    class Loose:
        header = SimpleNamespace(stamp=SimpleNamespace(), frame_id="")
        transform = SimpleNamespace()
        child_frame_id = ""

    with pytest.raises(TypeError, match="the field 'header' is not a slot"):
        _native.MessageLookup(turtlewire.Buffer(), Loose())
    with pytest.raises(TypeError, match="native Buffer"):
        _native.MessageLookup(object(), TransformStamped())  # type: ignore[arg-type]
    without_init = turtlewire.Buffer.__new__(turtlewire.Buffer)
    with pytest.raises(RuntimeError, match=r"Buffer.__init__\(\) was not called"):
        _native.MessageLookup(without_init, TransformStamped())


# Every answer of the real tf2_py of Jazzy and Lyrical, on both cores.

GOLDEN = places.GOLDEN / "tf2"
#: Jazzy's first core and its newest, and Lyrical's: the distribution, answers, and texts. Of the
#: texts of the first, 0.36.20 gives 854 no longer.
FILES = {
    "dev.jsonl.gz": ("jazzy", 24969, 12589 - 854),
    "jazzy-0.36.20-dev.jsonl.gz": ("jazzy", 15313, 9167),
    "lyrical-0.45.7-dev.jsonl.gz": ("lyrical", 12030, 7747),
}


@pytest.mark.parametrize("file", only_first_is_fast(*reversed(FILES)))
@pytest.mark.parametrize("core", ["native", "python"])
def test_all_answers_equal(core: str, file: str) -> None:
    if core == "native":
        pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    distro, answers, texts = FILES[file]
    command = [sys.executable, str(GOLDEN / "check.py"), str(GOLDEN / file)]
    run = subprocess.run(
        command,
        env={**os.environ, "TURTLEWIRE_CORE": core, "ROS_DISTRO": distro},
        capture_output=True,
        text=True,
        timeout=840,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert (
        run.stdout.splitlines()[-1]
        == f"{answers} of {answers} answers equal (class/numbers), {texts} texts equal"
    )
