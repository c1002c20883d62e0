"""Every public function against transforms3d, SciPy, or the law that defines it."""

import inspect
import itertools
import math

import numpy as np
import pytest
import transforms3d as t3d
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from tests.programs import run_python

import tf_transformations as tft

ANGLE = st.floats(-math.pi, math.pi)
NUMBER = st.floats(-10.0, 10.0)
VECTOR = st.tuples(NUMBER, NUMBER, NUMBER)
DIRECTION = VECTOR.filter(lambda v: math.hypot(*v) > 0.1)
QUATERNION = st.tuples(NUMBER, NUMBER, NUMBER, NUMBER).filter(lambda q: math.hypot(*q) > 0.1)
ALL_AXES = [
    f"{frame}{''.join(letters)}"
    for frame in "sr"
    for letters in itertools.product("xyz", repeat=3)
    if letters[0] != letters[1] != letters[2]
]


def xyzw(wxyz):
    return [*wxyz[1:], wxyz[0]]


def wxyz(xyzw):
    return [xyzw[3], *xyzw[:3]]


def test_every_public_name_exists_and_has_a_docstring():
    assert len(tft.__all__) == 45
    for name in tft.__all__:
        value = getattr(tft, name)
        assert not callable(value) or value.__doc__, name
    assert set(tft.__all__) <= set(dir(tft))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = tft.nothing


#: The functions as ROS has had them since its first transformations module; 1.1.1 has added none.
SIGNATURES = """
arcball_constrain_to_axis(point, axis)
arcball_map_to_sphere(point, center, radius)
arcball_nearest_axis(point, axes)
clip_matrix(left, right, bottom, top, near, far, perspective=False)
compose_matrix(scale=None, shear=None, angles=None, translate=None, perspective=None)
concatenate_matrices(*matrices)
decompose_matrix(matrix)
euler_from_matrix(matrix, axes='sxyz')
euler_from_quaternion(quaternion, axes='sxyz')
euler_matrix(ai, aj, ak, axes='sxyz')
identity_matrix()
inverse_matrix(matrix)
is_same_transform(matrix0, matrix1)
orthogonalization_matrix(lengths, angles)
projection_from_matrix(matrix, pseudo=False)
projection_matrix(point, normal, direction=None, perspective=None, pseudo=False)
quaternion_about_axis(angle, axis)
quaternion_conjugate(quaternion)
quaternion_from_euler(ai, aj, ak, axes='sxyz')
quaternion_from_matrix(matrix)
quaternion_inverse(quaternion)
quaternion_matrix(quaternion)
quaternion_multiply(quaternion1, quaternion0)
quaternion_slerp(quat0, quat1, fraction, spin=0, shortestpath=True)
random_quaternion(rand=None)
random_rotation_matrix(rand=None)
random_vector(size)
reflection_from_matrix(matrix)
reflection_matrix(point, normal)
rotation_from_matrix(matrix)
rotation_matrix(angle, direction, point=None)
scale_from_matrix(matrix)
scale_matrix(factor, origin=None, direction=None)
shear_from_matrix(matrix)
shear_matrix(angle, direction, point, normal)
superimposition_matrix(v0, v1, scaling=False, usesvd=True)
translation_from_matrix(matrix)
translation_matrix(direction)
unit_vector(data, axis=None, out=None)
vector_norm(data, axis=None, out=None)
"""


def test_arguments_and_defaults():
    functions = [name for name in tft.__all__ if callable(getattr(tft, name)) and name != "Arcball"]
    bare = inspect.Parameter.empty
    found = []
    for name in functions:
        signature = inspect.signature(getattr(tft, name))
        parameters = [
            parameter.replace(annotation=bare) for parameter in signature.parameters.values()
        ]
        found.append(f"{name}{signature.replace(parameters=parameters, return_annotation=bare)}")
    assert found == SIGNATURES.split("\n")[1:-1]


def test_an_identity_has_no_negative_zeros():
    assert str(tft.quaternion_from_matrix(np.identity(4))) == "(0.0, 0.0, 0.0, 1.0)"


