"""The laws of rigid motion."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.geometry import poses, quaternions

ANGLES = st.floats(-math.pi, math.pi)
POSITIONS = st.tuples(*[st.floats(-100.0, 100.0)] * 3)


@st.composite
def any_poses(draw):
    angles = draw(st.tuples(ANGLES, ANGLES, ANGLES))
    return (*draw(POSITIONS), *quaternions.from_rpy(*angles))


def near(pose):
    return pytest.approx(pose, abs=1e-9)


@given(any_poses(), any_poses(), any_poses())
def test_poses_are_a_group(a, b, c):
    left = poses.compose(poses.compose(a, b), c)
    assert left == near(poses.compose(a, poses.compose(b, c)))
    assert poses.compose(a, poses.IDENTITY) == near(a)
    assert poses.compose(a, poses.between(a, poses.IDENTITY)) == near(poses.IDENTITY)


@given(any_poses(), any_poses())
def test_between_undoes_compose(a, b):
    assert poses.between(a, poses.compose(a, b)) == near(b)
    assert poses.between(a, a) == near(poses.IDENTITY)


@given(any_poses())
def test_the_canonical_pose_is_the_same_pose_and_stays(pose):
    once = poses.canonical(pose)
    assert once[:3] == pose[:3]
    assert abs(sum(a * b for a, b in zip(once[3:], pose[3:], strict=True))) == pytest.approx(1.0)
    assert poses.canonical(once) == near(once)


@given(any_poses(), any_poses())
def test_interpolation_starts_at_one_pose_and_ends_at_the_other(older, newer):
    assert poses.interpolate(older, newer, 0.0) == near(older)
    end = poses.interpolate(older, newer, 1.0)
    assert end[:3] == near(newer[:3])
    assert abs(sum(a * b for a, b in zip(end[3:], newer[3:], strict=True))) == pytest.approx(1.0)
