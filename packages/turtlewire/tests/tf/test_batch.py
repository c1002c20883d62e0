"""Arrays in and out, on both cores: each item equals the single lookup."""

from __future__ import annotations

import contextlib
import math
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from turtlewire import errors

if TYPE_CHECKING:
    import turtlewire

MS = 1_000_000
START = 1_700_000_000_000_000_000


@pytest.fixture
def chain(buffer: turtlewire.Buffer) -> turtlewire.Buffer:
    """map <- odom <- base <- camera, and base <- lidar <- chip: moving, moving, fixed.

    Fixed, moving in leaps above 10 degrees.
    """
    for i in range(200):
        a = 0.01 * i
        t = START + i * 5 * MS + (i % 7) * 1000
        buffer.set_transform(
            "map", "odom", t, (i, math.sin(a), 0), (0, 0, math.sin(a), math.cos(a))
        )
        buffer.set_transform(
            "odom",
            "base",
            t + 2 * MS,
            (0, math.cos(a), 1),
            (math.sin(2 * a), 0, 0, math.cos(2 * a)),
        )
        buffer.set_transform(
            "lidar", "chip", t, (0, 0, a), (0, math.sin(30 * a), 0, math.cos(30 * a))
        )
    buffer.set_static_transform("base", "camera", (1, 2, 3), (0.48, 0.36, 0.0, 0.8))
    buffer.set_static_transform("base", "lidar", (0, 0, 1), (0, 0, 1, 0))
    return buffer


def stamps(n: int, seed: int = 1) -> np.ndarray[Any, np.dtype[np.int64]]:
    return START + np.random.default_rng(seed).integers(5 * MS, 990 * MS, n)


PAIRS = [
    ("map", "camera"),
    ("camera", "map"),
    ("camera", "chip"),
    ("base", "lidar"),
    ("odom", "odom"),
    ("chip", "odom"),
]


@pytest.mark.parametrize(("target", "source"), PAIRS)
@pytest.mark.parametrize("n", [0, 1, 11, 12, 64, 65, 200])
def test_equals_single_lookups(chain: turtlewire.Buffer, target: str, source: str, n: int) -> None:
    for times in (stamps(n), np.sort(stamps(n))):
        poses = chain.lookup_transforms(target, source, times)
        assert poses.shape == (n, 7)
        singles = [np.asarray(chain.lookup_transform(target, source, int(t))) for t in times]
        assert poses == pytest.approx(np.array(singles).reshape(n, 7), abs=1e-12)
        matrices = chain.lookup_transforms(target, source, times, matrices=True)
        expected = [chain.lookup_transform(target, source, int(t)).as_matrix() for t in times]
        assert matrices == pytest.approx(np.array(expected).reshape(n, 4, 4), abs=1e-12)


def test_zero_is_the_latest(chain: turtlewire.Buffer) -> None:
    with pytest.raises(errors.ExtrapolationException, match="into the past"):  # 0 is a time
        chain.lookup_transforms("map", "camera", np.zeros(20, dtype=np.int64))


def test_rows_without_an_answer_are_nan(chain: turtlewire.Buffer) -> None:
    times = stamps(100)
    times[3], times[70] = START - 1, START + 10_000 * MS
    out = np.empty((100, 7))
    assert chain.lookup_transforms("map", "camera", times, out=out, errors="nan") is out
    reasons = [chain.explain("map", "camera", times[i]) for i in (3, 4, 70)]
    assert [getattr(reason, "reason", None) for reason in reasons] == ["past", None, "future"]
    assert np.isnan(out[[3, 70]]).all()
    assert np.isfinite(np.delete(out, [3, 70], axis=0)).all()
    assert np.isnan(chain.lookup_transforms("map", "nobody", times, errors="nan")).all()
    assert isinstance(chain.explain("map", "nobody"), errors.LookupException)
    chain.set_transform("island", "palm", 1, (0, 0, 0), (0, 0, 0, 1))
    assert np.isnan(chain.lookup_transforms("map", "palm", times[:3], errors="nan")).all()


