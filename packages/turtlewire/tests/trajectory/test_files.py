"""Trajectories survive files, to the nanosecond; evo reads what we write; wrong files are named."""

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.trajectory import Trajectory

from .conftest import random_walk

FORMATS = ["tum", "csv", "euroc"]


@pytest.mark.parametrize("name", FORMATS)
def test_nothing_is_lost(tmp_path, name):
    walk = random_walk(1)
    path = tmp_path / "walk"
    walk.save(path, format=name)
    for found in (Trajectory.load(path, format=name), Trajectory.load(path)):
        assert found.stamps_ns.tolist() == walk.stamps_ns.tolist()
        assert found.poses.tolist() == walk.poses.tolist()


@pytest.mark.parametrize("name", FORMATS)
def test_pauses_in_a_file_are_gaps(tmp_path, name):
    """Files do not tell of gaps: what pauses as long as one is one, and no line crosses it."""
    walk = random_walk(1)
    gap = 10**11
    stamps = walk.stamps_ns + np.where(np.arange(len(walk)) < 100, 0, gap)
    Trajectory(stamps, walk.poses).save(tmp_path / "walk", format=name)
    found = Trajectory.load(tmp_path / "walk", format=name)
    assert found.gaps == ((stamps[99], stamps[100]),)
    assert repr(found).endswith("1 gap>")


def test_words_among_the_numbers_and_numbers_that_are_none(tmp_path):
    path = tmp_path / "walk.tum"
    path.write_text("1 0 0 0 0 0 0 1\nnan 0 0 0 0 0 0 1\n")
    with pytest.raises(ValueError, match=r"walk\.tum, line 2: .*'nan' is not a time"):
        Trajectory.load(path)
    path.write_text("1 0 0 0 0 0 0 1\n2 inf 0 0 0 0 0 1\n")
    with pytest.raises(ValueError, match=r"walk\.tum: pose 1 has a number that is not finite"):
        Trajectory.load(path)


def test_parts_of_a_trajectory(tmp_path):
    random_walk(1).save(tmp_path / "poses", format="kitti")
    (tmp_path / "poses_times.txt").unlink()
    found = Trajectory.load(tmp_path / "poses")
    assert not found[:5].timed
    with pytest.raises(TypeError, match=r"pose 3 is poses\[3\]"):
        found[3]


def test_kitti(tmp_path):
    walk = random_walk(1)
    walk.save(tmp_path / "poses", format="kitti")
    (tmp_path / "poses_times.txt").rename(tmp_path / "times")
    found = Trajectory.load(tmp_path / "poses", times=tmp_path / "times")
    assert found.stamps_ns.tolist() == walk.stamps_ns.tolist()
    assert found.as_matrices() == pytest.approx(walk.as_matrices(), abs=1e-12)
    assert Trajectory.load(tmp_path / "poses").stamps_ns[:2].tolist() == [0, 10**9]
    (tmp_path / "times").write_text("1.0\n2.0\n")
    with pytest.raises(ValueError, match=r"has 300 poses, .*times has 2 times"):
        Trajectory.load(tmp_path / "poses", times=tmp_path / "times")
    walk.save(tmp_path / "walk.tum")
    with pytest.raises(ValueError, match=r"has the format 'tum', .*; leave out `times`"):
        Trajectory.load(tmp_path / "walk.tum", times=tmp_path / "times")


@given(st.lists(st.integers(-(2**62), 2**62), min_size=1, max_size=20, unique=True))
def test_every_stamp_survives_tum(tmp_path_factory, stamps):
    path = tmp_path_factory.mktemp("tum") / "walk"
    poses = np.tile((0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (len(stamps), 1))
    Trajectory(sorted(stamps), poses).save(path)
    assert Trajectory.load(path).stamps_ns.tolist() == sorted(stamps)


@pytest.mark.parametrize("name", ["tum", "euroc", "kitti"])
def test_evo_reads_it(tmp_path, name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from evo.tools import file_interface

    walk = random_walk(3)
    path = str(tmp_path / "walk.csv")
    if name == "kitti":
        walk.save(path, format="kitti")
        found = file_interface.read_kitti_poses_file(path)
    else:
        walk.save(path, format=name)
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
    found = Trajectory.load(path)
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
        ("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 0\n", "walk: the quaternion of pose 1 has the length 0"),
        ("1 0 0 0 nan 0 0 1\n", "pose 0 has a number that is not finite"),
    ],
)
def test_wrong_files(tmp_path, text, complaint):
    path = tmp_path / "walk"
    path.write_text(text)
    with pytest.raises(ValueError, match=complaint):
        Trajectory.load(path, format="tum")


