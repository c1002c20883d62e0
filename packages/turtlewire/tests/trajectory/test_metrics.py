"""Alignment, APE and RPE agree with evo."""

import functools
import os
import subprocess
import warnings

import numpy as np
import pytest
from tests.bags import write_bag
from tests.places import BIN

from turtlewire import Buffer
from turtlewire.trajectory import Trajectory, compare
from turtlewire.trajectory.alignment import align, associate
from turtlewire.trajectory.metrics import RELATIONS, ape, rpe

from .conftest import START, disturbed, evo_trajectory, random_walk

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from evo.core import metrics as evo_metrics
    from evo.core import sync as evo_sync
    from evo.core.filters import FilterException
    from evo.core.geometry import umeyama_alignment

RELATION_OF_EVO = {
    "trans_part": evo_metrics.PoseRelation.translation_part,
    "rot_part": evo_metrics.PoseRelation.rotation_part,
    "full": evo_metrics.PoseRelation.full_transformation,
    "angle_rad": evo_metrics.PoseRelation.rotation_angle_rad,
    "angle_deg": evo_metrics.PoseRelation.rotation_angle_deg,
    "point_distance": evo_metrics.PoseRelation.point_distance,
    "point_distance_error_ratio": evo_metrics.PoseRelation.point_distance_error_ratio,
}


def test_every_relation_is_compared():
    assert set(RELATION_OF_EVO) == set(RELATIONS)


def grid(seed, count=60):
    """Steps of 0.1 m along x, or none, and turns by 7.3 degrees, so that distances tie."""
    dice = np.random.default_rng(seed)
    poses = np.zeros((count, 7))
    poses[1:, 0] = np.cumsum(0.1 * dice.integers(0, 2, count - 1))
    poses[1:, 1] = np.cumsum(0.1 * dice.integers(0, 2, count - 1))
    half = np.radians(7.3) * np.arange(count) / 2
    poses[:, 5], poses[:, 6] = np.sin(half), np.cos(half)
    return Trajectory(START + np.arange(count) * 10**8, poses)


def flipped(trajectory):
    """Return the same rotations with flipped signs."""
    poses = trajectory.poses.copy()
    poses[::3, 3:] *= -1
    return Trajectory(trajectory.stamps_ns, poses)


PAIRS = {
    "walk": lambda: (random_walk(1, 80), disturbed(random_walk(1, 80), 101)),
    "grid": lambda: (grid(2), disturbed(grid(2), 102)),
    "flips": lambda: (random_walk(3, 80), flipped(disturbed(random_walk(3, 80), 103))),
    "line": lambda: (grid(4), grid(5)),
}


def evo_pair(made, align, count):
    """The pair as evo associates and aligns it."""
    reference, estimate = evo_sync.associate_trajectories(*map(evo_trajectory, made), max_diff=0.01)
    if align == "origin":
        estimate.align_origin(reference)
    elif align != "none":
        estimate.align(reference, correct_scale=align == "sim3", n=count or -1)
    return reference, estimate


@pytest.mark.parametrize("made", PAIRS)
@pytest.mark.parametrize(
    ("align", "count"),
    [("none", None), ("origin", None), ("se3", None), ("se3", 20), ("sim3", None), ("sim3", 20)],
)
def test_ape(made, align, count):
    pair = PAIRS[made]()
    found = compare(*pair, align, poses_to_align=count)
    of_evo = evo_pair(pair, align, count)
    for relation in tuple(RELATIONS)[:-1]:
        metric = evo_metrics.APE(RELATION_OF_EVO[relation])
        metric.process_data(of_evo)
        errors = found.ape(relation)
        assert errors.values == pytest.approx(metric.error, rel=1e-9, abs=1e-9)
        expected = metric.get_all_statistics()
        assert errors.statistics._asdict() == pytest.approx(expected, rel=1e-9, abs=1e-9)


UNITS = {
    "f": evo_metrics.Unit.frames,
    "m": evo_metrics.Unit.meters,
    "d": evo_metrics.Unit.degrees,
    "r": evo_metrics.Unit.radians,
}