def test_a_batch_may_extrapolate(chain: turtlewire.Buffer) -> None:
    times = stamps(100)
    newest = chain.time_range("map", "camera")[1]
    times[70], times[3] = newest + 10 * MS, newest + 30 * MS
    poses = chain.lookup_transforms(
        "map", "camera", times, errors="nan", extrapolate_ns=np.timedelta64(20, "ms")
    )
    assert np.flatnonzero(np.isnan(poses[:, 0])).tolist() == [3]
    one = chain.lookup_transform("map", "camera", times[70], extrapolate_ns=20 * MS)
    assert poses[70] == pytest.approx(np.asarray(one))
    few = chain.lookup_transforms("map", "camera", times[70:71], extrapolate_ns=20 * MS)
    assert few[0] == pytest.approx(np.asarray(one))
    with pytest.raises(ValueError, match="must not be negative"):
        chain.lookup_transforms("map", "camera", times, extrapolate_ns=-1)


@pytest.mark.parametrize("begin", [0, 1, -1, -3_000_000_000])
def test_data_around_time_0(buffer: turtlewire.Buffer, begin: int) -> None:
    second = 1_000_000_000
    for i in range(4):
        buffer.set_transform("map", "base", begin + i * second, (i, 0, 0))
    times = begin + second * np.arange(4)
    assert buffer.lookup_transforms("map", "base", times)[:, 0].tolist() == [0, 1, 2, 3]
    assert [buffer.lookup_transform("map", "base", t).x for t in times] == [0, 1, 2, 3]
    assert buffer.lookup_transform("map", "base").x == 3
    assert buffer.lookup_transform("map", "base", None).stamp_ns == times[3]
    assert buffer.lookup_all("map", begin).stamps_ns.tolist() == [begin, begin]
    assert buffer.time_range("map", "base") == (begin, times[3])
    assert buffer.can_transform("map", "base", begin)
    assert not buffer.can_transform("map", "base", begin - 1)
    moved = buffer.transform_points("map", "base", np.zeros((4, 3)), times)
    assert moved[:, 0].tolist() == [0, 1, 2, 3]


def test_static_links_answer_without_a_time(buffer: turtlewire.Buffer) -> None:
    buffer.set_static_transform("base", "lidar", (0, 0, 1))
    buffer.set_static_transform("base", "camera", (1, 0, 0))
    found = buffer.lookup_transform("camera", "lidar")
    assert (found.stamp_ns, found.translation) == (None, (-1.0, 0.0, 1.0))
    assert buffer.lookup_transform("camera", "lidar", 0).stamp_ns == 0
    assert buffer.lookup_newest("camera", "lidar").stamp_ns is None
    assert buffer.time_range("camera", "lidar") is None
    assert buffer.lookup_velocity("camera", "lidar").tolist() == [0] * 6
    nat = np.datetime64("NaT", "ns")
    assert np.isnat(buffer.lookup_all("base").stamps_ns.view("datetime64[ns]")).all()
    for wrong in (nat, -(2**63)):
        with pytest.raises(ValueError, match="NaT"):
            buffer.lookup_transform("camera", "lidar", wrong)
        with pytest.raises(ValueError, match="NaT"):
            buffer.lookup_transforms("camera", "lidar", np.array([wrong]))


def test_raises_for_the_first(chain: turtlewire.Buffer) -> None:
    times = stamps(100)
    times[70] = START + 10_000 * MS
    with pytest.raises(errors.ExtrapolationException) as caught:
        chain.lookup_transforms("map", "camera", times)
    assert (caught.value.reason, caught.value.requested_ns) == ("future", times[70])
    with pytest.raises(errors.LookupException):
        chain.lookup_transforms("map", "nobody", times)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ({"stamps": [1.5]}, TypeError),
        ({"stamps": [[1]]}, ValueError),
        ({"stamps": [1], "out": np.empty((2, 7))}, ValueError),
        ({"stamps": [1], "out": np.empty((1, 7), dtype=np.float32)}, TypeError),
        ({"stamps": [1, 2], "out": np.empty((7, 2)).T}, TypeError),
        ({"stamps": [1], "out": [[0.0] * 7]}, TypeError),
        ({"stamps": [1], "errors": "skip"}, ValueError),
        ({"stamps": [math.nan]}, TypeError),
        ({"stamps": np.array([1, 2**63], dtype=np.uint64)}, OverflowError),
        ({"stamps": [2**64 - 1]}, OverflowError),
    ],
)
def test_wrong_arrays(chain: turtlewire.Buffer, arguments: Any, error: type[Exception]) -> None:
    with pytest.raises(error):
        chain.lookup_transforms("map", "odom", **arguments)


