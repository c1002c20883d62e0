"""The buffer's public interface, on both cores.

What tf2 answers is in tests/tf2_py/test_buffer_core.py.
"""

from __future__ import annotations

import gc
import math
import os
import pickle
import struct
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.needs import COMPILED_CORE
from tests.programs import run_python

from turtlewire import errors, msg

if TYPE_CHECKING:
    import turtlewire

SECOND = 1_000_000_000
LAST = 2**63 - 1
NO_TURN = (0.0, 0.0, 0.0, 1.0)
QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))


def tf_message(*transforms: tuple[str, str, int, Sequence[float]]) -> bytes:
    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")
    message = msg.get_message("tf2_msgs/msg/TFMessage")()
    for parent, child, stamp, (x, y, z, qx, qy, qz, qw) in transforms:
        transform = stamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(stamp, SECOND)
        t, q = transform.transform.translation, transform.transform.rotation
        t.x, t.y, t.z, q.x, q.y, q.z, q.w = x, y, z, qx, qy, qz, qw
        message.transforms.append(transform)
    return msg.serialize(message)


def near(values: Sequence[float]) -> Any:
    return pytest.approx(values, abs=1e-14)


class TestLookup:
    def test_takes_source_data_into_target(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_transform("world", "base", SECOND, (1, 2, 3), QUARTER)
        buffer.set_transform("base", "camera", SECOND, (1, 0, 0), NO_TURN)
        found = buffer.lookup_transform("world", "camera", SECOND)
        assert (found.target_frame, found.source_frame, found.stamp_ns) == (
            "world",
            "camera",
            SECOND,
        )
        assert found.translation == near((1, 3, 3))
        assert found.rotation == near(QUARTER)

    def test_interpolates(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_transform("world", "base", SECOND, (0, 0, 0), NO_TURN)
        buffer.set_transform("world", "base", 2 * SECOND, (2, 4, 6), QUARTER)
        found = buffer.lookup_transform("world", "base", SECOND + SECOND // 2)
        assert found.translation == near((1, 2, 3))
        assert found.rotation == near((0, 0, math.sin(math.pi / 8), math.cos(math.pi / 8)))

    def test_without_a_time_the_latest_common_one_is_taken(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_transform("a", "b", 5 * SECOND, (0, 0, 0), NO_TURN)
        for t in (3, 7):
            buffer.set_transform("b", "c", t * SECOND, (t, 0, 0), NO_TURN)
        assert buffer._latest_common_time("a", "c") == 5 * SECOND
        found = buffer.lookup_transform("a", "c")
        assert (found.stamp_ns, found.x) == (5 * SECOND, pytest.approx(5.0))

    def test_fixed_frame(self, buffer: turtlewire.Buffer) -> None:
        for t in (1, 2):
            buffer.set_transform("map", "car", t * SECOND, (10.0 * t, 0, 0), NO_TURN)
        found = buffer.lookup_transform(
            "car", "car", SECOND, fixed_frame="map", target_stamp_ns=2 * SECOND
        )
        assert (found.translation, found.stamp_ns) == ((-10.0, 0.0, 0.0), 2 * SECOND)
        assert buffer.can_transform(
            "car", "car", SECOND, fixed_frame="map", target_stamp_ns=2 * SECOND
        )
        assert not buffer.can_transform(
            "car", "car", SECOND, fixed_frame="map", target_stamp_ns=3 * SECOND
        )
        assert "into the future" in buffer._can_transform_reason(
            "car", "car", SECOND, fixed_frame="map", target_stamp_ns=3 * SECOND
        )

    def test_keywords(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_static_transform(
            parent_frame="a", child_frame="b", translation=(1, 2, 3), rotation=NO_TURN
        )
        assert (
            buffer.lookup_transform(target_frame="a", source_frame="b", stamp_ns=7, timeout_ns=0).x
            == 1.0
        )
        with pytest.raises(TypeError, match="unexpected keyword"):
            buffer.lookup_transform("a", "b", stamp=7)  # type: ignore[call-arg]
        with pytest.raises(TypeError):
            buffer.lookup_transform("a")  # type: ignore[call-arg]

    def test_names_are_known_by_value(self, buffer: turtlewire.Buffer) -> None:
        for i in range(600):  # more pairs than are kept by identity
            buffer.set_static_transform("root", f"leaf{i}", (i, 0, 0), NO_TURN)
        for _ in range(3):
            assert [buffer.lookup_transform("root", f"leaf{i}").x for i in range(600)] == [
                float(i) for i in range(600)
            ]

    def test_follows_a_changing_tree(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_static_transform("a", "b", (1, 0, 0), NO_TURN)
        assert buffer.lookup_transform("a", "b").x == 1.0
        buffer.set_static_transform("a", "b", (2, 0, 0), NO_TURN)
        assert buffer.lookup_transform("a", "b").x == 2.0
        buffer.set_static_transform("z", "a", (10, 0, 0), NO_TURN)
        assert buffer.lookup_transform("z", "b").x == 12.0
        buffer.set_static_transform("z", "b", (5, 0, 0), NO_TURN)
        assert buffer.lookup_transform("a", "b").x == -5.0


class TestErrors:
    @pytest.mark.parametrize(
        ("source_newest", "reported"), [(5, "source"), (6, "source"), (4, "target")]
    )
    def test_of_two_failing_legs_the_one_with_newer_data_is_reported(
        self, buffer: turtlewire.Buffer, source_newest: int, reported: str
    ) -> None:
        for stamp in (1, source_newest):
            buffer.set_transform("root", "source", stamp * SECOND, (1, 0, 0), NO_TURN)
        for stamp in (2, 5):
            buffer.set_transform("root", "target", stamp * SECOND, (0, 1, 0), NO_TURN)
        with pytest.raises(errors.ExtrapolationException) as raised:
            buffer.lookup_transform("target", "source", 9 * SECOND)
        newest = source_newest if reported == "source" else 5
        assert f"the latest data is at time {newest}.000000" in str(raised.value)
        assert raised.value.child_frame == reported

    def test_classes(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_transform("a", "b", SECOND, (0, 0, 0), NO_TURN)
        buffer.set_transform("a", "b", 2 * SECOND, (0, 0, 0), NO_TURN)
        buffer.set_transform("x", "y", SECOND, (0, 0, 0), NO_TURN)
        with pytest.raises(errors.LookupException, match="does not exist"):
            buffer.lookup_transform("a", "nobody")
        with pytest.raises(errors.InvalidArgumentException):
            buffer.lookup_transform("/a", "b")
        with pytest.raises(errors.ConnectivityException):
            buffer.lookup_transform("a", "y", SECOND)
        with pytest.raises(errors.ExtrapolationException, match="into the future"):
            buffer.lookup_transform("a", "b", 3 * SECOND)
        with pytest.raises(errors.TransformException, match="passed to get_latest_common_time"):
            buffer._latest_common_time("a", "nobody")

    @pytest.mark.parametrize(
        "arguments",
        [
            (1, "b"),
            ("a", None),
            ("a", "b", "now"),
            ("a", "b", 1.5),
            ("a", "b", 0, 0.1),
            ("a", "\ud800"),
        ],
    )
    def test_wrong_types(self, buffer: turtlewire.Buffer, arguments: tuple[Any, ...]) -> None:
        buffer.set_transform("a", "b", 1, (0, 0, 0), NO_TURN)
        for question in (buffer.lookup_transform, buffer.can_transform, buffer.explain):
            with pytest.raises((TypeError, UnicodeEncodeError)):
                question(*arguments)

    @pytest.mark.parametrize(
        ("changed", "error"),
        [
            ({"stamp_ns": math.nan}, TypeError),
            ({"stamp_ns": 1.0}, TypeError),
            ({"stamp_ns": 2**63}, OverflowError),
            ({"parent_frame": None}, TypeError),
            ({"sender": 1}, TypeError),
            ({"translation": (1, 2)}, ValueError),
            ({"translation": "123"}, TypeError),
            ({"rotation": (0, 0, 0, 0, 1)}, ValueError),
        ],
    )
    def test_wrong_samples(
        self, buffer: turtlewire.Buffer, changed: dict[str, Any], error: type[Exception]
    ) -> None:
        sample = {
            "parent_frame": "a",
            "child_frame": "b",
            "stamp_ns": 1,
            "translation": (1, 2, 3),
            "rotation": NO_TURN,
        }
        with pytest.raises(error):
            buffer.set_transform(**{**sample, **changed})  # type: ignore[arg-type]
        assert buffer.frames() == []

    def test_list_that_changes_while_it_is_read(self, buffer: turtlewire.Buffer) -> None:
        class Vanishing:
            def __float__(self) -> float:
                numbers.clear()
                return 1.0

        numbers: list[Any] = [Vanishing(), *(object() for _ in range(2))]
        with pytest.raises(TypeError):
            buffer.set_transform("a", "b", 1, numbers, NO_TURN)  # type: ignore[arg-type]
        numbers[:] = [Vanishing(), 2.0, 3.0]
        buffer.set_transform("a", "b", 1, numbers, NO_TURN)  # type: ignore[arg-type]
        assert buffer.lookup_transform("a", "b").translation == (1.0, 2.0, 3.0)

    def test_uncallable_listener_is_rejected(self, buffer: turtlewire.Buffer) -> None:
        with pytest.raises(TypeError):
            buffer.on_change(3)  # type: ignore[arg-type]

    def test_stamp_beyond_64_bits(self, buffer: turtlewire.Buffer) -> None:
        with pytest.raises(OverflowError):
            buffer.lookup_transform("a", "b", 2**63)

    def test_never_initialised(self, core: Any) -> None:
        broken = core.Buffer.__new__(core.Buffer)
        with pytest.raises((RuntimeError, AttributeError, TypeError)):
            broken.lookup_transform("a", "b")

    def test_negative_cache(self, core: Any) -> None:
        with pytest.raises(ValueError, match="negative"):
            core.Buffer(-1)
        with pytest.raises(TypeError):
            core.Buffer(10.0)


class TestBatchesOfSamples:
    POSES = np.tile([0.0, 0, 0, 0, 0, 0, 1], (100, 1))

    def test_a_batch_longer_than_the_cache_is_refused_whole(
        self, buffer: turtlewire.Buffer
    ) -> None:
        stamps = np.arange(100) * SECOND
        with pytest.raises(errors.InvalidTransformError) as caught:
            buffer.set_transforms("a", "b", stamps, self.POSES)
        assert (caught.value.reason, caught.value.row) == ("old", 0)
        assert "cache_time_ns=None" in caught.value.hint
        assert buffer.frames() == []
        assert "old_data" in buffer._describe_refusals()["b"][0]

    def test_skip_returns_how_many_are_kept(self, buffer: turtlewire.Buffer) -> None:
        stamps = np.arange(100) * SECOND
        kept = buffer.set_transforms("a", "b", stamps, self.POSES, errors="skip")
        assert kept == len(buffer._stamps("b")) < 15

    def test_a_batch_that_fits_is_kept(self, buffer: turtlewire.Buffer) -> None:
        stamps = SECOND * 10 * np.arange(100) // 99
        assert buffer.set_transforms("a", "b", stamps[::-1], self.POSES) == 100
        with pytest.raises(errors.InvalidTransformError) as caught:  # 1 ns too old
            buffer.set_transforms("a", "b", [-1], self.POSES[:1])
        assert caught.value.reason == "old"

    def test_one_bad_row_refuses_all_or_is_left_out(self, buffer: turtlewire.Buffer) -> None:
        poses = self.POSES.copy()
        poses[3, 1] = math.nan
        with pytest.raises(errors.InvalidTransformError, match="TF_NAN_INPUT") as caught:
            buffer.set_transforms("a", "b", np.arange(100), poses, sender="me")
        assert (caught.value.row, caught.value.sender) == (3, "me")
        assert buffer.frames() == []
        assert buffer.set_transforms("a", "b", np.arange(100), poses, errors="skip") == 99
        wrong: Any = "ignore"
        with pytest.raises(ValueError, match="'raise' or 'skip'"):
            buffer.set_transforms("a", "b", [1], poses[:1], errors=wrong)

    def test_matrices(self, buffer: turtlewire.Buffer) -> None:
        quarter = [[0.0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]
        assert buffer.set_transforms("a", "b", [1, 2], [quarter, np.eye(4)]) == 2
        found = buffer.lookup_transform("a", "b", 1)
        assert found.translation == (1.0, 2.0, 3.0)
        assert found.rotation == pytest.approx((0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))
        mirror = np.diag([1.0, 1.0, -1.0, 1.0])
        with pytest.raises(errors.InvalidTransformError) as caught:
            buffer.set_transforms("a", "b", [3, 4], [quarter, mirror])
        assert (caught.value.reason, caught.value.row) == ("not a rotation", 1)
        assert buffer.set_transforms("a", "b", [3, 4], [quarter, mirror], errors="skip") == 1
        with pytest.raises(ValueError, match=r"\(2, 3, 3\)"):
            buffer.set_transforms("a", "b", [1, 2], np.zeros((2, 3, 3)))

    def test_nothing(self, buffer: turtlewire.Buffer) -> None:
        assert buffer.set_transforms("a", "b", [], np.empty((0, 7))) == 0


class TestRefusals:
    @pytest.mark.parametrize(
        ("parent", "child", "translation", "rotation", "reason"),
        [
            (
                "a",
                "a",
                (0, 0, 0),
                NO_TURN,
                (
                    'TF_SELF_TRANSFORM: Ignoring transform from authority "me" with frame_id and  '
                    'child_frame_id "a"'
                ),
            ),
            (
                "a",
                "",
                (0, 0, 0),
                NO_TURN,
                (
                    'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "me" because '
                    "child_frame_id not set "
                ),
            ),
            (
                "/",
                "b",
                (0, 0, 0),
                NO_TURN,
                'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "b"  from authority "me"',
            ),
            (
                "a",
                "b",
                (math.nan, 0, 0),
                NO_TURN,
                'TF_NAN_INPUT: Ignoring transform for child_frame_id "b" from authority "me"',
            ),
            (
                "a",
                "b",
                (1, 2, 3),
                (0, 0, 0, 0),
                "(1.000000 2.000000 3.000000) (0.000000 0.000000 0.000000 0.000000)",
            ),
            ("NO_PARENT", "b", (0, 0, 0), NO_TURN, "NO_PARENT"),
            ("a", "x" * 5000, (0, 0, 0), NO_TURN, "4096 bytes"),
            ("a", "x\0y", (0, 0, 0), NO_TURN, "NUL"),
        ],
    )
    def test_reason(
        self,
        buffer: turtlewire.Buffer,
        parent: str,
        child: str,
        translation: Any,
        rotation: Any,
        reason: str,
    ) -> None:
        with pytest.raises(errors.InvalidTransformError) as caught:
            buffer.set_transform(parent, child, 1, translation, rotation, sender="me")
        assert reason in str(caught.value)
        kinds = {"self", "no child", "no parent", "nan", "zero quaternion", "bad name"}
        assert caught.value.reason in kinds
        assert (caught.value.sender, caught.value.row) == ("me", None)
        assert caught.value.hint
        with pytest.raises(errors.InvalidTransformError) as static:
            buffer.set_static_transform(parent, child, translation, rotation, sender="me")
        assert str(static.value) == str(caught.value)
        assert buffer._set_transform(parent, child, 1, translation, rotation, False, "me") == str(
            caught.value
        )
        assert buffer.frames() == []

    def test_old_data(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_transform("a", "b", 100 * SECOND, (0, 0, 0), NO_TURN)
        buffer.set_transform("a", "b", 90 * SECOND, (0, 0, 0), NO_TURN)
        with pytest.raises(errors.InvalidTransformError) as caught:
            buffer.set_transform("a", "b", 90 * SECOND - 1, (0, 0, 0), sender="me")
        assert (caught.value.reason, caught.value.child_frame) == ("old", "b")
        assert str(caught.value) == (
            "TF_OLD_DATA ignoring data from the past for frame b at time 90.000000 according to "
            "authority me\n"
            "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained"
        )


class TestIngest:
    def test_message(self, buffer: turtlewire.Buffer) -> None:
        data = tf_message(
            ("a", "b", SECOND, (1, 2, 3, *NO_TURN)), ("b", "cc", SECOND, (1, 1, 1, *QUARTER))
        )
        assert buffer.add_tf_message(data) == 2
        assert buffer.lookup_transform("a", "cc").translation == (2.0, 3.0, 4.0)
        assert buffer.add_tf_message(memoryview(bytearray(data))) == 2
        assert "default_authority" in buffer.to_yaml()

    def test_static_and_authority(self, buffer: turtlewire.Buffer) -> None:
        assert (
            buffer.add_tf_message(
                tf_message(("a", "b", SECOND, (1, 2, 3, *NO_TURN))), static=True, sender="robot"
            )
            == 1
        )
        assert buffer.lookup_transform("a", "b", 77).stamp_ns == 77
        assert "broadcaster: 'robot'" in buffer.to_yaml()

    def test_big_endian(self, buffer: turtlewire.Buffer) -> None:
        body = (
            struct.pack(">IiI", 1, 1, 5)
            + struct.pack(">I4s", 2, b"a")
            + struct.pack(">I4s", 2, b"b")
            + b"\0" * 4
        )
        data = b"\0\0\0\0" + body + struct.pack(">7d", 1, 2, 3, 0, 0, 0, 1)
        assert buffer.add_tf_message(data) == 1
        assert buffer.lookup_transform("a", "b", SECOND + 5).translation == (1.0, 2.0, 3.0)

    def test_refused_among_good(self, buffer: turtlewire.Buffer) -> None:
        data = tf_message(
            ("a", "b", 1, (0, 0, 0, *NO_TURN)),
            ("a", "a", 1, (0, 0, 0, *NO_TURN)),
            ("a", "c", 1, (0, 0, 0, 0, 0, 0, 0)),
        )
        assert buffer.add_tf_message(data) == 1

    def test_every_truncation_is_an_error(self, buffer: turtlewire.Buffer) -> None:
        data = tf_message(
            ("parent", "child", SECOND, (1, 2, 3, *NO_TURN)),
            ("child", "grand", SECOND, (1, 2, 3, *NO_TURN)),
        )
        for size in range(len(data)):
            with pytest.raises(errors.CdrError):
                buffer.add_tf_message(data[:size])
        assert buffer.frames() == []

    @pytest.mark.parametrize(
        "data",
        [
            b"",
            b"\0\1\0\0",
            b"\0\3\0\0\0\0\0\0",
            b"\1\1\0\0\0\0\0\0",
            b"\0\1\0\0\xff\xff\xff\xff",
            b"\0\1\0\0\1\0\0\0" + b"\xff" * 80,
        ],
    )
    def test_malformed(self, buffer: turtlewire.Buffer, data: bytes) -> None:
        with pytest.raises(errors.CdrError):
            buffer.add_tf_message(data)

    def test_name_that_is_not_utf8(self, buffer: turtlewire.Buffer) -> None:
        data = tf_message(("a", "bx", 1, (0, 0, 0, *NO_TURN)), ("a", "c", 1, (0, 0, 0, *NO_TURN)))
        assert buffer.add_tf_message(data.replace(b"bx\0", b"\xff\xfe\0")) == 1
        assert buffer.frames() == ["c", "a"]

    def test_empty_message(self, buffer: turtlewire.Buffer) -> None:
        assert buffer.add_tf_message(tf_message()) == 0

    def test_not_bytes(self, buffer: turtlewire.Buffer) -> None:
        with pytest.raises((TypeError, errors.CdrError)):
            buffer.add_tf_message("text")  # type: ignore[arg-type]


class TestCache:
    def test_clear_keeps_static(self, buffer: turtlewire.Buffer) -> None:
        buffer.set_static_transform("a", "b", (0, 0, 0), NO_TURN)
        buffer.set_transform("b", "c", 1, (0, 0, 0), NO_TURN)
        buffer.clear()
        assert buffer.can_transform("a", "b")
        assert not buffer.can_transform("a", "c", 1)
        assert buffer.frames() == ["b", "a", "c"]
        assert "c" in buffer.frames()
        assert "d" not in buffer.frames()

    def test_full_ring_with_late_arrivals(self, core: Any) -> None:
        buffer = core.Buffer(SECOND)
        step = SECOND // 100
        for i in range(1000):
            late = i ^ 1  # neighbours change places
            buffer.set_transform("a", "b", late * step, (late, 0, 0), NO_TURN)
        for i in range(905, 999):
            assert buffer.lookup_transform("a", "b", i * step + step // 2).x == pytest.approx(
                i + 0.5
            )
        assert not buffer.can_transform("a", "b", 890 * step)

    def test_flood_of_one_stamp(self, buffer: turtlewire.Buffer) -> None:
        for i in range(3000):
            buffer.set_transform("a", "b", SECOND, (i, 0, 0), NO_TURN)
        assert buffer.lookup_transform("a", "b", SECOND).x == 2999.0
        assert "rate: 30000000.000" in buffer.to_yaml()
        buffer.set_transform("a", "b", 2 * SECOND, (7, 0, 0), NO_TURN)
        assert (
            buffer.lookup_transform("a", "b", SECOND).x == 0.0
        )  # at the oldest stamp tf2 answers with the first

    def test_a_flood_is_not_counted_after_clear(self, buffer: turtlewire.Buffer) -> None:
        for i in range(3000):
            buffer.set_transform("a", "b", SECOND, (i, 0, 0), NO_TURN)
        buffer.clear()
        buffer.set_transform("a", "b", SECOND, (0, 0, 0), NO_TURN)
        assert "rate: 10000.000" in buffer.to_yaml()  # one sample, as in a new buffer

    def test_a_flood_is_counted_as_long_as_its_stamp_is_kept(self, core: Any) -> None:
        buffer = core.Buffer(10 * SECOND)
        buffer.set_transform("a", "b", SECOND - 1, (0, 0, 0), NO_TURN)
        for i in range(3000):
            buffer.set_transform("a", "b", SECOND, (i, 0, 0), NO_TURN)
        for i in range(2):  # what is too old by the newest stamp goes with the next sample
            buffer.set_transform("a", "b", 11 * SECOND, (i, 0, 0), NO_TURN)
        assert "rate: 300.200" in buffer.to_yaml()
        for i in range(2):
            buffer.set_transform("a", "b", 11 * SECOND + 1, (i, 0, 0), NO_TURN)
        assert "rate: 40000.000" in buffer.to_yaml()  # four samples in no time

    def test_unlimited(self, core: Any) -> None:
        buffer = core.Buffer(2**63 - 1)
        for t in (-5, 1, 10**18):
            buffer.set_transform("a", "b", t, (0, 0, 0), NO_TURN)
        assert buffer.can_transform("a", "b", -5)

    @pytest.mark.parametrize("samples", [2, 3, 100])
    def test_stamps_at_both_ends_of_time(self, core: Any, samples: int) -> None:
        buffer = core.Buffer(LAST)
        for i in range(samples - 1):
            buffer.set_transform("a", "b", -LAST + i, (0, 0, 0), NO_TURN)
        buffer.set_transform("a", "b", LAST, (2, 0, 0), NO_TURN)
        stamps = [0, -LAST + 200, LAST // 2, LAST - 1, LAST]
        expected = near([1.0, 0.0, 1.5, 2.0, 2.0])
        found = [buffer.lookup_transform("a", "b", stamp).x for stamp in stamps]
        assert found == expected
        assert list(buffer.lookup_transforms("a", "b", np.array(stamps))[:, 0]) == expected
        assert "buffer_length: 18446744073.710\n" in buffer.to_yaml()
        velocity = buffer.lookup_velocity("a", "b", [LAST // 2, LAST], interval_ns=LAST)
        assert list(velocity[:, 0]) == pytest.approx([1e9 / LAST] * 2)

    def test_limits_reach_from_one_end_of_time_to_the_other(self, core: Any) -> None:
        buffer = core.Buffer(LAST)
        for stamp in (0, LAST // 2):
            buffer.set_transform("a", "b", stamp, (stamp, 0, 0), NO_TURN)
        for stamp in (-LAST, LAST):
            assert not buffer.can_transform("a", "b", stamp, extrapolate_ns=1000)
            found = buffer.lookup_transform("a", "b", stamp, extrapolate_ns=LAST)
            assert found.x == float(stamp)
        old = core.Buffer(LAST)
        old.set_transform("a", "b", -LAST, (1, 0, 0), NO_TURN)
        with pytest.raises(errors.ExtrapolationException):
            old.lookup_newest("a", "b", now_ns=LAST, max_age_ns=LAST - 1)
        assert old.lookup_newest("a", "b", now_ns=-2, max_age_ns=LAST - 1).x == 1.0


class TestTransform:
    def test_value(self, core: Any) -> None:
        t = core.Transform("a", "b", (1, 2, 3), QUARTER, stamp_ns=5)
        assert (t.x, t.y, t.z) == t.translation == (1.0, 2.0, 3.0)
        assert t.rotation == QUARTER
        assert t == core.Transform("a", "b", (1, 2, 3), QUARTER, stamp_ns=5)
        assert t != core.Transform("a", "c", (1, 2, 3), QUARTER, stamp_ns=5)
        assert repr(t) == f"Transform('a', 'b', (1.0, 2.0, 3.0), {QUARTER!r}, stamp_ns=5)"
        assert t.inverse().inverse().translation == near((1, 2, 3))
        with pytest.raises(AttributeError):
            t.x = 3.0
        with pytest.raises(TypeError):
            hash(t)

    def test_pickle(
        self, core: Any, buffer: turtlewire.Buffer, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(
            "turtlewire.Transform", core.Transform
        )  # as in a process that runs on this core
        buffer.set_transform("a", "b", 1, (1, 2, 3), QUARTER)
        found = buffer.lookup_transform("a", "b")
        assert pickle.loads(pickle.dumps(found)) == found

    def test_arrays(self, core: Any) -> None:
        t = core.Transform("a", "b", (1, 2, 3), QUARTER, stamp_ns=5)
        assert np.array_equal(np.asarray(t), [1, 2, 3, *QUARTER])
        assert np.asarray(t, dtype=np.float32).dtype == np.float32
        with pytest.raises(ValueError, match="its array is always a copy"):
            t.__array__(copy=False)
        assert np.allclose(t.as_matrix(), [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])


class TestWaiting:
    @pytest.mark.parametrize(
        "add",
        [
            lambda buffer: buffer.set_transform("b", "c", SECOND, (1, 0, 0)),
            lambda buffer: buffer.set_transforms("b", "c", [SECOND], [[1, 0, 0, *NO_TURN]]),
            lambda buffer: buffer.add_tf_message(
                tf_message(("b", "c", SECOND, (1, 0, 0, *NO_TURN)))
            ),
        ],
        ids=["one", "batch", "message"],
    )
    def test_wakes_when_data_comes(self, buffer: turtlewire.Buffer, add: Any) -> None:
        begun = threading.Event()

        def feed() -> None:
            begun.wait()
            buffer.set_transform("a", "b", SECOND, (1, 0, 0), NO_TURN)
            add(buffer)

        feeder = threading.Thread(target=feed)
        feeder.start()
        begun.set()
        # Longer than a test may take: at its timeout, a lookup that nothing woke succeeds as well.
        assert buffer.lookup_transform("a", "c", SECOND, timeout_ns=3600 * SECOND).x == 2.0
        feeder.join()

    def test_gives_up(self, buffer: turtlewire.Buffer) -> None:
        start = time.monotonic()
        with pytest.raises(errors.LookupException):
            buffer.lookup_transform("a", "b", timeout_ns=SECOND // 20)
        assert not buffer.can_transform("a", "b", None, timeout_ns=SECOND // 20)
        assert time.monotonic() - start >= 0.1

    def test_does_not_wait_for_the_impossible(self, buffer: turtlewire.Buffer) -> None:
        for t in (100, 101):
            buffer.set_transform("a", "b", t * SECOND, (0, 0, 0), NO_TURN)
        start = time.monotonic()
        with pytest.raises(errors.ExtrapolationException):
            buffer.lookup_transform("a", "b", 90 * SECOND, timeout_ns=3600 * SECOND)
        with pytest.raises(errors.InvalidArgumentException):
            buffer.lookup_transform("a", "/b", timeout_ns=3600 * SECOND)
        assert time.monotonic() - start < 600

    def test_waits_for_what_the_cache_would_still_take(self, buffer: turtlewire.Buffer) -> None:
        for t in (105, 110):
            buffer.set_transform("a", "b", t * SECOND, (0, 0, 0), NO_TURN)
        start = time.monotonic()
        with pytest.raises(errors.ExtrapolationException):
            buffer.lookup_transform("a", "b", 100 * SECOND, timeout_ns=SECOND // 10)
        assert time.monotonic() - start >= 0.1
        with pytest.raises(errors.ExtrapolationException):
            buffer.lookup_transform("a", "b", 100 * SECOND - 1, timeout_ns=3600 * SECOND)
        with pytest.raises(errors.InvalidTransformError):
            buffer.set_transform("a", "b", 100 * SECOND - 1, (0, 0, 0), NO_TURN)
        buffer.set_transform("a", "b", 100 * SECOND, (0, 0, 0), NO_TURN)

    @pytest.mark.parametrize("full", [False, True])
    def test_the_latest_time_never_leaves_the_cache(
        self, buffer: turtlewire.Buffer, full: bool
    ) -> None:
        """A link that has stood still for longer than the cache may go on."""
        for t in range(90, 101):
            buffer.set_transform("a", "b", t * SECOND, (1, 0, 0), NO_TURN)
        buffer.set_transform("b", "c", 50 * SECOND, (1, 0, 0), NO_TURN)
        goes_on = threading.Timer(
            0.05, lambda: buffer.set_transform("b", "c", 100 * SECOND, (2, 0, 0), NO_TURN)
        )
        goes_on.start()
        if full:
            assert (
                buffer.lookup_transform("a", "c", None, fixed_frame="a", timeout_ns=60 * SECOND).x
                == 3.0
            )
        else:
            assert buffer.lookup_transform("a", "c", timeout_ns=60 * SECOND).x == 3.0
        goes_on.join()

    def test_many_waiters(self, buffer: turtlewire.Buffer) -> None:
        results: list[float] = []
        waiters = [
            threading.Thread(
                target=lambda t=t: results.append(
                    buffer.lookup_transform("a", "b", t * SECOND, timeout_ns=60 * SECOND).x
                )
            )  # type: ignore[misc]
            for t in range(1, 9)
        ]
        for waiter in waiters:
            waiter.start()
        for t in range(1, 9):
            buffer.set_transform("a", "b", t * SECOND, (t, 0, 0), NO_TURN)
        for waiter in waiters:
            waiter.join(60)
        assert sorted(results) == [float(t) for t in range(1, 9)]

    @pytest.mark.parametrize("core_name", ["native", "python"])
    def test_ctrl_c_ends_a_wait_of_the_main_thread(self, core_name: str) -> None:
        if core_name == "native":
            pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
        program = (
            "import turtlewire\n"
            "turtlewire.Buffer\n"
            "try:\n"
            "    print('ready', flush=True)\n"
            "    turtlewire.Buffer().lookup_transform('a', 'b', timeout_ns=3600 * 10**9)\n"
            "except KeyboardInterrupt:\n"
            "    print('interrupted')\n"
        )
        environment = {**os.environ, "TURTLEWIRE_CORE": core_name}
        with subprocess.Popen(
            [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, env=environment
        ) as child:
            assert child.stdout is not None
            assert child.stdout.readline() == "ready\n"
            asked = time.monotonic()
            while child.poll() is None and time.monotonic() - asked < 60:
                child.send_signal(2)  # again, should the first have come before the wait began
                try:
                    child.wait(0.5)
                except subprocess.TimeoutExpired:
                    continue
            assert child.stdout.read() == "interrupted\n"


class TestThreads:
    def test_readers_beside_a_writer(self, core: Any) -> None:
        """100 transforms a message.

        Readers of every kind, each of whose answers must be of one state of the buffer.
        """
        buffer = core.Buffer(SECOND)
        links = [("base", f"link{i}") for i in range(100)]
        stop, faults = threading.Event(), []

        def message(i: int) -> bytes:
            return tf_message(
                *[
                    (parent, child, i * SECOND // 1000, (i, i, i, *NO_TURN))
                    for parent, child in links
                ]
            )

        def read(i: int) -> None:
            try:
                while not stop.is_set():
                    found = buffer.lookup_transform("base", f"link{i}")
                    assert found.x == found.y == found.z == pytest.approx(found.stamp_ns / 1e6)
                    stamps = found.stamp_ns - np.arange(20, dtype=np.int64) * 100_000
                    poses = buffer.lookup_transforms("base", f"link{i}", stamps, errors="nan")
                    known = ~np.isnan(poses[:, 0])
                    assert np.allclose(poses[known, 0], stamps[known] / 1e6)
                    buffer.can_transform(f"link{i}", "link99", found.stamp_ns)
                    buffer._frames_as_string()
            except Exception as error:
                faults.append(error)

        buffer.add_tf_message(message(99))
        readers = [threading.Thread(target=read, args=(i,)) for i in range(4)]
        for reader in readers:
            reader.start()
        for i in range(100, 250):
            assert buffer.add_tf_message(message(i)) == 100
        stop.set()
        for reader in readers:
            reader.join()
        assert faults == []


class TestListeners:
    def test_called_after_data(self, buffer: turtlewire.Buffer) -> None:
        seen: list[bool] = []
        remove = buffer.on_change(lambda: seen.append(buffer.can_transform("a", "b")))
        buffer.set_transform("a", "b", 1, (0, 0, 0), NO_TURN)
        buffer.add_tf_message(tf_message(("a", "b", 2, (0, 0, 0, *NO_TURN))))
        buffer.set_transforms("a", "b", [3], [[0, 0, 0, *NO_TURN]])
        with pytest.raises(errors.InvalidTransformError):
            buffer.set_transform("a", "a", 1, (0, 0, 0), NO_TURN)
        assert seen == [True, True, True]
        remove()
        remove()
        buffer.set_transform("a", "b", 4, (0, 0, 0), NO_TURN)
        assert len(seen) == 3

    def test_fault_of_a_listener_is_reported(
        self, buffer: turtlewire.Buffer, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        faults: list[Any] = []
        monkeypatch.setattr(sys, "unraisablehook", lambda details: faults.append(details.exc_type))
        buffer.on_change(lambda: 1 / 0)  # type: ignore[arg-type, return-value]
        buffer.set_transform("a", "b", 1, (0, 0, 0), NO_TURN)
        assert faults == [ZeroDivisionError]

    def test_cycle_is_collected(self, core: Any) -> None:
        buffer = core.Buffer()
        buffer.on_change(lambda kept=buffer: None)
        gone = weakref.ref(buffer)
        del buffer
        gc.collect()
        assert gone() is None


class TestChoiceOfCore:
    def run(self, code: str, **environment: str) -> subprocess.CompletedProcess[str]:
        clean = {k: v for k, v in os.environ.items() if not k.startswith("TURTLEWIRE_")}
        return run_python(code, check=False, timeout=300, env=clean | environment)

    def test_python_on_request(self) -> None:
        run = self.run(
            "import turtlewire.tf.buffer as b; print(b.CORE, b.Buffer.__module__)",
            TURTLEWIRE_CORE="python",
        )
        assert (run.stdout, run.stderr) == ("python turtlewire\n", "")

    def test_wrong_request(self) -> None:
        pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
        run = self.run("import turtlewire.tf.buffer as b; print(b.CORE)", TURTLEWIRE_CORE="foo")
        assert run.stdout == "native\n"
        assert run.stderr.count("\n") == 1
        assert "TURTLEWIRE_CORE is 'foo'; it can be 'native' or 'python'" in run.stderr

    def test_wrong_request_is_said_once_by_all_who_have_compiled_parts(self) -> None:
        """The wire, the writer of joints' frames and the buffer, whichever comes first."""
        pytest.importorskip("cyclonedds", reason="Cyclone is not installed")
        modules = ["wire.cyclone.native", "urdf.joint_messages", "tf.buffer"]
        for first in range(3):
            names = modules[first:] + modules[:first]
            code = "".join(f"import turtlewire.{name}\n" for name in names)
            run = self.run(code + "print('done')", TURTLEWIRE_CORE="foo")
            assert run.stdout == "done\n", run.stderr
            assert run.stderr.count("TURTLEWIRE_CORE is 'foo'") == 1, run.stderr

    MISSING = "import sys; sys.modules['turtlewire._native'] = None\n"

    def test_missing_native_is_not_said_by_each_process(self) -> None:
        run = self.run(self.MISSING + "import turtlewire; print(turtlewire.Buffer().frames())")
        assert (run.stdout, run.stderr) == ("[]\n", "")

    def test_missing_native_can_be_an_error(self) -> None:
        run = self.run(
            self.MISSING + "import turtlewire; turtlewire.Buffer", TURTLEWIRE_REQUIRE_NATIVE="1"
        )
        assert (
            "ImportError: the compiled core of turtlewire is required here, but it is not built"
            in run.stderr
        )

    def test_import_is_light(self) -> None:
        code = (
            "import sys, turtlewire; turtlewire.Buffer().set_transform('a', 'b', 1, (0, 0, 0), "
            "(0, 0, 0, 1)); print('numpy' in sys.modules)"
        )
        assert self.run(code).stdout == "False\n"


# ---------------------------------------------------------------- a limit of frames


def put(buffer, parent, child, stamp_ns=1):
    pose = (1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    return buffer._set_transform(parent, child, stamp_ns, *pose, False, "default_authority")


def test_frames_beyond_the_limit_are_refused_and_known_ones_go_on(core):
    buffer = core.Buffer(max_frames=np.int8(3))
    assert (buffer.max_frames, type(buffer.max_frames), core.Buffer().max_frames) == (3, int, None)
    assert put(buffer, "map", "a") == put(buffer, "map", "b") == ""
    assert not buffer.is_full
    assert put(buffer, "map", "c") == (
        'Ignoring transform from authority "default_authority": frame "c" or its parent "map" is '
        "new, and the buffer holds as many frames as max_frames allows"
    )
    assert buffer.is_full
    assert buffer.frames() == ["a", "map", "b"]
    assert put(buffer, "a", "b", 2) == put(buffer, "map", "a", 2) == ""  # moves and a new parent
    assert buffer.lookup_transform("map", "b", 2).translation == (2.0, 0.0, 0.0)
    assert "too_many_frames" in buffer._describe_refusals()["c"][0]
    assert buffer._refusal_kinds() == 0


def test_both_frames_of_a_transform_count(core):
    buffer = core.Buffer(max_frames=3)
    put(buffer, "map", "a")
    assert "max_frames" in put(buffer, "other", "frame")
    assert buffer.frames() == ["a", "map"]
    assert put(buffer, "other", "a") == ""
    assert "max_frames" in put(buffer, "one_more", "a")


def test_removed_frames_make_room_once_more(core):
    buffer = core.Buffer(max_frames=2)
    put(buffer, "map", "a")
    put(buffer, "map", "b")
    assert not buffer.remove_frame("no such frame")
    assert buffer.is_full
    buffer.remove_frame("a")
    assert not buffer.is_full
    assert put(buffer, "map", "b") == ""
    assert "max_frames" in put(buffer, "map", "c")
    assert buffer.is_full
    buffer.clear()
    assert "max_frames" in put(buffer, "map", "c")


def test_without_a_limit_all_frames_are_taken(core):
    buffer = core.Buffer(max_frames=None)
    assert all(put(buffer, "map", f"frame{i}") == "" for i in range(1000))
    assert not buffer.is_full


@pytest.mark.parametrize("limit", [1, 0, -1])
def test_a_limit_that_takes_no_transform(core, limit):
    with pytest.raises(ValueError, match="max_frames must be at least 2"):
        core.Buffer(max_frames=limit)
    with pytest.raises(TypeError):
        core.Buffer(max_frames="many")
