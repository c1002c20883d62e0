"""Trajectories survive files, to the nanosecond; evo reads what we write; wrong files are named."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.trajectory import (
    Trajectory,
    read_csv,
    read_euroc,
    read_kitti,
    read_trajectory,
    read_tum,
    write_csv,
    write_euroc,
    write_kitti,
    write_tum,
)

from .conftest import random_walk

FORMATS = {
    "tum": (read_tum, write_tum),
    "csv": (read_csv, write_csv),
    "euroc": (read_euroc, write_euroc),
}


@pytest.mark.parametrize("name", FORMATS)
def test_nothing_is_lost(tmp_path, name):
    read, write = FORMATS[name]
    walk = random_walk(1)
    write(walk, tmp_path / "walk")
    for found in (read(tmp_path / "walk"), read_trajectory(tmp_path / "walk")):
        assert found.stamps_ns.tolist() == walk.stamps_ns.tolist()
        assert found.poses.tolist() == walk.poses.tolist()


@pytest.mark.parametrize("name", FORMATS)
def test_pauses_in_a_file_are_gaps(tmp_path, name):
    """Files do not tell of gaps: what pauses as long as one is one, and no line crosses it."""
    read, write = FORMATS[name]
    walk = random_walk(1)
    gap = 10**11
    stamps = walk.stamps_ns + np.where(np.arange(len(walk)) < 100, 0, gap)
    write(Trajectory(stamps, walk.poses), tmp_path / "walk")
    found = read(tmp_path / "walk")
    assert found.gaps == ((stamps[99], stamps[100]),)
    assert repr(found).endswith("1 gap>")


def test_words_among_the_numbers_and_numbers_that_are_none(tmp_path):
    path = tmp_path / "walk.tum"
    path.write_text("1 0 0 0 0 0 0 1\nnan 0 0 0 0 0 0 1\n")
    with pytest.raises(ValueError, match=r"walk\.tum, line 2: .*'nan' is not a time"):
        read_trajectory(path)
    path.write_text("1 0 0 0 0 0 0 1\n2 inf 0 0 0 0 0 1\n")
    with pytest.raises(ValueError, match=r"walk\.tum: pose 1 has a number that is not finite"):
        read_trajectory(path)


def test_parts_of_a_trajectory(tmp_path):
    write_kitti(random_walk(1), tmp_path / "poses")
    found = read_kitti(tmp_path / "poses")
    assert not found[:5].timed
    with pytest.raises(TypeError, match=r"pose 3 is poses\[3\]"):
        found[3]


def test_kitti(tmp_path):
    walk = random_walk(1)
    write_kitti(walk, tmp_path / "poses", tmp_path / "times")
    found = read_kitti(tmp_path / "poses", tmp_path / "times")
    assert found.stamps_ns.tolist() == walk.stamps_ns.tolist()
    assert found.as_matrices() == pytest.approx(walk.as_matrices(), abs=1e-12)
    assert read_trajectory(tmp_path / "poses").stamps_ns[:2].tolist() == [0, 10**9]
    (tmp_path / "times").write_text("1.0\n2.0\n")
    with pytest.raises(ValueError, match=r"has 300 poses, .*times has 2 times"):
        read_kitti(tmp_path / "poses", tmp_path / "times")


@given(st.lists(st.integers(-(2**62), 2**62), min_size=1, max_size=20, unique=True))
def test_every_stamp_survives_tum(tmp_path_factory, stamps):
    path = tmp_path_factory.mktemp("tum") / "walk"
    poses = np.tile((0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (len(stamps), 1))
    write_tum(Trajectory(sorted(stamps), poses), path)
    assert read_tum(path).stamps_ns.tolist() == sorted(stamps)


@pytest.mark.parametrize("name", ["tum", "euroc", "kitti"])
def test_evo_reads_it(tmp_path, name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from evo.tools import file_interface

    walk = random_walk(3)
    path = str(tmp_path / "walk.csv")
    if name == "kitti":
        write_kitti(walk, path)
        found = file_interface.read_kitti_poses_file(path)
    else:
        FORMATS[name][1](walk, path)
        read = {
            "tum": file_interface.read_tum_trajectory_file,
            "euroc": file_interface.read_euroc_csv_trajectory,
        }
        found = read[name](path)
        assert found.timestamps == pytest.approx(walk.stamps_ns / 1e9, abs=1e-6)
    assert found.positions_xyz == pytest.approx(walk.positions)
    same = np.abs(np.sum(found.orientations_quat_wxyz[:, [1, 2, 3, 0]] * walk.rotations, axis=1))
    assert same == pytest.approx(1)


def test_comments_headings_exponents_and_a_byte_order_mark(tmp_path):
    path = tmp_path / "walk"
    path.write_text(
        "\ufeff# timestamp tx …\n\n1.5 0 0 0 0 0 0 1\n  # more\n2.5e0 1 0 0 0 0 0 1\n"
        "3 2 0 0 0 0 0 1\n",
        encoding="utf-8",
    )
    found = read_tum(path)
    assert found.stamps_ns.tolist() == [1_500_000_000, 2_500_000_000, 3_000_000_000]
    assert found.positions[:, 0].tolist() == [0, 1, 2]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("1 0 0 0 0 0 0 1\n2 0 0\n", r"walk, line 2: expected 8 numbers.*found 3"),
        ("1 0 0 0 0 0 0 1 9\n", r"walk, line 1: expected 8 numbers.*found 9"),
        ("1 0 0 x 0 0 0 1\n", r"line 1: .*could not convert string to float: 'x'"),
        ("1.x 0 0 0 0 0 0 1\n", r"line 1: .*'1\.x' is not a time"),
        (
            "1 0 0 0 0 0 0 1\n1700000000000000000 0 0 0 0 0 0 1\n",
            r"walk, line 2: .* beyond the year 2262; seconds are expected here: is it in nanosec",
        ),
        ("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "walk: stamps must increase; stamp 1"),
        ("1 0 0 0 0 0 0 0.5\n", "quaternion of pose 0 has the length 0.5"),
        ("1 0 0 0 nan 0 0 1\n", "pose 0 has a number that is not finite"),
    ],
)
def test_wrong_files(tmp_path, text, complaint):
    path = tmp_path / "walk"
    path.write_text(text)
    with pytest.raises(ValueError, match=complaint):
        read_tum(path)


def test_pandas():
    walk = random_walk(1)
    frame = walk.to_pandas()
    assert frame.index.asi8.tolist() == walk.stamps_ns.tolist()
    assert frame[["x", "y", "z", "qx", "qy", "qz", "qw"]].to_numpy().tolist() == walk.poses.tolist()
    assert list(frame.columns[7:]) == ["roll", "pitch", "yaw"]


def test_stamps():
    poses = np.tile((0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (2, 1))
    dates = np.array(["2026-01-01T00:00:00.000000001", "2026-01-02"], dtype="datetime64[ns]")
    assert Trajectory(dates, poses).stamps_ns.tolist() == dates.astype(np.int64).tolist()
    days = np.array(["2026-01-01", "2026-01-02"], dtype="datetime64[D]")
    assert Trajectory(days, poses).duration_ns == 86_400 * 10**9
    with pytest.raises(TypeError, match="integer nanoseconds or datetime64, got float64"):
        Trajectory([1.0, 2.0], poses)
    with pytest.raises(ValueError, match="stamp 1 does not follow stamp 0"):
        Trajectory([2, 2], poses)
    with pytest.raises(ValueError, match=r"expected poses of shape \(3, 7\)"):
        Trajectory([1, 2, 3], poses)


@pytest.mark.parametrize("kind", ["tum", "kitti", "euroc", "csv"])
def test_any_format_is_written_and_recognised(tmp_path, kind):
    from turtlewire.trajectory import read_trajectory, write_trajectory

    walk = random_walk(3)
    path = tmp_path / f"walk.{kind}"
    assert write_trajectory(walk, path) == kind
    back = read_trajectory(path)
    assert back.stamps_ns.tolist() == walk.stamps_ns.tolist()
    assert back.positions == pytest.approx(walk.positions)
    assert write_trajectory(walk, tmp_path / "walk.txt") == "tum"
    with pytest.raises(ValueError, match="unknown format 'xyz'; choose from tum, kitti"):
        write_trajectory(walk, path, "xyz")


@pytest.mark.parametrize("read", [read_tum, read_csv, read_euroc, read_kitti])
def test_a_file_without_data(tmp_path, read):
    (tmp_path / "empty").write_text("# a comment\n\n")
    with pytest.raises(ValueError, match="empty has no data: expected lines of "):
        read(tmp_path / "empty")