def test_stamps_of_other_kinds(chain: turtlewire.Buffer) -> None:
    expected = np.asarray(chain.lookup_transform("map", "odom", START + 5 * MS))
    for times in (
        [START + 5 * MS],
        np.array([START + 5 * MS], dtype=np.uint64),
        np.array([START + 5 * MS, 0])[::2],
    ):
        assert chain.lookup_transforms("map", "odom", times)[0] == pytest.approx(expected)


def test_all_frames(chain: turtlewire.Buffer) -> None:
    chain.set_transform("island", "palm", START, (0, 0, 0), (0, 0, 0, 1))
    for t in (START + 500 * MS + 1, None):
        frames, poses, times = chain.lookup_all("camera", t)
        assert set(frames) == {"map", "odom", "base", "lidar", "chip", "camera"}
        for frame, pose, time in zip(frames, poses, times, strict=True):
            found = chain.lookup_transform("camera", frame, t)
            assert pose == pytest.approx(np.asarray(found), abs=1e-12)
            assert time == (-(2**63) if found.stamp_ns is None else found.stamp_ns)
    with pytest.raises(errors.LookupException):
        chain.lookup_all("nobody")


def test_all_frames_of_a_reparented_and_looping_tree(buffer: turtlewire.Buffer) -> None:
    still = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    for t in (1, 2, 3):
        buffer.set_transform("a", "b", t, *still)
        buffer.set_transform("a" if t < 3 else "b", "c", t, *still)
        buffer.set_transform("y", "x", t, *still)
        buffer.set_transform("x", "y", t, *still)
    assert set(buffer.lookup_all("a", 2)[0]) == {"a", "b", "c"}
    assert set(buffer.lookup_all("x", 2)[0]) <= {"x", "y"}


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_points(chain: turtlewire.Buffer, dtype: Any) -> None:
    points = np.random.default_rng(2).normal(size=(130, 3)).astype(dtype)
    t = START + 333 * MS
    matrix = chain.lookup_transform("map", "camera", t).as_matrix()
    moved = chain.transform_points("map", "camera", points, t)
    assert moved.dtype == dtype
    tolerance = 1e-4 if dtype == np.float32 else 1e-11
    assert moved == pytest.approx(
        (points @ matrix[:3, :3].T + matrix[:3, 3]).astype(dtype), abs=tolerance
    )
    same = points.copy()
    assert chain.transform_points("map", "camera", same, t, out=same) is same
    assert np.array_equal(same, moved)


def test_points_that_overlap_their_output(chain: turtlewire.Buffer) -> None:
    points, times = np.random.default_rng(2).normal(size=(130, 3)), stamps(129)
    for when in (START + 333 * MS, times):
        for read, written in ((slice(None, -1), slice(1, None)), (slice(1, None), slice(None, -1))):
            expected = chain.transform_points("map", "camera", points[read].copy(), when)
            shared = points.copy()
            chain.transform_points("map", "camera", shared[read], when, out=shared[written])
            assert np.array_equal(shared[written], expected)


def test_one_time_of_an_array(chain: turtlewire.Buffer) -> None:
    times, points = stamps(3), np.ones((2, 3))
    assert np.array_equal(
        chain.transform_points("map", "camera", points, times[1]),
        chain.transform_points("map", "camera", points, int(times[1])),
    )
    assert chain.lookup_velocity("map", "base", times[1]).shape == (6,)
    assert chain.lookup_transform("map", "camera", times[1]) == chain.lookup_transform(
        "map", "camera", int(times[1])
    )


def test_a_target_time_needs_a_fixed_frame(chain: turtlewire.Buffer) -> None:
    with pytest.raises(ValueError, match="needs fixed_frame"):
        chain.transform_points("map", "camera", np.ones((2, 3)), START, target_stamp_ns=START)


