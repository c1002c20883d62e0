"""Trajectories out of a buffer: the right times, and no pose where there are no data."""

import numpy as np
import pytest

import turtlewire
from turtlewire.errors import LookupException
from turtlewire.trajectory.sampling import sample_trajectory
from turtlewire.trajectory.stamps import find_gaps

MS = 1_000_000
SECOND = 1000 * MS
NO_TURN = (0.0, 0.0, 0.0, 1.0)


def filled(gap=()):
    """map ← odom at 10 Hz, odom ← base at 50 Hz, base ← camera fixed."""
    buffer = turtlewire.Buffer(None)
    for i in range(1, 51):
        buffer.set_transform("map", "odom", i * 100 * MS, (0.1 * i, 0.0, 0.0), NO_TURN)
    for i in range(1, 251):
        if i not in gap:
            buffer.set_transform("odom", "base", i * 20 * MS, (0.0, 0.02 * i, 0.0), NO_TURN)
    buffer.set_static_transform("base", "camera", (0.0, 0.0, 1.0), NO_TURN)
    return buffer


def test_the_stamps_of_all_moving_links():
    found = sample_trajectory(filled(), "map", "camera")
    assert found.stamps_ns.tolist() == [i * 20 * MS for i in range(5, 251)]
    expected = found.stamps_ns[:, None] / 1e9 * (1.0, 1.0, 0.0) + (0.0, 0.0, 1.0)
    assert found.positions == pytest.approx(expected)
    assert (found.target_frame, found.source_frame, found.gaps) == ("map", "camera", ())


def test_only_links_on_the_way_count():
    assert len(sample_trajectory(filled(), "map", "odom")) == 50
    assert len(sample_trajectory(filled(), "camera", "odom")) == 250


def test_a_rate_and_given_stamps():
    buffer = filled()
    assert sample_trajectory(buffer, "map", "base", rate_hz=4).stamps_ns.tolist() == [
        100 * MS + i * 250 * MS for i in range(20)
    ]
    times = np.array([1, SECOND, 2 * SECOND, 99 * SECOND])  # the first and the last have no data
    for stamps in (times, times.astype("datetime64[ns]")):
        found = sample_trajectory(buffer, "map", "base", stamps=stamps)
        assert found.positions == pytest.approx(np.array([[1.0, 1, 0], [2, 2, 0]]))


def test_gaps_are_never_bridged():
    found = sample_trajectory(filled(gap=range(100, 200)), "map", "base")
    assert found.gaps == ((99 * 20 * MS, 200 * 20 * MS),)
    inside = (found.stamps_ns > 99 * 20 * MS) & (found.stamps_ns < 200 * 20 * MS)
    assert not inside.any()
    assert len(found) == 146
    dense = sample_trajectory(filled(gap=range(100, 200)), "map", "base", rate_hz=100)
    assert not ((dense.stamps_ns > 99 * 20 * MS) & (dense.stamps_ns < 200 * 20 * MS)).any()
    bridged = sample_trajectory(
        filled(gap=range(100, 200)), "map", "base", rate_hz=100, max_gap_ns=10 * SECOND
    )
    assert len(bridged) == 491
    assert bridged.gaps == ()


def test_mistakes_raise_clear_errors():
    with pytest.raises(LookupException, match="no_frame"):
        sample_trajectory(filled(), "map", "no_frame")
    with pytest.raises(
        ValueError, match="nothing moves between 'base' and 'camera', so no transform"
    ):
        sample_trajectory(filled(), "base", "camera")
    assert len(sample_trajectory(filled(), "base", "camera", stamps=[5])) == 1
    with pytest.raises(turtlewire.errors.ExtrapolationException):
        sample_trajectory(filled(), "map", "base", stamps=[99 * SECOND])
    for rate in (0, -1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match=f"rate is {rate} Hz; it must be positive and finite"):
            sample_trajectory(filled(), "map", "base", rate_hz=rate)
    with pytest.raises(ValueError, match=r"1e\+12 Hz makes more than 20,000,000 poses of 4.\d+ s"):
        sample_trajectory(filled(), "map", "base", rate_hz=1e12)
    with pytest.raises(ValueError, match="either `stamps` or `rate_hz`, not both"):
        filled().trajectory("map", "base", stamps=[SECOND], rate_hz=10)


def test_only_a_pause_longer_than_the_limit_is_a_gap():
    stamps = np.array([0, 100, 200, 301])
    assert find_gaps(stamps, 100) == [(200, 301)]
    assert find_gaps(stamps, 101) == []
    regular = np.arange(5) * 10 * MS
    assert find_gaps(np.append(regular, regular[-1] + 500 * MS)) == []
    assert find_gaps(np.append(regular, regular[-1] + 500 * MS + 1)) == [(40 * MS, 540 * MS + 1)]