def test_the_broadcaster_s_function_needs_no_numpy():
    code = (
        "import sys, tf_transformations as t; t.quaternion_from_euler(0, 0, 1.0); print('numpy' "
        "in sys.modules)"
    )
    assert run_python(code).stdout == "False\n"


def test_there_are_24_conventions():
    assert len(ALL_AXES) == 24


@pytest.mark.parametrize("axes", ALL_AXES)
@given(ai=ANGLE, aj=ANGLE, ak=ANGLE)
def test_euler_conventions(axes, ai, aj, ak):
    quaternion = tft.quaternion_from_euler(ai, aj, ak, axes)
    assert np.allclose(quaternion, xyzw(t3d.euler.euler2quat(ai, aj, ak, axes)), atol=1e-12)
    assert np.allclose(
        tft.euler_matrix(ai, aj, ak, axes)[:3, :3],
        t3d.euler.euler2mat(ai, aj, ak, axes),
        atol=1e-12,
    )
    scipy_axes = axes[1:] if axes[0] == "s" else axes[1:].upper()
    assert np.allclose(
        tft.quaternion_matrix(quaternion)[:3, :3],
        Rotation.from_euler(scipy_axes, [ai, aj, ak]).as_matrix(),
        atol=1e-9,
    )
    numbers = t3d.euler._AXES2TUPLE[axes]
    assert tft.quaternion_from_euler(ai, aj, ak, numbers) == quaternion
    for angles in (
        tft.euler_from_quaternion(quaternion, axes),
        tft.euler_from_quaternion(quaternion, numbers),
    ):
        assert np.allclose(
            tft.euler_matrix(*angles, axes), tft.euler_matrix(ai, aj, ak, axes), atol=1e-6
        )


@pytest.mark.parametrize("axes", ALL_AXES)
@given(ai=ANGLE, aj=st.floats(0.1, 1.4), ak=ANGLE, negative=st.booleans())
def test_euler_angles_away_from_gimbal_lock(axes, ai, aj, ak, negative):
    matrix = tft.euler_matrix(ai, -aj if negative else aj, ak, axes)
    assert np.allclose(
        tft.euler_from_matrix(matrix, axes), t3d.euler.mat2euler(matrix[:3, :3], axes), atol=1e-9
    )


@pytest.mark.parametrize("axes", ALL_AXES)
def test_euler_angles_in_gimbal_lock(axes):
    for second in (0.0, math.pi / 2, -math.pi / 2, math.pi):
        matrix = tft.euler_matrix(0.3, second, 0.5, axes)
        assert np.allclose(
            tft.euler_from_matrix(matrix[:3, :3], axes),
            t3d.euler.mat2euler(matrix[:3, :3], axes),
            atol=1e-6,
        )


@pytest.mark.parametrize(
    "axes",
    ["", "xyz", "sxxy", "sxyy", "qxyz", "sabc", "sxyzx", (0, 0, 0), (3, 0, 0, 0), (0, 2, 0, 0)],
)
def test_unknown_conventions_are_refused(axes):
    with pytest.raises(KeyError, match="unknown axes"):
        tft.quaternion_from_euler(0.0, 0.0, 0.0, axes)


def test_the_axes_by_name_are_roll_pitch_yaw():
    assert np.allclose(
        tft.quaternion_from_euler(0, 0, math.pi / 2), [0, 0, math.sqrt(0.5), math.sqrt(0.5)]
    )
    assert np.allclose(
        tft.quaternion_matrix(tft.quaternion_from_euler(0, 0, math.pi / 2)) @ [1, 0, 0, 1],
        [0, 1, 0, 1],
    )


@given(first=QUATERNION, second=QUATERNION)
def test_quaternion_products(first, second):
    assert np.allclose(
        tft.quaternion_multiply(first, second),
        xyzw(t3d.quaternions.qmult(wxyz(first), wxyz(second))),
    )
    assert np.allclose(
        tft.quaternion_conjugate(first), xyzw(t3d.quaternions.qconjugate(wxyz(first)))
    )
    assert np.allclose(
        tft.quaternion_multiply(first, tft.quaternion_inverse(first)), [0, 0, 0, 1], atol=1e-9
    )