def test_points_at_their_own_times(chain: turtlewire.Buffer) -> None:
    points, times = np.random.default_rng(2).normal(size=(130, 3)), stamps(130)
    moved = chain.transform_points("map", "camera", points, times)
    expected = [
        (m := chain.lookup_transform("map", "camera", int(t)).as_matrix())[:3, :3] @ p + m[:3, 3]
        for p, t in zip(points, times, strict=True)
    ]
    assert moved == pytest.approx(np.array(expected), abs=1e-11)
    deskewed = chain.transform_points(
        "camera", "camera", points, times, fixed_frame="map", target_stamp_ns=START + 900 * MS
    )
    last = chain.lookup_transform("camera", "map", START + 900 * MS).as_matrix()
    assert deskewed == pytest.approx(moved @ last[:3, :3].T + last[:3, 3], abs=1e-11)
    times[5] = START - 5
    moved = chain.transform_points("map", "camera", points, times, errors="nan")
    assert np.flatnonzero(np.isnan(moved).all(axis=1)).tolist() == [5]
    with pytest.raises(ValueError, match="one for each point"):
        chain.transform_points("map", "camera", points, times[:5])
    with pytest.raises(ValueError, match="shape"):
        chain.transform_points("map", "camera", points[:, :2])


class TestVelocity:
    """A disc of frame `disc` turns at 2 rad/s about z and moves at 3 m/s along x of `world`.

    `rim` is fixed to it, 1 m out.
    """

    @pytest.fixture
    def disc(self, buffer: turtlewire.Buffer) -> turtlewire.Buffer:
        for i in range(2001):
            t = i * 0.001
            stamp = START + i * MS
            buffer.set_transform(
                "world", "disc", stamp, (3 * t, 0, 0), (0, 0, math.sin(t), math.cos(t))
            )
        buffer.set_static_transform("disc", "rim", (1, 0, 0), (0, 0, 0, 1))
        buffer.set_static_transform(
            "world", "tilted", (5, 5, 5), (math.sin(math.pi / 4), 0, 0, math.cos(math.pi / 4))
        )
        return buffer

    def test_velocity_of_the_body(self, disc: turtlewire.Buffer) -> None:
        seen = disc.lookup_velocity("world", "disc", START + 1000 * MS, interval_ns=10 * MS)
        assert seen == pytest.approx([3, 0, 0, 0, 0, 2], abs=1e-9)

    def test_velocity_of_a_point(self, disc: turtlewire.Buffer) -> None:
        t = START + 1000 * MS
        expected = [3 - 2 * math.sin(2), 2 * math.cos(2), 0, 0, 0, 2]
        assert disc.lookup_velocity(
            "world", "disc", t, interval_ns=2 * MS, point=(1, 0, 0)
        ) == pytest.approx(expected, abs=1e-5)
        assert disc.lookup_velocity(
            "world", "disc", t, interval_ns=2 * MS, point_frame="rim"
        ) == pytest.approx(expected, abs=1e-5)
        assert disc.lookup_velocity("world", "rim", t, interval_ns=2 * MS) == pytest.approx(
            expected, abs=1e-5
        )

    def test_an_unknown_point_has_no_velocity(self, disc: turtlewire.Buffer) -> None:
        seen = disc.lookup_velocity(
            "world", "disc", [START, START + MS], point_frame="nobody", errors="nan"
        )
        assert np.isnan(seen).all()

    def test_in_other_axes(self, disc: turtlewire.Buffer) -> None:
        t = START + 500 * MS
        body = disc.lookup_velocity("world", "disc", t, interval_ns=2 * MS, axes_frame="disc")
        assert body == pytest.approx([3 * math.cos(1), -3 * math.sin(1), 0, 0, 0, 2], abs=1e-5)
        tilted = disc.lookup_velocity("world", "disc", t, interval_ns=2 * MS, axes_frame="tilted")
        assert tilted == pytest.approx([3, 0, 0, 0, 2, 0], abs=1e-9)

    def test_the_other_way_round(self, disc: turtlewire.Buffer) -> None:
        seen = disc.lookup_velocity("disc", "world", START + 1000 * MS, interval_ns=2 * MS)
        assert seen[3:] == pytest.approx([0, 0, -2], abs=1e-9)

    def test_many_and_latest(self, disc: turtlewire.Buffer) -> None:
        times = START + np.arange(100, 1900, 10) * MS
        many = disc.lookup_velocity("world", "disc", times, interval_ns=2 * MS, point=(1, 0, 0))
        singles = [
            disc.lookup_velocity("world", "disc", int(t), interval_ns=2 * MS, point=(1, 0, 0))
            for t in times
        ]
        assert many == pytest.approx(np.array(singles), abs=1e-9)
        assert disc.lookup_velocity("world", "disc") == pytest.approx([3, 0, 0, 0, 0, 2], abs=1e-9)

    def test_a_point_that_changes_while_it_is_read(self, disc: turtlewire.Buffer) -> None:
        class Vanishing:
            def __float__(self) -> float:
                point.clear()
                return 1.0

        point: list[Any] = [Vanishing(), *(object() for _ in range(2))]
        with pytest.raises(TypeError):
            disc.lookup_velocity("world", "disc", point=point)  # type: ignore[arg-type]
        point[:] = [Vanishing(), 2.0, 3.0]
        moving = disc.lookup_velocity("world", "disc", point=point)  # type: ignore[arg-type]
        assert moving == pytest.approx(disc.lookup_velocity("world", "disc", point=(1, 2, 3)))

    def test_failures(self, disc: turtlewire.Buffer) -> None:
        with pytest.raises(errors.ExtrapolationException, match="into the future"):
            disc.lookup_velocity("world", "disc", START + 9000 * MS)
        with pytest.raises(errors.ExtrapolationException, match="into the past"):
            disc.lookup_velocity("world", "disc", START)
        with pytest.raises(errors.LookupException):
            disc.lookup_velocity("world", "disc", START + 500 * MS, axes_frame="nobody")
        with pytest.raises(ValueError, match="positive"):
            disc.lookup_velocity("world", "disc", interval_ns=0)
        seen = disc.lookup_velocity("world", "disc", [START, START + 500 * MS], errors="nan")
        assert np.isnan(seen[0]).all()


