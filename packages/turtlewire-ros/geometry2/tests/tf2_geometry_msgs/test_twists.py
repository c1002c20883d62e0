import copy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import tf2_geometry_msgs as tf2
from geometry_msgs.msg import (
    Twist,
    TwistWithCovariance,
    Vector3,
    VelocityStamped,
    Wrench,
)

SEED = 11


def vector(x, y, z):
    return Vector3(x=float(x), y=float(y), z=float(z))


def xyz(message):
    return np.array((message.x, message.y, message.z))


def six(first, second):
    return np.concatenate((xyz(first), xyz(second)))


def test_a_turning_body_moves_what_is_far_from_its_centre(make_world):
    """The body turns about its z axis with 2 rad/s.

    The camera is 3 m ahead of the centre, so it moves to the left with 6 m/s.
    """
    camera_from_body = make_world((-3.0, 0.0, 0.0))
    twist = tf2.do_transform_twist(Twist(angular=vector(0, 0, 2)), camera_from_body.message)
    assert twist == Twist(linear=vector(0, 6, 0), angular=vector(0, 0, 2))


def test_a_weight_at_the_tool_pulls_at_the_sensor(make_world):
    """The tool is 0.2 m ahead (x) of the sensor.

    10 N down at the tool are a torque of 2 Nm about the sensor's y axis.
    """
    sensor_from_tool = make_world((0.2, 0.0, 0.0))
    wrench = tf2.do_transform_wrench(Wrench(force=vector(0, 0, -10)), sensor_from_tool.message)
    assert wrench == Wrench(force=vector(0, 0, -10), torque=vector(0, 2, 0))


def test_turned_axes_by_hand(quarter_turn):
    twist = tf2.do_transform_twist(
        Twist(linear=vector(1, 2, 3), angular=vector(1, 0, 0)), quarter_turn.message
    )
    # w' = (0, 1, 0); v' = (-2, 1, 3) + (10, 20, 30) x (0, 1, 0) = (-2, 1, 3) + (-30, 0, 10)
    assert six(twist.linear, twist.angular) == pytest.approx([-32, 1, 13, 0, 1, 0])
    wrench = tf2.do_transform_wrench(
        Wrench(torque=vector(1, 2, 3), force=vector(1, 0, 0)), quarter_turn.message
    )
    assert six(wrench.torque, wrench.force) == pytest.approx([-32, 1, 13, 0, 1, 0])


values = st.floats(-100, 100)
vectors = st.builds(vector, values, values, values)


@given(vectors, vectors, vectors, vectors, vectors, st.integers(0, 10_000))
def test_power_is_the_same_in_every_frame(
    make_world, linear, angular, force, torque, translation, seed
):
    world = make_world(xyz(translation), Rotation.random(random_state=seed).as_quat())
    twist, wrench = Twist(linear=linear, angular=angular), Wrench(force=force, torque=torque)
    before = copy.deepcopy((twist, wrench))
    new_twist, new_wrench = (
        tf2.do_transform_twist(twist, world.message),
        tf2.do_transform_wrench(wrench, world.message),
    )
    power = xyz(force) @ xyz(linear) + xyz(torque) @ xyz(angular)
    new_power = xyz(new_wrench.force) @ xyz(new_twist.linear) + xyz(new_wrench.torque) @ xyz(
        new_twist.angular
    )
    assert new_power == pytest.approx(power, rel=1e-9, abs=1e-6)
    assert (twist, wrench) == before


@given(vectors, vectors, vectors, st.integers(0, 10_000))
def test_there_and_back(make_world, first, second, translation, seed):
    world = make_world(xyz(translation), Rotation.random(random_state=seed).as_quat())
    back = world.inverse().message
    twist = tf2.do_transform_twist(
        tf2.do_transform_twist(Twist(linear=first, angular=second), world.message), back
    )
    assert six(twist.linear, twist.angular) == pytest.approx(six(first, second), abs=1e-8)
    wrench = tf2.do_transform_wrench(
        tf2.do_transform_wrench(Wrench(force=first, torque=second), world.message), back
    )
    assert six(wrench.force, wrench.torque) == pytest.approx(six(first, second), abs=1e-8)


def test_the_velocity_of_a_point_is_its_derivative(some_world):
    """A body with this twist is moved for a microsecond.

    Where the target's origin, as a point of it, goes, is its linear velocity.
    """
    linear, angular, dt = np.array((1.0, -2.0, 0.5)), np.array((0.3, 0.9, -0.4)), 1e-6
    target_origin = some_world.inverse().translation  # in source
    moved = Rotation.from_rotvec(angular * dt).apply(target_origin) + linear * dt
    derivative = some_world.rotation.apply((moved - target_origin) / dt)
    twist = tf2.do_transform_twist(
        Twist(linear=vector(*linear), angular=vector(*angular)), some_world.message
    )
    assert xyz(twist.linear) == pytest.approx(derivative, abs=1e-4)
    assert xyz(twist.angular) == pytest.approx(some_world.rotation.apply(angular))


def test_a_twists_covariance_is_that_of_many_twists(some_world):
    root = np.random.default_rng(SEED).normal(size=(6, 6))
    covariance = root @ root.T
    samples = np.random.default_rng(SEED).multivariate_normal(np.zeros(6), covariance, size=20_000)
    moved = []
    for sample in samples:
        twist = tf2.do_transform_twist(
            Twist(linear=vector(*sample[:3]), angular=vector(*sample[3:])), some_world.message
        )
        moved.append(six(twist.linear, twist.angular))
    sampled = np.cov(np.array(moved).T)
    expected = tf2.transform_twist_covariance(covariance.ravel(), some_world.message).reshape(6, 6)
    # Six standard errors of a sampled covariance, sqrt((c_ii c_jj + c_ij^2) / n).
    allowed = 6 * np.sqrt(
        (np.outer(np.diag(expected), np.diag(expected)) + expected**2) / len(samples)
    )
    assert (np.abs(sampled - expected) <= allowed).all()
    without_distance = tf2.transform_covariance(covariance.ravel(), some_world.message).reshape(
        6, 6
    )
    assert (
        np.abs(sampled - without_distance) > allowed
    ).any()  # the tolerance would notice that the distance was forgotten


def test_a_velocity_moves_like_a_twist_and_stays_whose_it_is(quarter_turn):
    twist = Twist(linear=vector(1, 2, 3), angular=vector(4, 5, 6))
    velocity = VelocityStamped(body_frame_id="body", reference_frame_id="world", velocity=twist)
    moved = tf2.do_transform_velocity_stamped(velocity, quarter_turn.message)
    assert (moved.body_frame_id, moved.reference_frame_id) == ("body", "world")
    assert moved.velocity == tf2.do_transform_twist(twist, quarter_turn.message)
    with_covariance = tf2.do_transform_twist_with_covariance(
        TwistWithCovariance(twist=twist), quarter_turn.message
    )
    assert with_covariance.twist == moved.velocity
