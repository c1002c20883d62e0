from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from turtlewire.geometry import arrays


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
