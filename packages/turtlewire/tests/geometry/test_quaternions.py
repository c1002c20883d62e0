"""The laws of rotations, and the sign and the last bits that tf2 gives a quaternion."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from turtlewire.geometry import arrays, quaternions

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