@given(
    rows=st.lists(
        st.tuples(
            st.integers(0, 12),  # seconds: repeated, late, and later than the cache is long
            st.sampled_from([0.0, 1.0, math.nan, math.inf]),
            st.sampled_from([0.0, 0.5, 1.0]),
        ),
        max_size=30,
    ),
    parents=st.lists(st.sampled_from(["a", "z"]), min_size=1, max_size=3),
    is_lyrical=st.booleans(),
)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_rows_of_a_batch_are_added_as_single_transforms_are(
    core, monkeypatch, rows, parents, is_lyrical
) -> None:
    monkeypatch.setenv("ROS_DISTRO", "lyrical" if is_lyrical else "jazzy")
    together, single = core.Buffer(5 * 10**9), core.Buffer(5 * 10**9)
    poses = np.array([(x, 0, 0, 0, 0, z, 1) for _, x, z in rows]).reshape(-1, 7)
    stamps = np.array([second * 10**9 for second, _, _ in rows], np.int64)
    for parent in parents:
        together.set_transforms(parent, "b", stamps, poses, errors="skip", sender="s")
        for stamp, pose in zip(stamps.tolist(), poses.tolist(), strict=True):
            with contextlib.suppress(errors.InvalidTransformError):
                single.set_transform(parent, "b", stamp, pose[:3], pose[3:], sender="s")
    assert together.frames() == single.frames()
    assert together._describe_refusals() == single._describe_refusals()
    if together.frames():
        for one, other in zip(together.samples("b"), single.samples("b"), strict=True):
            assert one.parent_frame == other.parent_frame
            np.testing.assert_array_equal(one.stamps_ns, other.stamps_ns)
            np.testing.assert_array_equal(one.poses, other.poses)
        assert together.to_yaml() == single.to_yaml()
        assert together._describe_links(9) == single._describe_links(9)


@pytest.mark.parametrize("cache_s", [3, 50, 10_000])
@pytest.mark.parametrize("refused", [None, 0, 32, 77, 199])
@pytest.mark.parametrize("held", [0, 1, 5, 40])
def test_a_long_array_in_order_is_added_as_single_transforms_are(
    core, cache_s, refused, held
) -> None:
    count = 200
    rng = np.random.default_rng(held)
    poses = rng.normal(size=(count, 7))
    poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1)[:, None]
    poses[::3] = poses[::3].astype(np.float32)  # not unit to double precision
    poses[5, 0] = math.inf
    if refused is not None:
        poses[refused, 2] = math.nan
    stamps = (np.arange(count) + held) * 10**9
    together, single = core.Buffer(cache_s * 10**9), core.Buffer(cache_s * 10**9)
    for buffer in together, single:
        for second in range(held):
            buffer.set_transform("z", "b", second * 10**9, (second, 0, 0))
    kept = together.set_transforms("a", "b", stamps, poses, errors="skip")
    for stamp, pose in zip(stamps.tolist(), poses.tolist(), strict=True):
        with contextlib.suppress(errors.InvalidTransformError):
            single.set_transform("a", "b", stamp, pose[:3], pose[3:])
    assert together._describe_refusals() == single._describe_refusals()
    assert together._describe_links(9) == single._describe_links(9)
    for one, other in zip(together.samples("b"), single.samples("b"), strict=True):
        assert one.parent_frame == other.parent_frame
        np.testing.assert_array_equal(one.stamps_ns, other.stamps_ns)
        np.testing.assert_array_equal(one.poses, other.poses)
    assert kept == len(single.samples("b")[-1].stamps_ns)
    assert together._fault() == ""