def test_nanoseconds_that_do_not_fit(tmp_path):
    (tmp_path / "walk.csv").write_text(f"{2**63},0,0,0,0,0,0,1\n")
    with pytest.raises(ValueError, match=r"is beyond the year 2262$"):
        Trajectory.load(tmp_path / "walk.csv")
    (tmp_path / "walk.csv").write_text(f"{2**63 - 1},0,0,0,0,0,0,1\n")
    assert Trajectory.load(tmp_path / "walk.csv").stamps_ns.tolist() == [2**63 - 1]


POSES = ["0 0 0 0 0 0 1", "1 0 0 0 0 0 1", "2 0 0 0 0 0 1"]


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("tum", [f"{stamp} {pose}" for stamp, pose in zip((1, 1, 2), POSES, strict=True)]),
        ("csv", ["1,0,0,0,0,0,0,1", "1,1,0,0,0,0,0,1", "2,2,0,0,0,0,0,1"]),
        ("euroc", ["1,0,0,0,1,0,0,0", "1,1,0,0,1,0,0,0", "2,2,0,0,1,0,0,0"]),
    ],
)
def test_of_repeated_stamps_the_first_pose_is_taken(tmp_path, name, rows):
    path = tmp_path / "walk"
    path.write_text("\n".join(rows))
    text = r"walk: 1 of 3 stamps repeat the previous one; the first pose is used$"
    with pytest.warns(UserWarning, match=text) as remarks:
        found = Trajectory.load(path, format=name)
    assert [each.filename for each in remarks] == [__file__]
    assert found.positions[:, 0].tolist() == [0, 2]
    assert np.diff(found.stamps_ns).tolist() == [10**9 if name == "tum" else 1]


@pytest.mark.parametrize(("length", "remarks"), [(1.0009, 0), (0.9991, 0), (1.0011, 1), (0.5, 1)])
def test_quaternions_of_any_length_are_normalised(tmp_path, length, remarks):
    path = tmp_path / "walk.tum"
    path.write_text(f"1 0 0 0 0 0 {0.6 * length} {0.8 * length}\n2 0 0 0 0 0 0 1\n")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = Trajectory.load(path)
    assert found.rotations == pytest.approx(np.array([[0, 0, 0.6, 0.8], [0, 0, 0, 1]]), abs=1e-15)
    assert [str(each.message) for each in caught] == [
        f"{path}: 1 of 2 quaternions are normalised"
    ] * remarks


def test_rounded_quaternions_are_corrected_in_memory():
    rotations = np.array([[0, 0, 0.6006, 0.8], [0, 0, 0.6, 0.8]])
    poses = np.hstack((np.zeros((2, 3)), rotations))
    found = Trajectory([1, 2], poses)
    assert np.linalg.norm(found.rotations, axis=1) == pytest.approx(1, abs=1e-15)
    assert poses[0, 5] == 0.6006  # the array of the caller stays as it is
    poses[0, 5] = 0.7
    with pytest.raises(ValueError, match=r"the quaternion of pose 0 has the length 1\.06"):
        Trajectory([1, 2], poses)


def test_the_times_of_a_sequence_in_the_same_folder_are_read(tmp_path):
    walk = random_walk(1, 5)
    walk.save(tmp_path / "00.txt", format="kitti")
    (tmp_path / "00_times.txt").rename(tmp_path / "times.txt")
    with pytest.warns(UserWarning, match=r"00\.txt: the times come from times\.txt in the"):
        found = Trajectory.load(tmp_path / "00.txt")
    assert (found.timed, found.stamps_ns.tolist()) == (True, walk.stamps_ns.tolist())
    (tmp_path / "times.txt").write_text("1.0\n")
    with pytest.warns(UserWarning, match=r"^times\.txt is not used: .*5 poses, .* has 1 time"):
        assert not Trajectory.load(tmp_path / "00.txt").timed


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
    with pytest.raises(TypeError, match="datetime64, got float64; for seconds, write"):
        Trajectory([1.0, 2.0], poses)
    with pytest.raises(ValueError, match="stamp 1 does not follow stamp 0"):
        Trajectory([2, 2], poses)
    with pytest.raises(ValueError, match=r"expected poses of shape \(3, 7\)"):
        Trajectory([1, 2, 3], poses)


