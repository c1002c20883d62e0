"""The carrot is one metre behind turtle1, and turtle2 goes there."""

import math

from turtle_lesson.exercise import Exercise


def check_parent(exercise: Exercise) -> None:
    """The frame carrot1 is a child of turtle1."""
    exercise.simulation.run(1.0)
    frames = exercise.frames()
    exercise.expect(
        "carrot1" in frames,
        f"There is no frame carrot1. The frames are: {', '.join(sorted(frames))}.",
        "Keep child_frame_id = 'carrot1', and send the transform in the timer's callback.",
    )
    exercise.expect(
        frames["carrot1"] == "turtle1",
        f"the parent of carrot1 is {frames['carrot1']}.",
        "A frame that moves with turtle1 has turtle1 as its parent: header.frame_id = 'turtle1'.",
    )


def check_place(exercise: Exercise) -> None:
    """The carrot is one metre behind turtle1."""
    exercise.simulation.run(1.0)
    place = exercise.place("turtle1", "carrot1")
    hint = "Behind is the negative x direction of turtle1: x = -1.0, y = 0.0."
    if abs(place.x - 1.0) < 0.1 and abs(place.y) < 0.1:
        hint = "That is in front of turtle1: x points ahead, so behind is x = -1.0."
    elif abs(place.x) < 0.1 and abs(abs(place.y) - 1.0) < 0.1:
        hint = "That is at its side: y points to the left. Behind is along x: x = -1.0."
    exercise.expect(
        math.dist(place[:2], (-1.0, 0.0)) < 0.05,
        f"turtle1 sees the carrot {place.x:.2f} m ahead and {place.y:.2f} m to the left.",
        hint,
    )


def check_moves_along(exercise: Exercise) -> None:
    """The carrot stays there while turtle1 drives and turns."""
    simulation = exercise.simulation
    for _ in range(5):
        simulation.drive("turtle1", linear=1.0, angular=1.0)
        simulation.run(1.0)
        place = exercise.place("turtle1", "carrot1")
        exercise.expect(
            math.dist(place[:2], (-1.0, 0.0)) < 0.05,
            f"turtle1 sees the carrot {place.x:.2f} m ahead and {place.y:.2f} m to the left.",
            "The numbers are those in turtle1's frame, and they do not change: TF moves it along.",
        )


def check_turtle2(exercise: Exercise) -> None:
    """Turtle2 comes to the carrot."""
    exercise.simulation.run(20.0)
    left = math.hypot(*exercise.place("turtle2", "carrot1")[:2])
    exercise.expect(
        left < 0.3,
        f"After 20 s turtle2 is {left:.2f} m from the carrot.",
        "Look at tf2_echo and the log: the listener needs carrot1 in the tree, with fresh stamps "
        "(self.get_clock().now()).",
    )