STAMP = 1_700_000_000_123_456_789


@pytest.fixture
def filled(buffer):
    for i in range(3):
        buffer.set_transform("a", "b", STAMP + i, (i, 0, 0), (0, 0, 0, 1))
    return buffer


def test_datetime64_is_a_stamp(filled):
    time = np.datetime64(STAMP, "ns")
    later = time + np.timedelta64(1, "ns")
    assert filled.lookup_transform("a", "b", time).stamp_ns == STAMP
    assert (
        filled.lookup_transform("a", "b", time, fixed_frame="a", target_stamp_ns=later).stamp_ns
        == STAMP + 1
    )
    assert filled.can_transform("a", "b", later)
    assert filled.lookup_transforms("a", "b", np.array([time, later]))[:, 0].tolist() == [0, 1]
    assert filled.lookup_all("a", later).poses[:, 0].max() == 1
    assert filled.transform_points("a", "b", np.zeros((1, 3)), later).tolist() == [[1, 0, 0]]
    assert filled.lookup_velocity("a", "b", later, interval_ns=2).shape == (6,)
    assert (
        filled.lookup_transform("a", "b", time + np.timedelta64(4, "ns"), extrapolate_ns=10).x == 4
    )
    filled.set_transform("a", "b", time + np.timedelta64(9, "ns"), (9, 0, 0), (0, 0, 0, 1))
    assert filled._stamps("b").tolist() == [STAMP, STAMP + 1, STAMP + 2, STAMP + 9]


def test_coarser_units_and_pandas(filled):
    filled.set_transform("a", "c", np.datetime64("2023-11-14T22:13:20"), (1, 0, 0), (0, 0, 0, 1))
    assert filled._stamps("c").tolist() == [1_700_000_000 * 10**9]
    timestamp = SimpleNamespace(to_datetime64=lambda: np.datetime64(STAMP, "ns"))
    assert filled.lookup_transform("a", "b", timestamp).stamp_ns == STAMP


@pytest.mark.parametrize("wrong", [np.datetime64("NaT", "ns"), np.datetime64("9999-01-01")])
def test_invalid_time(filled, wrong):
    with pytest.raises(ValueError, match=r"NaT|does not fit"):
        filled.lookup_transform("a", "b", wrong)
    with pytest.raises(ValueError, match=r"NaT|does not fit"):
        filled.lookup_transforms("a", "b", np.array([wrong]))
    for other in (1.5, "now", np.timedelta64(1, "s")):
        with pytest.raises(
            TypeError, match=f"int of nanoseconds or a numpy.datetime64, not {type(other).__name__}"
        ):
            filled.lookup_transform("a", "b", other)
    with pytest.raises(TypeError, match=r"not float; for seconds, write round\(seconds \* 1e9\)$"):
        filled.lookup_transform("a", "b", 1.5)


@pytest.mark.parametrize("scalar", [np.timedelta64(5, "ns"), np.datetime64(5, "ns")])
def test_a_scalar_is_no_array(filled, scalar):
    """NumPy's times offer a buffer without strides; reading it ended the process."""
    points = np.zeros((1, 3))
    with pytest.raises(TypeError, match="stamps must be"):
        filled.transform_points("a", "b", points, np.timedelta64(5, "ns"))
    with pytest.raises((TypeError, ValueError), match="stamps must be"):
        filled.lookup_transforms("a", "b", np.timedelta64(5, "ns"))
    with pytest.raises(TypeError, match="points must be"):
        filled.transform_points("a", "b", scalar, STAMP)
    with pytest.raises(TypeError, match="out must be"):
        filled.transform_points("a", "b", points, STAMP, out=scalar)