@pytest.mark.parametrize(
    ("stamps", "error"),
    [
        (np.array([2**63, 2**63 + 1], dtype=np.uint64), OverflowError),
        (np.array(["NaT", "2026-01-01"], dtype="datetime64[ns]"), ValueError),
        (np.array(["3000-01-01", "3200-01-01"], dtype="datetime64[s]"), ValueError),
    ],
)
def test_stamps_that_do_not_fit_do_not_wrap_around(stamps, error):
    with pytest.raises(error, match=r"do(es)? not fit into 64 bits|NaT"):
        Trajectory(stamps, np.zeros((2, 7)))


@pytest.mark.parametrize("kind", ["tum", "kitti", "euroc", "csv"])
def test_any_format_is_written_and_recognised(tmp_path, kind):
    from turtlewire.trajectory.files import write_file

    walk = random_walk(3)
    path = tmp_path / f"walk.{kind}"
    assert write_file(walk.stamps_ns, walk.poses, path) == kind
    back = Trajectory.load(path)
    assert back.stamps_ns.tolist() == walk.stamps_ns.tolist()
    assert back.positions == pytest.approx(walk.positions)
    assert write_file(walk.stamps_ns, walk.poses, tmp_path / "walk.txt") == "tum"
    with pytest.raises(ValueError, match="unknown format 'xyz'; choose from tum, kitti"):
        walk.save(path, format="xyz")
    with pytest.raises(ValueError, match="unknown format 'xyz'; choose from tum, kitti"):
        Trajectory.load(path, format="xyz")


@pytest.mark.parametrize("name", [*FORMATS, "kitti"])
def test_a_file_without_data(tmp_path, name):
    (tmp_path / "empty").write_text("# a comment\n\n")
    with pytest.raises(ValueError, match="empty has no data: expected lines of "):
        Trajectory.load(tmp_path / "empty", format=name)


@pytest.mark.parametrize(
    ("suffix", "line", "advice"),
    [
        (
            ".tum",
            "0,1,2,3,0,0,0,1",
            "separated by commas, .* 'tum', has blanks; .*'csv' or 'euroc'",
        ),
        (".TUM", "0,1,2,3,1,0,0,0,9", "separated by commas"),
        (".kitti", "0,1,2,3,0,0,0,1", "separated by commas, .* 'kitti', has blanks"),
        (".euroc", "0 1 2 3 0 0 0 1", "separated by blanks, .* 'euroc', has commas; .*'tum'"),
        (".kitti", "0 1 2 3 0 0 0 1", "line 1: expected 12 numbers"),
        (".tum", "1 0 0 0 0 1 0 0 0 0 1 0", "line 1: expected 8 numbers"),
    ],
)
def test_a_name_and_numbers_of_different_formats(tmp_path, suffix, line, advice):
    path = tmp_path / f"walk{suffix}"
    path.write_text(line + "\n")
    with pytest.raises(ValueError, match=advice):
        Trajectory.load(path)


def test_euroc_without_a_heading_and_further_columns(tmp_path):
    path = tmp_path / "walk.euroc"
    path.write_text("0,1,2,3,1,0,0,0\n")
    assert Trajectory.load(path).rotations.tolist() == [[0, 0, 0, 1]]
    path.with_suffix(".csv").write_text("0,1,2,3,1,0,0,0\n")
    assert Trajectory.load(path.with_suffix(".csv")).rotations.tolist() == [[1, 0, 0, 0]]


def test_a_given_format_counts_more_than_the_name(tmp_path):
    path = tmp_path / "walk.tum"
    path.write_text("5,1,2,3,0,0,0,1\n")
    assert Trajectory.load(path, format="csv").stamps_ns.tolist() == [5]


@pytest.mark.parametrize(
    ("name", "advice"),
    [
        ("p.png", r"saved as \.tum, \.kitti, \.euroc or \.csv, not \.png; .*plot\(\)\.save"),
        ("p.MCAP", "BagWriter"),
        ("p.npz", r"np\.savez"),
        ("p.json", r"not \.json$"),
    ],
)
def test_a_name_of_another_format_is_refused(tmp_path, name, advice):
    with pytest.raises(ValueError, match=advice):
        random_walk(1).save(tmp_path / name)
    assert not (tmp_path / name).exists()
    random_walk(1).save(tmp_path / name, format="tum")
    assert Trajectory.load(tmp_path / name).stamps_ns.tolist() == random_walk(1).stamps_ns.tolist()


@pytest.mark.parametrize("name", ["walk", "walk.txt", "walk.run1", "walk.TUM"])
def test_other_names_get_tum(tmp_path, name):
    random_walk(1).save(tmp_path / name)
    assert len((tmp_path / name).read_text().split("\n")[0].split(" ")) == 8
