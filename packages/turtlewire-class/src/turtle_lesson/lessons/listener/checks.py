"""Turtle2 stays one metre behind turtle1."""

import math

from turtle_lesson.exercise import Exercise

_GAP = 1.0
_LATEST = (
    "Look up the latest transform, rclpy.time.Time(). At now() nothing has arrived yet, as tf2 "
    "says in the log."
)
_TOO_NEAR = (
    "Drive by the distance that is too much: subtract 1.0 from the distance before it is "
    "multiplied with the speed factor, and do not drive backwards: max(0.0, distance - 1.0)."
)


def check_sets_off(exercise: Exercise) -> None:
    """Turtle2 sets off."""
    simulation = exercise.simulation
    start = simulation.pose("turtle2")
    simulation.run(5.0)
    pose = simulation.pose("turtle2")
    moved = math.dist((pose.x, pose.y), (start.x, start.y))
    still = abs(pose.theta - start.theta) < 0.01
    exercise.expect(moved > 0.2 or not still, "turtle2 does not move.", _LATEST)


def check_right_way(exercise: Exercise) -> None:
    """Turtle2 comes closer."""
    simulation = exercise.simulation
    start = simulation.distance("turtle1", "turtle2")
    simulation.run(8.0)
    left = simulation.distance("turtle1", "turtle2")
    exercise.expect(
        left < 0.6 * start,
        f"turtle2 was {start:.2f} m away at first, and is {left:.2f} m away after 8 s.",
        "lookup_transform(target, source) says where source is as target sees it. To steer, "
        "turtle2 needs turtle1 in its own frame: target is turtle2, source is turtle1; and the "
        "angle to it is atan2(y, x).",
    )


def check_distance(exercise: Exercise) -> None:
    """Turtle2 stops one metre away from a stationary turtle1."""
    simulation = exercise.simulation
    simulation.run(25.0)
    gap = simulation.distance("turtle1", "turtle2")
    hint = _TOO_NEAR if gap < _GAP else "It stops too early: the distance to keep is 1.0 m."
    exercise.expect(abs(gap - _GAP) < 0.15, f"turtle2 stops {gap:.2f} m from turtle1.", hint)


def check_keeps_up(exercise: Exercise) -> None:
    """Turtle2 keeps up with a moving turtle1, and never comes too close."""
    simulation = exercise.simulation
    simulation.run(15.0)
    nearest, farthest = math.inf, 0.0
    for _ in range(15):
        simulation.drive("turtle1", linear=0.8, angular=0.4)
        simulation.run(1.0)
        gap = simulation.distance("turtle1", "turtle2")
        nearest, farthest = min(nearest, gap), max(farthest, gap)
    exercise.expect(nearest > 0.7, f"turtle2 came as near as {nearest:.2f} m.", _TOO_NEAR)
    exercise.expect(
        farthest < 3.5,
        f"turtle2 fell back to {farthest:.2f} m.",
        "Its speed must grow with the distance: keep a factor of about 0.5 per second.",
    )
