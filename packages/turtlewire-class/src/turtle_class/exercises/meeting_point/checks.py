"""The meeting point is halfway between the turtles, always."""

import math

from turtle_lesson.exercise import Exercise
from turtlesim.testing.faults import Delay

_HALF = (
    "lookup_transform('turtle1', 'turtle2', rclpy.time.Time()) gives the position of turtle2 in "
    "turtle1: the meeting point is at half its x and half its y."
)


def check_parent(exercise: Exercise) -> None:
    """The frame meeting_point is a child of turtle1."""
    exercise.simulation.run(2.0)
    frames = exercise.frames()
    exercise.expect(
        "meeting_point" in frames,
        f"There is no frame meeting_point. The frames are: {', '.join(sorted(frames))}.",
        "Call sendTransform in the timer when the lookup has succeeded. At now() no transform has "
        "arrived yet: look up the latest one, rclpy.time.Time().",
    )
    exercise.expect(
        frames["meeting_point"] == "turtle1",
        f"the parent of meeting_point is {frames['meeting_point']}.",
        "Your result is a position in turtle1's frame: header.frame_id = 'turtle1'.",
    )


def _compare(exercise: Exercise) -> None:
    one, other = exercise.simulation.pose("turtle1"), exercise.simulation.pose("turtle2")
    wanted = ((one.x + other.x) / 2, (one.y + other.y) / 2)
    place = exercise.place("world", "meeting_point")
    seen = exercise.place("turtle2", "turtle1")
    swapped = (seen.x / 2, seen.y / 2)
    hint = _HALF
    if math.dist(place[:2], (other.x, other.y)) < 0.2:
        hint = "That is turtle2 itself: take half of x and of y."
    elif math.dist(exercise.place("turtle1", "meeting_point")[:2], swapped) < 0.2:
        hint = (
            "The target frame comes first. lookup_transform('turtle1', 'turtle2', …) gives "
            "turtle2's position in turtle1."
        )
    exercise.expect(
        math.dist(place[:2], wanted) < 0.2,
        f"The middle is at ({wanted[0]:.1f}, {wanted[1]:.1f}); meeting_point is at "
        f"({place.x:.1f}, {place.y:.1f}).",
        hint,
    )


def check_middle(exercise: Exercise) -> None:
    """It is halfway between the turtles."""
    exercise.simulation.run(2.0)
    _compare(exercise)


def check_moves(exercise: Exercise) -> None:
    """It stays halfway when they drive and turn."""
    for _ in range(6):
        exercise.simulation.drive("turtle1", linear=0.5, angular=0.6)
        exercise.simulation.drive("turtle2", linear=0.4, angular=-0.3)
        exercise.simulation.run(1.0)
        _compare(exercise)


def check_stamp(exercise: Exercise) -> None:
    """It has the stamp of the transform that it is computed from."""
    exercise.simulation.inject(Delay(0.5, "turtle1"))
    exercise.simulation.run(3.0)
    age = exercise.simulation.now - exercise.stamp("turtle1", "meeting_point")
    exercise.expect(
        0.3 < age < 0.8,
        "In this check, turtle1's transforms arrive half a second late. The newest transform of "
        f"meeting_point is computed from them, but its stamp is only {age:.1f} s old.",
        "The meeting point is as old as the transform that it is computed from: copy its "
        "header.stamp.",
    )
