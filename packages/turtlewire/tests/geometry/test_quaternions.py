"""The laws of rotations, and the sign and the last bits that tf2 gives a quaternion.

The laws of rigid motion.
"""

import math
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import tf_transformations
from turtlewire import geometry
from turtlewire.geometry import arrays, poses, quaternions

NUMBERS = st.floats(-1.0, 1.0)
ANGLES = st.floats(-math.pi, math.pi)
VECTORS = st.tuples(*[st.floats(-100.0, 100.0)] * 3)


@st.composite
def any_quaternions(draw):
    q = draw(st.tuples(*[NUMBERS] * 4))
    assume(math.hypot(*q) > 1e-3)
    return q


@st.composite
def rotations(draw):
    q = draw(any_quaternions())
    length = math.hypot(*q)
    return tuple(part / length for part in q)


def near(values):
    return pytest.approx(values, abs=1e-11)


def same_rotation(p, q):
    return abs(sum(a * b for a, b in zip(p, q, strict=True))) == pytest.approx(1.0)


@given(rotations(), rotations(), rotations())
def test_products_are_associative_and_the_conjugate_undoes(p, q, r):
    left = quaternions.multiply(quaternions.multiply(p, q), r)
    assert left == near(quaternions.multiply(p, quaternions.multiply(q, r)))
    assert quaternions.multiply(p, quaternions.conjugate(p)) == near((0.0, 0.0, 0.0, 1.0))


@given(rotations(), rotations(), VECTORS)
def test_a_product_turns_by_its_right_factor_first(p, q, v):
    turned = quaternions.rotate(p, quaternions.rotate(q, v))
    assert quaternions.rotate(quaternions.multiply(p, q), v) == near(turned)
    assert math.hypot(*turned) == pytest.approx(math.hypot(*v), abs=1e-9)


@given(any_quaternions(), VECTORS, st.floats(0.1, 10.0))
def test_the_matrix_turns_as_the_quaternion_of_any_length_does(q, v, scale):
    unit = quaternions.through_matrix(q)
    matrix = np.reshape(quaternions.matrix([scale * part for part in q]), (3, 3))
    assert tuple(matrix @ v) == near(quaternions.rotate(unit, v))
    assert matrix @ matrix.T == near(np.eye(3))
    assert np.linalg.det(matrix) == pytest.approx(1.0)


@given(rotations())
def test_a_matrix_leads_back_to_its_rotation_with_tf2s_sign(q):
    back = quaternions.from_matrix(quaternions.matrix(q))
    assert same_rotation(back, q)
    assert math.hypot(*back) == pytest.approx(1.0)
    assert max(back, key=abs) > 0.0 or back[3] > 0.0


def test_sign_follows_w_or_the_largest_part():
    for axis in range(3):
        for angle, w_is_positive in ((2.0, True), (-2.0, True), (3.0, True), (-3.0, False)):
            q = [0.0, 0.0, 0.0, math.cos(angle / 2)]
            q[axis] = math.sin(angle / 2)
            back = quaternions.through_matrix(q)
            assert (back[3] > 0.0) == w_is_positive
            assert same_rotation(back, q)


