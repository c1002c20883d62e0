from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import tf_transformations
from turtlewire import geometry


def scipy_axes(axes):
    return axes[1:] if axes[0] == "s" else axes[1:].upper()


def same_rotations(p, q):
    return np.abs(np.einsum("...i,...i", p, q)) == pytest.approx(1.0)


@pytest.fixture(scope="module")
def rotations():
    return Rotation.random(500, random_state=3)


def test_matrices_are_scipys(rotations):
    quaternions = rotations.as_quat()
    assert geometry.matrix_from_quaternion(quaternions) == pytest.approx(
        rotations.as_matrix(), abs=1e-14
    )
    assert geometry.matrix_from_quaternion(3.0 * quaternions) == pytest.approx(
        rotations.as_matrix(), abs=1e-14
    )
    found = geometry.quaternion_from_matrix(rotations.as_matrix())
    assert same_rotations(found, quaternions)
    assert (found[:, 3] >= 0).all()


@pytest.mark.parametrize(
    "quaternion",
    [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0.6, 0.8, 0, 0), (0, 1e-9, 1, 1e-9)],
)
def test_half_turns_keep_their_digits(quaternion):
    found = geometry.quaternion_from_matrix(geometry.matrix_from_quaternion(quaternion))
    assert np.abs(found) == pytest.approx(np.abs(quaternion), abs=1e-15)


def test_there_are_24_conventions():
    assert len(set(geometry.AXES)) == 24
    assert {"sxyz", "rzyx", "szxz", "ryxz"} < set(geometry.AXES)


@pytest.mark.parametrize("axes", geometry.AXES)
def test_euler_angles_are_scipys(rotations, axes):
    angles = geometry.euler_from_quaternion(rotations.as_quat(), axes)
    assert angles == pytest.approx(rotations.as_euler(scipy_axes(axes)), abs=1e-12)
    assert same_rotations(geometry.quaternion_from_euler(angles, axes), rotations.as_quat())
    assert same_rotations(
        tf_transformations.quaternion_from_euler(*angles[0], axes), rotations.as_quat()[0]
    )


@pytest.mark.parametrize("axes", geometry.AXES)
@pytest.mark.parametrize("upper", [False, True])
def test_in_gimbal_lock_one_angle_is_zero_and_the_rotation_is_right(axes, upper):
    same = axes[1] == axes[3]
    middle = (math.pi if upper else 0.0) if same else (math.pi / 2 if upper else -math.pi / 2)
    quaternion = geometry.quaternion_from_euler((0.3, middle, 0.5), axes)
    angles = geometry.euler_from_quaternion(quaternion, axes)
    assert angles[2 if axes[0] == "s" else 0] == 0.0
    assert angles[1] == pytest.approx(middle, abs=1e-7)
    assert np.abs(quaternion @ geometry.quaternion_from_euler(angles, axes)) == pytest.approx(
        1.0, abs=1e-12
    )


angles = st.floats(-10, 10)


@given(angles, angles, angles, st.sampled_from(geometry.AXES))
def test_any_angles_come_back_as_the_same_rotation_in_range(first, second, third, axes):
    quaternion = geometry.quaternion_from_euler((first, second, third), axes)
    a, b, c = found = geometry.euler_from_quaternion(quaternion, axes)
    assert np.abs(quaternion @ geometry.quaternion_from_euler(found, axes)) == pytest.approx(
        1.0, abs=1e-12
    )
    assert -math.pi < a <= math.pi
    assert -math.pi < c <= math.pi
    assert (0 <= b <= math.pi) if axes[1] == axes[3] else (-math.pi / 2 <= b <= math.pi / 2)


def test_poses_of_any_shape(rotations):
    poses = np.concatenate(
        (np.arange(1500.0).reshape(500, 3), rotations.as_quat()), axis=1
    ).reshape(5, 20, 5, 7)
    matrices = geometry.matrix_from_pose(poses)
    assert matrices.shape == (5, 20, 5, 4, 4)
    assert matrices[1, 2, 3, 3].tolist() == [0, 0, 0, 1]
    back = geometry.pose_from_matrix(matrices)
    assert back[..., :3].tolist() == poses[..., :3].tolist()
    assert same_rotations(back[..., 3:], poses[..., 3:])
    assert geometry.euler_from_quaternion(poses[..., 3:]).shape == (5, 20, 5, 3)


def test_arguments_stay(rotations):
    for function, value in (
        (geometry.matrix_from_quaternion, rotations.as_quat()),
        (geometry.quaternion_from_matrix, rotations.as_matrix()),
        (geometry.euler_from_quaternion, rotations.as_quat()),
        (geometry.quaternion_from_euler, rotations.as_euler("xyz")),
    ):
        before = value.copy()
        function(value)
        assert (value == before).all()


def test_mistakes_are_reported():
    with pytest.raises(ValueError, match=r"quaternions have the shape \(\.\.\., 4\), got \(3,\)"):
        geometry.matrix_from_quaternion((0, 0, 1))
    with pytest.raises(ValueError, match="of length 0"):
        geometry.matrix_from_quaternion((0, 0, 0, 0))
    with pytest.raises(
        ValueError, match=r"homogeneous matrices have the shape \(\.\.\., 4, 4\), got \(3, 3\)"
    ):
        geometry.pose_from_matrix(np.eye(3))
    with pytest.raises(ValueError, match=r"axes is 'xyz'; it can be one of sxyx, sxyz, "):
        geometry.quaternion_from_euler((0, 0, 0), "xyz")