@given(quaternion=QUATERNION)
def test_quaternions_and_matrices(quaternion):
    matrix = tft.quaternion_matrix(quaternion)
    assert np.allclose(matrix[:3, :3], t3d.quaternions.quat2mat(wxyz(quaternion)))
    back = tft.quaternion_from_matrix(matrix)
    assert back[3] >= 0.0
    assert math.isclose(abs(np.dot(back, quaternion)), math.hypot(*quaternion), rel_tol=1e-9)


def test_a_zero_quaternion_is_no_rotation():
    assert np.array_equal(tft.quaternion_matrix([0, 0, 0, 0]), np.identity(4))


@given(angle=st.floats(0.01, 3.1), axis=DIRECTION, point=VECTOR)
def test_rotations_about_an_axis(angle, axis, point):
    matrix = tft.rotation_matrix(angle, axis, point)
    assert np.allclose(matrix, t3d.axangles.axangle2aff(axis, angle, point))
    assert np.allclose(
        tft.rotation_matrix(angle, axis)[:3, :3], t3d.axangles.axangle2mat(axis, angle)
    )
    assert np.allclose(
        tft.quaternion_matrix(tft.quaternion_about_axis(angle, axis))[:3, :3], matrix[:3, :3]
    )
    found_angle, found_axis, found_point = tft.rotation_from_matrix(matrix)
    assert np.allclose(tft.rotation_matrix(found_angle, found_axis, found_point), matrix, atol=1e-4)


@given(
    factor=st.floats(-3.0, 3.0).filter(lambda f: abs(f - 1.0) > 0.1 and abs(f) > 0.1),
    origin=VECTOR,
    direction=DIRECTION,
)
def test_scales(factor, origin, direction):
    for arguments in (
        (factor,),
        (factor, origin),
        (factor, origin, direction),
        (factor, None, direction),
    ):
        matrix = tft.scale_matrix(*arguments)
        expected = t3d.zooms.zfdir2aff(
            factor,
            arguments[2] if len(arguments) > 2 else None,
            arguments[1] if len(arguments) > 1 else None,
        )
        assert np.allclose(matrix, expected)
        found_factor, found_origin, found_direction = tft.scale_from_matrix(matrix)
        assert np.allclose(
            tft.scale_matrix(found_factor, found_origin, found_direction), matrix, atol=1e-6
        )


@given(point=VECTOR, normal=DIRECTION)
def test_reflections(point, normal):
    matrix = tft.reflection_matrix(point, normal)
    assert np.allclose(matrix, t3d.reflections.rfnorm2aff(normal, point))
    assert np.allclose(matrix @ matrix, np.identity(4), atol=1e-9)
    assert np.allclose(
        tft.reflection_matrix(*tft.reflection_from_matrix(matrix)), matrix, atol=1e-6
    )


@given(angle=st.floats(0.1, 1.2), direction=DIRECTION, other=DIRECTION, point=VECTOR)
def test_shears(angle, direction, other, point):
    normal = np.cross(direction, other)
    if np.linalg.norm(normal) < 0.5:
        return
    matrix = tft.shear_matrix(angle, direction, point, normal)
    assert np.allclose(matrix, t3d.shears.sadn2aff(angle, direction, normal, point))
    assert np.allclose(tft.shear_matrix(*tft.shear_from_matrix(matrix)), matrix, atol=1e-5)