@given(ANGLES, ANGLES, ANGLES)
def test_roll_is_applied_first_and_yaw_last(roll, pitch, yaw):
    x, y, z = (
        quaternions.from_rpy(*angles) for angles in ((roll, 0, 0), (0, pitch, 0), (0, 0, yaw))
    )
    assert x == (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
    turned = quaternions.multiply(z, quaternions.multiply(y, x))
    assert quaternions.from_rpy(roll, pitch, yaw) == near(turned)


def test_a_quaternion_without_length_is_not_a_number():
    assert all(map(math.isnan, quaternions.through_matrix((0.0, 0.0, 0.0, 0.0))))
    assert all(map(math.isnan, quaternions.through_matrix((math.nan, 0.0, 0.0, 1.0))))
    assert quaternions.through_matrix((1e200, 0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0, 1.0)
    with pytest.raises(ZeroDivisionError):
        quaternions.matrix((0.0, 0.0, 0.0, 0.0))


@given(rotations(), rotations(), VECTORS)
def test_arrays_give_what_single_rotations_give(p, q, v):
    ps, qs, vs = np.array([p, q]), np.array([q, p]), np.array([v, v])
    assert arrays.multiply(ps, qs)[1].tolist() == near(quaternions.multiply(q, p))
    assert arrays.conjugate(ps)[0].tolist() == near(quaternions.conjugate(p))
    assert arrays.rotate(ps, vs)[1].tolist() == near(quaternions.rotate(q, v))
    assert arrays.matrices(ps)[0].ravel() == near(quaternions.matrix(p))
    back = arrays.from_matrices(arrays.matrices(ps))
    assert np.all(back[:, 3] >= 0.0)
    assert same_rotation(back[0], quaternions.from_matrix(quaternions.matrix(p)))


def test_one_rotation_needs_no_numpy():
    code = (
        "import sys, turtlewire.geometry.quaternions, turtlewire.geometry.poses;"
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


# Many at once, as arrays.


def test_quaternions_agree_with_scipy():
    a, b = (Rotation.random(200, rng=seed) for seed in (1, 2))
    qa, qb = a.as_quat(), b.as_quat()
    product = arrays.multiply(qa, qb)
    assert np.abs(np.sum(product * (a * b).as_quat(), axis=1)) == pytest.approx(1)
    vectors = np.random.default_rng(3).normal(size=(200, 3))
    assert arrays.rotate(qa, vectors) == pytest.approx(a.apply(vectors))
    assert arrays.matrices(qa) == pytest.approx(a.as_matrix())
    assert arrays.angle(qa) == pytest.approx(a.magnitude())
    assert arrays.euler(qa) == pytest.approx(a.as_euler("xyz"))
    back = arrays.from_matrices(a.as_matrix())
    assert np.abs(np.sum(back * qa, axis=1)) == pytest.approx(1)
    assert np.all(back[:, 3] >= 0)


def test_half_turns_about_each_axis():
    for axis in range(3):
        q = np.zeros((1, 4))
        q[0, axis] = 1
        assert np.abs(arrays.from_matrices(arrays.matrices(q))) == pytest.approx(q)


POSITIONS = st.tuples(*[st.floats(-100.0, 100.0)] * 3)


@st.composite
def any_poses(draw):
    angles = draw(st.tuples(ANGLES, ANGLES, ANGLES))
    return (*draw(POSITIONS), *quaternions.from_rpy(*angles))


def near_pose(pose):
    return pytest.approx(pose, abs=1e-9)


@given(any_poses(), any_poses(), any_poses())
def test_poses_are_a_group(a, b, c):
    left = poses.compose(poses.compose(a, b), c)
    assert left == near_pose(poses.compose(a, poses.compose(b, c)))
    assert poses.compose(a, poses.IDENTITY) == near_pose(a)
    assert poses.compose(a, poses.between(a, poses.IDENTITY)) == near_pose(poses.IDENTITY)


@given(any_poses(), any_poses())
def test_between_undoes_compose(a, b):
    assert poses.between(a, poses.compose(a, b)) == near_pose(b)
    assert poses.between(a, a) == near_pose(poses.IDENTITY)


@given(any_poses())
def test_the_canonical_pose_is_the_same_pose_and_stays(pose):
    once = poses.canonical(pose)
    assert once[:3] == pose[:3]
    assert abs(sum(a * b for a, b in zip(once[3:], pose[3:], strict=True))) == pytest.approx(1.0)
    assert poses.canonical(once) == near_pose(once)


@given(any_poses(), any_poses())
def test_interpolation_starts_at_one_pose_and_ends_at_the_other(older, newer):
    assert poses.interpolate(older, newer, 0.0) == near_pose(older)
    end = poses.interpolate(older, newer, 1.0)
    assert end[:3] == near_pose(newer[:3])
    assert abs(sum(a * b for a, b in zip(end[3:], newer[3:], strict=True))) == pytest.approx(1.0)


def scipy_axes(axes):
    return axes[1:] if axes[0] == "s" else axes[1:].upper()


def same_rotations(p, q):
    return np.abs(np.einsum("...i,...i", p, q)) == pytest.approx(1.0)


@pytest.fixture(scope="module")
def random_rotations():
    return Rotation.random(500, random_state=3)


def test_matrices_are_scipys(random_rotations):
    quaternions = random_rotations.as_quat()
    assert geometry.matrix_from_quaternion(quaternions) == pytest.approx(
        random_rotations.as_matrix(), abs=1e-14
    )
    assert geometry.matrix_from_quaternion(3.0 * quaternions) == pytest.approx(
        random_rotations.as_matrix(), abs=1e-14
    )
    found = geometry.quaternion_from_matrix(random_rotations.as_matrix())
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
def test_euler_angles_are_scipys(random_rotations, axes):
    angles = geometry.euler_from_quaternion(random_rotations.as_quat(), axes)
    assert angles == pytest.approx(random_rotations.as_euler(scipy_axes(axes)), abs=1e-12)
    assert same_rotations(geometry.quaternion_from_euler(angles, axes), random_rotations.as_quat())
    assert same_rotations(
        tf_transformations.quaternion_from_euler(*angles[0], axes), random_rotations.as_quat()[0]
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


def test_poses_of_any_shape(random_rotations):
    poses = np.concatenate(
        (np.arange(1500.0).reshape(500, 3), random_rotations.as_quat()), axis=1
    ).reshape(5, 20, 5, 7)
    matrices = geometry.matrix_from_pose(poses)
    assert matrices.shape == (5, 20, 5, 4, 4)
    assert matrices[1, 2, 3, 3].tolist() == [0, 0, 0, 1]
    back = geometry.pose_from_matrix(matrices)
    assert back[..., :3].tolist() == poses[..., :3].tolist()
    assert same_rotations(back[..., 3:], poses[..., 3:])
    assert geometry.euler_from_quaternion(poses[..., 3:]).shape == (5, 20, 5, 3)


def test_arguments_stay(random_rotations):
    for function, value in (
        (geometry.matrix_from_quaternion, random_rotations.as_quat()),
        (geometry.quaternion_from_matrix, random_rotations.as_matrix()),
        (geometry.euler_from_quaternion, random_rotations.as_quat()),
        (geometry.quaternion_from_euler, random_rotations.as_euler("xyz")),
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