@pytest.mark.parametrize("made", PAIRS)
@pytest.mark.parametrize("all_pairs", [False, True])
@pytest.mark.parametrize("pairs_from_reference", [False, True])
@pytest.mark.parametrize(
    ("delta", "unit"),
    [(1, "f"), (7, "f"), (0.3, "m"), (0.8, "m"), (1.0, "m"), (40.0, "d"), (20.0, "d"), (0.5, "r")],
)
def test_rpe(made, delta, unit, all_pairs, pairs_from_reference):
    found = compare(*PAIRS[made](), "sim3")
    of_evo = evo_pair(PAIRS[made](), "sim3", None)
    for relation, relation_of_evo in RELATION_OF_EVO.items():
        metric = evo_metrics.RPE(
            relation_of_evo, delta, UNITS[unit], 0.1, all_pairs, pairs_from_reference
        )
        ours = functools.partial(
            found.rpe,
            relation,
            delta=delta,
            unit=unit,
            all_pairs=all_pairs,
            pairs_from_reference=pairs_from_reference,
        )
        try:
            metric.process_data(of_evo)
        except FilterException:
            with pytest.raises(ValueError, match="no two poses are"):
                ours()
            continue
        errors = ours()
        assert errors.rows.tolist() == metric.delta_ids
        assert errors.values == pytest.approx(np.asarray(metric.error), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(("all_pairs", "ends"), [(False, range(3, 60, 3)), (True, range(3, 60))])
def test_three_turns_by_ten_degrees_make_thirty(all_pairs, ends):
    """A tie that evo leaves to rounding."""
    poses = np.zeros((60, 7))
    half = np.radians(10.0) * np.arange(60) / 2
    poses[:, 5], poses[:, 6] = np.sin(half), np.cos(half)
    turning = Trajectory(np.arange(60), poses)
    errors = rpe(turning, turning, delta=30.0, unit="d", all_pairs=all_pairs, tolerance=0.0)
    assert sorted(set(errors.rows.tolist())) == list(ends)


@pytest.mark.parametrize(
    ("delta", "ends"), [(1.5, [2, 4, 6]), (2.0, [2, 4, 6]), (2.5, [3, 6]), (6.0, [6])]
)
def test_a_pair_ends_where_the_distance_is_reached(delta, ends):
    poses = np.zeros((7, 7))
    poses[:, 0], poses[:, 6] = np.arange(7), 1.0
    walk = Trajectory(np.arange(7), poses)
    assert rpe(walk, walk, delta=delta, unit="m").rows.tolist() == ends


def test_of_equally_many_poses_those_of_the_estimate_look_for_partners():
    still = np.tile([0.0, 0, 0, 0, 0, 0, 1], (3, 1))
    first = Trajectory(np.array([0, 100, 200]), still)
    second = Trajectory(np.array([0, 10, 200]), still)
    assert [rows.tolist() for rows in associate(first, second, 20)] == [[0, 0, 2], [0, 1, 2]]
    assert [rows.tolist() for rows in associate(second, first, 20)] == [[0, 2], [0, 2]]


@pytest.mark.parametrize("with_scale", [False, True])
def test_umeyama(pair, with_scale):
    reference, estimate = pair
    r, t, c = umeyama_alignment(estimate.positions.T, reference.positions.T, with_scale)
    found = align(reference, estimate, "sim3" if with_scale else "se3")
    from turtlewire.geometry import arrays

    assert arrays.matrices(found.rotation) == pytest.approx(r, abs=1e-9)
    assert found.translation == pytest.approx(t, abs=1e-8)
    assert found.scale == pytest.approx(c)


def test_a_reflection_is_no_rotation():
    dice = np.random.default_rng(5)
    points = np.hstack((dice.normal(size=(20, 3)), np.tile((0.0, 0.0, 0.0, 1.0), (20, 1))))
    mirrored = points * (1, 1, -1, 1, 1, 1, 1)
    stamps = np.arange(20)
    found = align(Trajectory(stamps, points), Trajectory(stamps, mirrored), "se3")
    r, _, _ = umeyama_alignment(mirrored[:, :3].T, points[:, :3].T, False)
    from turtlewire.geometry import arrays

    assert arrays.matrices(found.rotation) == pytest.approx(r, abs=1e-9)


@pytest.mark.parametrize("how", ["se3", "sim3", "yaw", "origin"])
def test_an_estimate_that_is_only_moved_has_no_error(how):
    from turtlewire.trajectory.alignment import Alignment

    reference = random_walk(8)
    turn = np.array((0.0, 0.0, np.sin(0.7), np.cos(0.7)))
    moved = Alignment(turn, np.array((3.0, -2.0, 1.0)), 2.0 if how == "sim3" else 1.0)
    comparison = compare(reference, moved.apply(reference), how)
    assert comparison.ape().statistics.max < 1e-9
    assert comparison.ape("angle_rad").statistics.max < 1e-7
    assert comparison.rpe().statistics.max < 1e-9


def test_yaw_leaves_the_tilt_alone(pair):
    reference, estimate = pair
    x, y, _, _ = align(reference, estimate, "yaw").rotation
    assert (x, y) == (0, 0)


def test_no_better_yaw_exists(pair):
    reference, estimate = pair
    best = compare(reference, estimate, "yaw", max_diff_ns=10**9).ape().statistics.sse
    from turtlewire.trajectory.alignment import Alignment

    for small in (0.001, -0.001):
        turn = np.array((0.0, 0.0, np.sin(small), np.cos(small)))
        aligned = compare(reference, estimate, "yaw", max_diff_ns=10**9).estimate
        centre = aligned.positions.mean(axis=0)
        from turtlewire.geometry import arrays

        around = Alignment(turn, centre - arrays.rotate(turn, centre), 1.0)
        assert ape(reference, around.apply(aligned)).statistics.sse > best


def test_a_straight_line_leaves_the_rotation_open():
    line = np.zeros((10, 7))
    line[:, 0] = range(10)
    line[:, 6] = 1
    trajectory = Trajectory(np.arange(10), line)
    with pytest.raises(ValueError, match="Degenerate covariance rank"):
        align(trajectory, trajectory, "se3")


def test_distances_speeds_and_angles_are_evos(pair):
    for trajectory in pair:
        theirs = evo_trajectory(trajectory)
        assert trajectory.distances == pytest.approx(theirs.distances)
        assert trajectory.path_length == pytest.approx(theirs.path_length)
        angles = np.unwrap(theirs.get_orientations_euler("sxyz"), axis=0)
        assert trajectory.euler == pytest.approx(angles, abs=1e-6)
        assert trajectory.speeds == pytest.approx(
            theirs.speeds, rel=1e-4
        )  # their stamps are floats
    none = pair[0][:0]
    assert (none.distances.tolist(), none.path_length, none.duration_ns) == ([], 0.0, 0)
    step = Trajectory([0, 1_500_000_000], [(0, 0, 0, 0, 0, 0, 1), (3, 0, 4, 0, 0, 0, 1)])
    assert repr(step) == "<Trajectory: 2 poses, 1.500 s, 5.000 m>"


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("offset_ns", [0, 20_000_000])
def test_association(swapped, offset_ns):
    dense, sparse = random_walk(1, 1000, period_ns=7_000_000), random_walk(2, 100)
    first, second = (sparse, dense) if swapped else (dense, sparse)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        a, b = evo_sync.associate_trajectories(
            evo_trajectory(first), evo_trajectory(second), max_diff=0.002, offset_2=offset_ns / 1e9
        )
    rows = associate(first, second, 2_000_000, offset_ns)
    assert 10 < len(rows[0]) < 100
    assert first.positions[rows[0]] == pytest.approx(a.positions_xyz)
    assert second.positions[rows[1]] == pytest.approx(b.positions_xyz)


@pytest.mark.parametrize(("distance", "pairs"), [(4, 3), (5, 3), (6, 1)])
def test_the_largest_difference_belongs_to_the_bound(distance, pairs):
    still = np.tile([0.0, 0, 0, 0, 0, 0, 1], (3, 1))
    first = Trajectory(np.array([0, 100, 200]), still)
    second = Trajectory(np.array([0, 100 + distance, 200 - distance]), still)
    for one, other in ((first, second), (second, first)):
        assert len(associate(one, other, 5)[0]) == pairs


@pytest.mark.parametrize(("stamp", "nearest"), [(49, 0), (50, 0), (51, 1), (150, 1), (151, 2)])
def test_of_two_poses_as_near_the_earlier_is_taken(stamp, nearest):
    still = np.tile([0.0, 0, 0, 0, 0, 0, 1], (3, 1))
    many, one = Trajectory(np.array([0, 100, 200]), still), Trajectory(np.array([stamp]), still[:1])
    assert [rows.tolist() for rows in associate(many, one, 50)] == [[nearest], [0]]
    assert [rows.tolist() for rows in associate(one, many, 50)] == [[0], [nearest]]
    assert [rows.tolist() for rows in associate(one, one, 0)] == [[0], [0]]


def test_different_clocks_are_reported():
    early = random_walk(1)
    late = Trajectory(early.stamps_ns + 3600 * 10**9, early.poses)
    with pytest.raises(ValueError, match=r"an offset of -3600\.000 s makes them begin together"):
        compare(early, late)
    assert len(compare(early, late, offset_ns=-3600 * 10**9).estimate) == len(early)
    with pytest.raises(ValueError, match=r"an offset of -3600\.000 s makes them begin together"):
        compare(early, late, offset_ns=50 * 10**9)  # what was tried does not change the advice
    for one, other, covered in (
        (early, early[:0], r"17\d+\.129 to 17\d+\.076 s, the estimate nothing$"),
        (early[:0], early, r"nothing, the estimate 17\d+\.129 to 17\d+\.076 s$"),
    ):
        with pytest.raises(ValueError, match=f"the reference covers {covered}"):
            compare(one, other)
    with pytest.raises(ValueError, match="a trajectory without poses cannot be compared"):
        compare(early[:0], early[:0])
    with pytest.raises(ValueError, match="max_diff_ns is -1; it must not be negative"):
        compare(early, late, max_diff_ns=-1)


def test_the_table_is_evos(pair):
    lines = compare(*pair, "se3", max_diff_ns=10**9).table().splitlines()
    assert lines[0] == "APE trans_part (m), aligned: se3"
    assert [line.split("\t")[0].strip() for line in lines[2:]] == [
        "max",
        "mean",
        "median",
        "min",
        "rmse",
        "sse",
        "std",
    ]


def test_wrong_words(pair):
    with pytest.raises(ValueError, match="unknown relation 'tranz'; choose from trans_part"):
        ape(*pair, "tranz")
    with pytest.raises(ValueError, match="unknown unit 'x'"):
        rpe(*pair, unit="x")
    with pytest.raises(
        ValueError, match="no two poses are 100000 m apart; the trajectory has 300 poses"
    ):
        rpe(*pair, delta=100_000, unit="m")
    for delta in (0, -1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match=f"delta is {delta}; it must be a positive number"):
            rpe(*pair, delta=delta)
    with pytest.raises(ValueError, match=r"delta is 0\.5 frames; it must be a whole number"):
        rpe(*pair, delta=0.5)
    with pytest.raises(ValueError, match="unknown alignment 'SE3'"):
        compare(*pair, "SE3")
    for count in (0, -1):
        with pytest.raises(ValueError, match=f"poses_to_align is {count}; it must be positive"):
            compare(*pair, "se3", poses_to_align=count)
    for offset in (2**63 - 1, -(2**63), 10**19):  # added to stamps, the first would wrap around
        with pytest.raises(ValueError, match=f"offset_ns is {offset}; it moves"):
            compare(*pair, offset_ns=offset)
    with pytest.raises(ValueError, match="300 and 10 poses; associate them first"):
        ape(pair[0], pair[1][:10])


def test_a_path_is_not_a_trajectory():
    with pytest.raises(TypeError, match=r"got str; read a file with Trajectory\.load"):
        compare(random_walk(1), "walk.tum")


def test_trajectories_without_times_are_paired_by_their_number(tmp_path):
    from .conftest import random_walk

    walk = random_walk(1, 50)
    for name, part in (("a", walk), ("b", walk[:40])):
        part.save(tmp_path / f"{name}.txt", format="kitti")
        (tmp_path / f"{name}_times.txt").unlink()
    untimed = Trajectory.load(tmp_path / "a.txt")
    assert compare(untimed, untimed).ape().statistics.max == 0
    for other in (Trajectory.load(tmp_path / "b.txt"), walk[:40]):
        with pytest.raises(ValueError, match=r"without times.* these have 50 and 40"):
            compare(untimed, other)
    for which, pair in (("reference", (untimed, walk)), ("estimate", (walk, untimed))):
        text = f"the {which} has no times: its poses are paired"
        with pytest.warns(UserWarning, match=text) as remarks:
            found = compare(*pair, offset_ns=10**12)
        assert [each.filename for each in remarks] == [__file__]
        assert found.ape().statistics.max < 1e-12
        assert found.reference.stamps_ns.tolist() == walk.stamps_ns.tolist()


def test_uncomputable_values_are_reported():
    standing = Trajectory([1, 2], [[0, 0, 0, 0, 0, 0, 1]] * 2)
    with pytest.raises(ValueError, match="the reference does not move"):
        rpe(standing, standing, "point_distance_error_ratio")
    with pytest.raises(ValueError, match="no two poses are 3 m apart; the trajectory has 2 poses"):
        rpe(standing, standing, delta=3, unit="m")


# evo, unmodified, reads the transforms of a bag through our `tf2_py`.


EVO = BIN / "evo_traj"


def test_evo_samples_our_buffer(tmp_path):
    bag = write_bag(tmp_path / "made", count=500)
    (path,) = bag.glob("*.mcap")
    done = subprocess.run(
        [EVO, "mcap", path, "/tf:odom.camera", "--save_as_tum"],
        cwd=tmp_path,
        env={**os.environ, "HOME": str(tmp_path), "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
        timeout=840,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "50 poses" in done.stdout
    (saved,) = tmp_path.glob("*.tum")
    of_evo = Trajectory.load(saved)
    ours = Buffer.from_bag(bag).trajectory("odom", "camera", stamps=of_evo.stamps_ns)
    assert len(ours) == len(of_evo) == 50
    assert ours.poses == pytest.approx(of_evo.poses, abs=1e-6)