def test_undecomposable_matrix_is_rejected():
    with pytest.raises(ValueError, match="eigenvalue -1"):
        tft.reflection_from_matrix(np.identity(4))
    with pytest.raises(ValueError, match="Determinant"):
        tft.reflection_from_matrix(np.diag([-1.0, 2.0, 3.0, 1.0]))
    with pytest.raises(ValueError, match="eigenvalue 1"):
        tft.rotation_from_matrix(np.diag([2.0, 3.0, 4.0, 1.0]))
    with pytest.raises(ValueError, match="eigenvalue 1"):
        tft.scale_from_matrix(np.diag([2.0, 2.0, 2.0, 2.0]))
    with pytest.raises(ValueError, match="not orthogonal"):
        tft.shear_matrix(0.3, [1, 0, 0], [0, 0, 0], [1, 1, 0])
    with pytest.raises(ValueError, match="does not shear"):
        tft.shear_from_matrix(np.identity(4))


@given(point=VECTOR, normal=DIRECTION, direction=DIRECTION, goal=VECTOR)
def test_projections_land_on_the_plane(point, normal, direction, goal):
    unit = np.array(normal) / np.linalg.norm(normal)
    if abs(unit @ direction) < 0.2:
        return
    eye = np.array(point) + 20.0 * np.array(direction)
    if abs((eye - goal) @ unit) < 0.2:
        return
    for arguments in ({}, {"direction": direction}, {"perspective": eye}):
        matrix = tft.projection_matrix(point, normal, **arguments)
        image = matrix @ [*goal, 1.0]
        assert abs((image[:3] / image[3] - point) @ unit) < 1e-6
        if "perspective" in arguments:
            assert np.linalg.norm(
                np.cross(image[:3] / image[3] - eye, np.array(goal) - eye)
            ) < 1e-4 * np.linalg.norm(image[:3] / image[3] - eye) * np.linalg.norm(
                np.array(goal) - eye
            )
        else:
            assert (
                np.linalg.norm(np.cross(image[:3] - goal, arguments.get("direction", unit))) < 1e-6
            )


@pytest.mark.parametrize(
    "arguments",
    [
        {},
        {"direction": [1.0, -2.0, 0.5]},
        {"perspective": [3.0, 4.0, 5.0]},
        {"perspective": [3.0, 4.0, 5.0], "pseudo": True},
    ],
)
def test_projections_are_found_again(arguments):
    matrix = tft.projection_matrix([1.0, 2.0, 3.0], [0.5, -1.0, 0.2], **arguments)
    again = tft.projection_matrix(
        *tft.projection_from_matrix(matrix, arguments.get("pseudo", False))
    )
    assert tft.is_same_transform(matrix, again)


def test_a_pseudo_projection_keeps_the_order_of_depths():
    matrix = tft.projection_matrix([0, 0, 0], [0, 0, 1], perspective=[0, 0, 10], pseudo=True)
    depths = [
        (matrix @ [0.0, 0.0, z, 1.0])[2] / (matrix @ [0.0, 0.0, z, 1.0])[3]
        for z in (-3.0, -1.0, 0.0, 2.0)
    ]
    assert depths == sorted(depths, reverse=True)


def test_clip_takes_the_volume_to_the_cube():
    box = tft.clip_matrix(-1.0, 3.0, 2.0, 5.0, 0.5, 9.0)
    assert np.allclose(box @ [-1.0, 2.0, 0.5, 1.0], [-1, -1, -1, 1])
    assert np.allclose(box @ [3.0, 5.0, 9.0, 1.0], [1, 1, 1, 1])
    frustum = tft.clip_matrix(-1.0, 3.0, 2.0, 5.0, 0.5, 9.0, perspective=True)
    for corner, expected in (
        ([-1.0, 2.0, 0.5], [-1, -1, -1]),
        ([3.0, 5.0, 0.5], [1, 1, -1]),
        ([54.0, 90.0, 9.0], [1, 1, 1]),
    ):
        image = frustum @ [*corner, 1.0]
        assert np.allclose(image[:3] / image[3], expected)


@pytest.mark.parametrize("bounds", [(1, 1, 0, 1, 0.1, 1), (0, 1, 1, 0, 0.1, 1), (0, 1, 0, 1, 2, 1)])
def test_clip_refuses_bounds_out_of_order(bounds):
    with pytest.raises(ValueError, match="invalid frustrum"):
        tft.clip_matrix(*bounds)
    with pytest.raises(ValueError, match="near <= 0"):
        tft.clip_matrix(0, 1, 0, 1, 0.0, 1, perspective=True)


