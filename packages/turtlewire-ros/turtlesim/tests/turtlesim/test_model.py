"""The model against tables worked out by hand from turtlesim's constants, and its laws."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlesim.model import (
    COMMAND_LIFETIME_NS,
    DEFAULT_PEN,
    FIELD_SIZE,
    TICK_NS,
    Pen,
    RotationState,
    World,
    normalize_angle,
)

MIDDLE = 5.544444561004639
speeds = st.floats(-50.0, 50.0)
angles = st.floats(-1e6, 1e6)


@pytest.fixture
def world():
    return World()


@pytest.fixture
def turtle(world):
    return world.spawn_centred()


def run(world: World, ticks: int, first: int = 0) -> list:
    return [world.step((first + tick) * TICK_NS) for tick in range(ticks)]


def test_the_field_has_the_original_size(turtle):
    assert FIELD_SIZE == 11.088889122009277
    assert (turtle.name, turtle.x, turtle.theta) == ("turtle1", MIDDLE, 0.0)
    assert FIELD_SIZE - turtle.y_down == MIDDLE


@pytest.mark.parametrize(
    ("forward", "turning", "seconds", "x", "theta"),
    [
        (2.0, 0.0, 0.16, MIDDLE + 10 * 2.0 * 0.016, 0.0),
        (
            2.0,
            0.0,
            5.0,
            MIDDLE + 63 * 2.0 * 0.016,
            0.0,
        ),  # 63 ticks: the last one at an age of 0.992 s
        (-1.0, 0.0, 5.0, MIDDLE - 63 * 1.0 * 0.016, 0.0),
        (0.0, 1.0, 5.0, MIDDLE, 63 * 0.016),
        (0.0, -2.0, 0.32, MIDDLE, -20 * 0.032),
        (100.0, 0.0, 0.16, FIELD_SIZE, 0.0),
        (-100.0, 0.0, 0.16, 0.0, 0.0),
    ],
)
def test_one_command_by_hand(world, turtle, forward, turning, seconds, x, theta):
    turtle.drive(forward, 0.0, turning)
    run(world, round(seconds / 0.016))
    assert turtle.x == pytest.approx(x, abs=1e-12)
    assert turtle.theta == pytest.approx(theta, abs=1e-12)


def test_a_command_is_renewed_by_the_next_one(world, turtle):
    turtle.drive(0.0, 0.0, 1.0)
    run(world, 40)
    turtle.drive(0.0, 0.0, 1.0)
    run(world, 200, first=40)
    assert turtle.theta == pytest.approx((40 + 63) * 0.016)


def test_a_wall_keeps_the_published_velocity(world, turtle):
    turtle.drive(1000.0, 0.0, 0.0)
    (tick,) = world.step(0)
    assert tick.pose.x == FIELD_SIZE
    assert tick.pose.linear_velocity == 1000.0
    assert tick.clamped_from == (pytest.approx(MIDDLE + 16.0), pytest.approx(MIDDLE))
    assert run(world, 3, first=1)[-1][0].clamped_from == (
        pytest.approx(FIELD_SIZE + 16.0),
        pytest.approx(MIDDLE),
    )


def test_lateral_speed_goes_to_the_left_and_counts_in_the_magnitude(world, turtle):
    turtle.drive(3.0, 4.0, 0.0)
    (tick,) = world.step(0)
    assert tick.pose.y == pytest.approx(MIDDLE + 4.0 * 0.016)
    assert tick.pose.linear_velocity == 5.0


def test_teleports_are_applied_in_order_at_the_next_tick(world, turtle):
    turtle.teleport_absolute(1.0, 2.0, math.pi / 2)
    turtle.teleport_relative(3.0, -math.pi / 2)
    assert turtle.x == MIDDLE
    (tick,) = world.step(0)
    assert (tick.pose.x, tick.pose.y, tick.pose.theta) == pytest.approx((4.0, 2.0, 0.0))
    assert [(round(s.x1), round(s.y1)) for s in tick.teleport_strokes] == [(45, 409), (180, 409)]
    assert tick.move_stroke is None


def test_the_pen_is_put_down_only_on_purpose(world, turtle):
    assert turtle.pen == DEFAULT_PEN == (179, 184, 255, 3)
    turtle.set_pen(Pen(1, 2, 3, 9), off=True)
    assert turtle.pen == DEFAULT_PEN
    turtle.drive(1.0, 0.0, 0.0)
    turtle.teleport_relative(1.0, 0.0)
    (tick,) = world.step(0)
    assert tick.move_stroke is None
    assert tick.teleport_strokes == []
    turtle.set_pen(Pen(1, 2, 3, 0), off=False)
    (tick,) = world.step(TICK_NS)
    assert tick.move_stroke.pen == (1, 2, 3, 1)


def test_names_are_given_in_order_and_start_again_after_reset():
    world = World()
    assert world.spawn_centred().name == "turtle1"
    assert world.spawn(1.0, 1.0, 0.0, "turtle2").name == "turtle2"
    assert world.spawn(1.0, 1.0, 0.0).name == "turtle3"
    assert world.spawn(1.0, 1.0, 0.0, "turtle3") is None
    assert world.kill("turtle1").name == "turtle1"
    assert world.kill("turtle1") is None
    assert world.spawn(1.0, 1.0, 0.0).name == "turtle4"
    world.reset()
    assert world.turtles == {}
    assert world.spawn_centred().name == "turtle1"


def test_turtles_move_in_the_order_of_their_names():
    world = World()
    for name in ("b", "turtle10", "turtle2", "A"):
        world.spawn(1.0, 1.0, 0.0, name)
    assert [tick.turtle.name for tick in world.step(0)] == ["A", "b", "turtle10", "turtle2"]


class TestRotation:
    def test_turns_the_short_way_at_one_radian_per_second_and_succeeds(self, world, turtle):
        rotation, aborted = turtle.rotate_to(-1.0)
        assert aborted is None
        ticks = [tick for (tick,) in run(world, 100)]
        assert ticks[0].rotation is rotation
        assert ticks[0].pose.angular_velocity == -1.0
        assert rotation.state is RotationState.SUCCEEDED
        assert turtle.theta == pytest.approx(-1.0, abs=0.02)
        assert rotation.delta == pytest.approx(-turtle.theta, abs=1e-6)
        assert turtle.rotation is None
        assert turtle.turning == 0.0

    def test_a_command_aborts_it(self, world, turtle):
        rotation, _ = turtle.rotate_to(3.0)
        run(world, 10)
        assert turtle.drive(1.0, 0.0, 0.0) is rotation
        assert rotation.state is RotationState.ABORTED
        assert turtle.drive(1.0, 0.0, 0.0) is None
        run(world, 5, first=10)
        assert turtle.theta == pytest.approx(10 * 0.016)

    def test_a_new_one_aborts_the_old_one(self, turtle):
        first, _ = turtle.rotate_to(3.0)
        second, aborted = turtle.rotate_to(1.0)
        assert aborted is first
        assert first.state is RotationState.ABORTED
        assert second.state is RotationState.ACTIVE

    def test_canceling_stops_the_turtle_at_the_next_tick(self, world, turtle):
        rotation, _ = turtle.rotate_to(3.0)
        run(world, 10)
        rotation.cancel_requested = True
        (tick,) = world.step(10 * TICK_NS)
        assert tick.rotation is rotation
        assert rotation.state is RotationState.CANCELED
        assert tick.pose.angular_velocity == 0.0
        assert turtle.theta == pytest.approx(10 * 0.016)

    def test_outlives_the_lifetime_of_commands(self, world, turtle):
        turtle.rotate_to(3.0)
        run(world, 200)
        assert turtle.theta == pytest.approx(3.0, abs=0.02)


@given(angles)
def test_normalized_angles_are_the_same_angle_in_range(angle):
    normal = normalize_angle(angle)
    assert -math.pi - 1e-6 <= normal <= math.pi + 1e-6
    turns = (angle - normal) / (2 * 3.14159265)
    assert turns == pytest.approx(round(turns), abs=1e-6)


@given(
    st.lists(st.tuples(speeds, speeds, speeds), max_size=8),
    angles,
    st.floats(-20, 30),
    st.floats(-20, 30),
)
def test_no_turtle_ever_leaves_the_field(commands, theta, x, y):
    world = World()
    turtle = world.spawn(x, y, theta)
    now = 0
    for forward, lateral, turning in [(0.0, 0.0, 0.0), *commands]:
        turtle.drive(forward, lateral, turning)
        for _ in range(5):
            (tick,) = world.step(now)
            now += TICK_NS
            assert 0.0 <= tick.pose.x <= FIELD_SIZE
            assert 0.0 <= tick.pose.y <= FIELD_SIZE
            assert all(0 <= index <= 499 for index in tick.sensor_pixel)
            assert tick.pose.linear_velocity == pytest.approx(math.hypot(forward, lateral))
            assert tick.pose.angular_velocity == turning


@given(speeds, speeds)
def test_the_same_commands_give_the_same_bits(forward, turning):
    def poses():
        world = World()
        world.spawn_centred().drive(forward, 0.0, turning)
        return [tick.pose for (tick,) in run(world, 70)]

    assert poses() == poses()


@given(st.floats(0.1, 3.0), st.floats(-3.0, 3.0))
def test_strokes_join_where_the_turtle_went(forward, turning):
    world = World()
    world.spawn_centred().drive(forward, 0.0, turning)
    strokes = [tick.move_stroke for (tick,) in run(world, 63)]
    assert all(a[2:4] == b[:2] for a, b in itertools.pairwise(strokes))


def test_a_command_holds_for_exactly_its_lifetime(turtle):
    turtle.drive(1.0, 0.0, 0.0)
    turtle.age_command(0)
    turtle.age_command(COMMAND_LIFETIME_NS)
    assert turtle.forward == 1.0
    turtle.age_command(COMMAND_LIFETIME_NS + 1)
    assert turtle.forward == 0.0
