import copy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import tf2_geometry_msgs as tf2
from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    Polygon,
    PolygonInstance,
    PolygonInstanceStamped,
    PolygonStamped,
    Quaternion,
    QuaternionStamped,
    Transform,
    TransformStamped,
    Vector3,
    Vector3Stamped,
)


def xyz(message):
    return message.x, message.y, message.z


def test_a_vector_is_turned_and_not_moved(quarter_turn):
    vector = Vector3Stamped(vector=Vector3(x=1.0, y=2.0, z=3.0))
    assert xyz(tf2.do_transform_vector3(vector, quarter_turn.message).vector) == pytest.approx(
        (-2.0, 1.0, 3.0)
    )


def test_points_and_vectors_as_scipy_has_them(some_world):
    values = (0.3, -4.0, 5.5)
    message = dict(zip("xyz", values, strict=True))
    moved, turned = some_world.point(values), some_world.rotation.apply(values)
    assert xyz(tf2.do_transform_point(Point(**message), some_world.message)) == pytest.approx(
        tuple(moved), abs=1e-12
    )
    assert xyz(tf2.do_transform_point32(Point32(**message), some_world.message)) == pytest.approx(
        tuple(moved), abs=1e-12
    )
    assert xyz(tf2.do_transform_vector3(Vector3(**message), some_world.message)) == pytest.approx(
        tuple(turned), abs=1e-12
    )


def test_a_quaternion_as_scipy_has_it(some_world):
    other = Rotation.random(random_state=99).as_quat()
    message = QuaternionStamped(
        quaternion=Quaternion(**dict(zip("xyzw", map(float, other), strict=True)))
    )
    turned = tf2.do_transform_quaternion_stamped(message, some_world.message).quaternion
    expected = (some_world.rotation * Rotation.from_quat(other)).as_quat()
    expected *= np.sign(expected[3])
    assert (*xyz(turned), turned.w) == pytest.approx(tuple(expected), abs=1e-12)


def test_unstamped_types_stay_what_they_are_and_take_a_bare_transform(quarter_turn):
    bare = quarter_turn.message.transform
    assert type(bare) is Transform
    for function, message in (
        (tf2.do_transform_point, Point()),
        (tf2.do_transform_point32, Point32()),
        (tf2.do_transform_vector3, Vector3()),
        (tf2.do_transform_quaternion, Quaternion()),
        (tf2.do_transform_polygon, Polygon()),
        (tf2.do_transform_polygon_instance, PolygonInstance()),
    ):
        assert type(function(message, bare)) is type(message)
        assert function(message, bare) == function(message, quarter_turn.message)


def test_polygons_go_corner_by_corner(quarter_turn):
    polygon = Polygon(points=[Point32(x=1.0, y=2.0, z=3.0), Point32()])
    expected = Polygon(points=[Point32(x=8.0, y=21.0, z=33.0), Point32(x=10.0, y=20.0, z=30.0)])
    stamped = tf2.do_transform_polygon_stamped(
        PolygonStamped(polygon=polygon), quarter_turn.message
    )
    for corner, hand_made in zip(stamped.polygon.points, expected.points, strict=True):
        assert xyz(corner) == pytest.approx(xyz(hand_made))
    instance = PolygonInstanceStamped(polygon=PolygonInstance(polygon=polygon, id=7))
    moved = tf2.do_transform_polygon_instance_stamped(instance, quarter_turn.message)
    assert moved.polygon.id == 7
    assert moved.polygon.polygon == stamped.polygon
    assert moved.header == quarter_turn.message.header


def test_stamped_data_with_a_bare_transform_says_what_is_missing():
    with pytest.raises(
        TypeError, match=r"needs a geometry_msgs\.msg\.TransformStamped.*got Transform"
    ):
        tf2.do_transform_point(PointStamped(), Transform())


def test_rotations_are_normalised_and_zero_is_none(quarter_turn):
    point = PointStamped(point=Point(x=1.0, y=2.0, z=3.0))
    q = quarter_turn.message.transform.rotation
    q.z, q.w = 30.0, 30.0
    assert xyz(tf2.do_transform_point(point, quarter_turn.message).point) == pytest.approx(
        (8.0, 21.0, 33.0)
    )
    q.z, q.w = 0.0, 0.0
    assert xyz(tf2.do_transform_point(point, quarter_turn.message).point) == pytest.approx(
        (11.0, 22.0, 33.0)
    )


def test_integers_in_fields_are_numbers_too():
    transform = TransformStamped()
    transform.transform.translation.x = 1
    assert tf2.do_transform_point(Point(x=1, y=2, z=3), transform) == Point(x=2.0, y=2.0, z=3.0)


numbers = st.floats(-1e3, 1e3)
rotations = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: sum(x * x for x in q) > 1e-2)


@given(st.tuples(numbers, numbers, numbers), rotations, st.tuples(numbers, numbers, numbers))
def test_there_and_back(make_world, translation, rotation, values):
    world = make_world(translation, rotation)
    back = world.inverse()
    point = PointStamped(point=Point(**dict(zip("xyz", values, strict=True))))
    before = copy.deepcopy(point)
    there = tf2.do_transform_point(point, world.message)
    assert xyz(tf2.do_transform_point(there, back.message).point) == pytest.approx(values, abs=1e-9)
    vector = Vector3(**dict(zip("xyz", values, strict=True)))
    turned = tf2.do_transform_vector3(vector, world.message)
    assert np.linalg.norm(xyz(turned)) == pytest.approx(np.linalg.norm(values), abs=1e-9)
    assert point == before