SCALE = st.tuples(*[st.floats(0.2, 3.0)] * 3)


@given(
    scale=SCALE,
    shear=VECTOR,
    angles=st.tuples(ANGLE, st.floats(-1.4, 1.4), ANGLE),
    translate=VECTOR,
    mirrored=st.booleans(),
)
def test_decompose_undoes_compose(scale, shear, angles, translate, mirrored):
    scale = tuple(-s for s in scale) if mirrored else scale
    parts = tft.decompose_matrix(tft.compose_matrix(scale, shear, angles, translate))
    for found, given_part in zip(
        parts, (scale, shear, angles, translate, (0.0, 0.0, 0.0, 1.0)), strict=True
    ):
        assert np.allclose(found, given_part, atol=1e-6)
    seen = tft.compose_matrix(scale, shear, angles, translate, (0.01, 0.02, -0.01, 1.0))
    assert tft.is_same_transform(tft.compose_matrix(*tft.decompose_matrix(seen)), seen)
    linear = tft.compose_matrix(scale, shear, angles)
    expected = t3d.affines.compose(
        [0, 0, 0], t3d.euler.euler2mat(*angles), [1, 1, 1]
    ) @ _scaled_shear(shear, scale)
    assert np.allclose(linear, expected)


def _scaled_shear(shear, scale):
    matrix = np.identity(4)
    matrix[0, 1], matrix[0, 2], matrix[1, 2] = shear
    return matrix @ np.diag([*scale, 1.0])


@given(scale=SCALE, shear=VECTOR, angles=st.tuples(ANGLE, ANGLE, ANGLE), mirrored=st.booleans())
def test_the_quaternion_of_a_matrix_leaves_scale_and_shear_aside(scale, shear, angles, mirrored):
    matrix = tft.compose_matrix((-scale[0], *scale[1:]) if mirrored else scale, shear, angles)
    expected = t3d.quaternions.quat2mat(t3d.quaternions.mat2quat(t3d.affines.decompose(matrix)[1]))
    assert np.allclose(
        tft.quaternion_matrix(tft.quaternion_from_matrix(matrix))[:3, :3], expected, atol=1e-4
    )


def test_singular_matrices_are_refused():
    singular = np.diag([1.0, 0.0, 1.0, 1.0])
    for function in (tft.decompose_matrix, tft.quaternion_from_matrix):
        with pytest.raises(ValueError, match="Matrix is singular"):
            function(singular)
    with pytest.raises(ValueError, match="is zero"):
        tft.decompose_matrix(np.diag([1.0, 1.0, 1.0, 0.0]))


def test_cells():
    assert np.allclose(
        tft.orthogonalization_matrix([10.0, 10.0, 10.0], [90.0, 90.0, 90.0])[:3, :3],
        np.identity(3) * 10,
    )
    lengths, angles = [9.8, 12.0, 15.5], [87.2, 80.7, 69.7]
    a, b, c = tft.orthogonalization_matrix(lengths, angles)[:3, :3].T
    assert np.allclose([np.linalg.norm(side) for side in (a, b, c)], lengths)
    between = [
        math.degrees(math.acos(u @ v / np.linalg.norm(u) / np.linalg.norm(v)))
        for u, v in ((b, c), (a, c), (a, b))
    ]
    assert np.allclose(between, angles)


