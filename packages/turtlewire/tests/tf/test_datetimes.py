"""Times as datetime64, wherever a stamp is."""

from types import SimpleNamespace

import numpy as np
import pytest

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