@pytest.mark.parametrize("usesvd", [True, False])
@given(
    quaternion=QUATERNION,
    translation=VECTOR,
    factor=st.floats(0.5, 2.0),
    seed=st.integers(0, 2**32 - 1),
)
def test_superimposition_finds_the_motion(usesvd, quaternion, translation, factor, seed):
    points = np.random.default_rng(seed).normal(size=(3, 20))
    motion = tft.concatenate_matrices(
        tft.translation_matrix(translation), tft.quaternion_matrix(quaternion)
    )
    assert np.allclose(
        tft.superimposition_matrix(points, motion[:3, :3] @ points + motion[:3, 3:], usesvd=usesvd),
        motion,
        atol=1e-6,
    )
    scaled = motion @ tft.scale_matrix(factor)
    moved = scaled @ np.vstack([points, np.ones(20)])
    assert np.allclose(
        tft.superimposition_matrix(points, moved, scaling=True, usesvd=usesvd), scaled, atol=1e-6
    )


def test_superimposition_refuses_shapes():
    with pytest.raises(ValueError, match="wrong shape"):
        tft.superimposition_matrix(np.zeros((3, 4)), np.zeros((3, 5)))


@given(first=QUATERNION, second=QUATERNION, fraction=st.floats(0.0, 1.0))
def test_slerp_is_the_rotation_on_the_way(first, second, fraction):
    one, other = Rotation.from_quat(first), Rotation.from_quat(second)
    step = (other * one.inv()).as_rotvec()
    if np.linalg.norm(step) > 3.1:
        return
    between = tft.quaternion_slerp(first, second, fraction)
    assert np.linalg.norm(between) == pytest.approx(1.0)
    found = Rotation.from_quat(between)
    assert (found * (Rotation.from_rotvec(fraction * step) * one).inv()).magnitude() < 1e-6


def test_slerp_ends_and_spins():
    first, second = tft.random_quaternion(), tft.random_quaternion()
    assert np.allclose(tft.quaternion_slerp(first, second, 0), first)
    assert np.allclose(tft.quaternion_slerp(first, second, 1, 1), second)
    assert np.allclose(
        tft.quaternion_slerp([1, 0, 0, 0], [0, 1, 0, 0], 0.5),
        [math.sqrt(0.5), math.sqrt(0.5), 0, 0],
    )
    assert np.allclose(tft.quaternion_slerp(first, -first, 0.5), first)
    spun = tft.quaternion_slerp([1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], 0.5, spin=1)
    assert np.allclose(spun, [-math.sqrt(0.5), -math.sqrt(0.5), 0, 0])


def test_random_things():
    assert np.allclose(np.linalg.norm([tft.random_quaternion() for _ in range(50)], axis=1), 1.0)
    assert np.allclose(tft.random_quaternion([0.0, 0.25, 0.0]), [1.0, 0.0, 0.0, 0.0])
    rotation = tft.random_rotation_matrix()
    assert np.allclose(rotation.T @ rotation, np.identity(4))
    assert np.array_equal(
        tft.random_rotation_matrix([0.1, 0.2, 0.3]),
        tft.quaternion_matrix(tft.random_quaternion([0.1, 0.2, 0.3])),
    )
    vector = tft.random_vector(1000)
    assert vector.shape == (1000,)
    assert 0.0 <= vector.min() < vector.max() < 1.0


def test_vectors():
    data = np.arange(24.0).reshape(2, 3, 4) + 1.0
    for axis in (None, 0, 1, 2):
        assert np.allclose(tft.vector_norm(data, axis=axis), np.sqrt((data * data).sum(axis=axis)))
        assert np.allclose(
            tft.unit_vector(data, axis=axis),
            data
            / np.linalg.norm(
                data.reshape(-1) if axis is None else data, axis=axis, keepdims=axis is not None
            ),
        )
    out = np.zeros((2, 4))
    assert tft.vector_norm(data, axis=1, out=out) is None
    assert np.allclose(out, np.sqrt((data * data).sum(axis=1)))
    out = np.zeros(data.shape)
    assert tft.unit_vector(data, axis=1, out=out) is None
    assert np.allclose(out, tft.unit_vector(data, axis=1))


@given(translation=VECTOR, quaternion=QUATERNION)
def test_matrices(translation, quaternion):
    moved = tft.translation_matrix(translation)
    assert np.array_equal(tft.translation_from_matrix(moved), translation)
    turned = tft.quaternion_matrix(quaternion)
    product = tft.concatenate_matrices(moved, turned)
    assert np.allclose(product, moved @ turned)
    assert tft.is_same_transform(
        tft.concatenate_matrices(product, tft.inverse_matrix(product)), tft.identity_matrix()
    )
    assert tft.is_same_transform(product, 3.0 * product)
    assert not tft.is_same_transform(
        product, tft.concatenate_matrices(tft.translation_matrix([1, 0, 0]), product)
    )
    assert np.array_equal(tft.concatenate_matrices(), np.identity(4))


def test_arcball_turns_what_is_dragged():
    ball = tft.Arcball()
    ball.place([320, 320], 320)
    ball.down([500, 250])
    assert np.allclose(ball.matrix(), np.identity(4))
    ball.drag([475, 275])
    assert ball.matrix()[0, 1] == pytest.approx(0.0, abs=0.2)
    start, end = (
        tft.arcball_map_to_sphere([500, 250], [320, 320], 320),
        tft.arcball_map_to_sphere([475, 275], [320, 320], 320),
    )
    once = Rotation.from_matrix(ball.matrix()[:3, :3])
    assert once.magnitude() == pytest.approx(2.0 * math.acos(start @ end))
    before = ball.matrix()
    ball.next()
    assert np.allclose(ball.matrix(), before @ before)
    ball.down([100, 100])
    ball.drag([100, 100])
    assert np.allclose(ball.matrix(), before @ before)


def test_arcball_keeps_to_an_axis():
    ball = tft.Arcball(tft.quaternion_about_axis(0.3, [0, 0, 1]))
    ball.place([0, 0], 1)
    ball.setaxes([1, 1, 0], [-1, 1, 0])
    ball.setconstrain(True)
    assert ball.getconstrain()
    ball.down([0.3, -0.2])
    ball.drag([-0.4, 0.1])
    turn = ball.matrix()[:3, :3] @ tft.rotation_matrix(-0.3, [0, 0, 1])[:3, :3]
    _, axis, _ = tft.rotation_from_matrix(
        tft.quaternion_matrix(
            tft.quaternion_from_matrix(
                np.block([[turn, np.zeros((3, 1))], [np.zeros((1, 3)), 1.0]])
            )
        )
    )
    assert any(
        abs(abs(axis @ unit) - 1.0) < 1e-6
        for unit in (np.array([1, 1, 0]) / math.sqrt(2), np.array([-1, 1, 0]) / math.sqrt(2))
    )
    ball.setaxes(None)
    free = tft.Arcball(ball.matrix())
    free.place([0, 0], 1)
    for each in (ball, free):
        each.down([0.3, -0.2])
        each.drag([-0.4, 0.1])
    assert np.allclose(ball.matrix(), free.matrix())
    with pytest.raises(ValueError, match="not a quaternion or matrix"):
        tft.Arcball([1.0, 2.0])


def test_arcball_helpers():
    assert np.allclose(tft.arcball_map_to_sphere([10, 0], [0, 0], 1), [1, 0, 0])
    assert np.allclose(tft.arcball_map_to_sphere([0, 0], [0, 0], 1), [0, 0, 1])
    assert np.allclose(tft.arcball_map_to_sphere([7, 3], [1, 6], 10), [0.6, 0.3, math.sqrt(0.55)])
    assert np.allclose(tft.arcball_constrain_to_axis([0, 0, 1], [0, 0, 1]), [1, 0, 0])
    assert np.allclose(tft.arcball_constrain_to_axis([0, 1, 0], [0, 1, 0]), [-1, 0, 0])
    assert np.allclose(tft.arcball_constrain_to_axis([0.6, 0, -0.8], [0, 1, 0]), [-0.6, 0, 0.8])
    assert tft.arcball_nearest_axis([0, 0, 1], []) is None
    assert tft.arcball_nearest_axis([1, 0, 0], [[1, 0, 0], [0, 1, 0]]) == [0, 1, 0]
