"""Each turtle has a nose, half a metre ahead of it."""

import math

from turtle_lesson.exercise import Exercise

_AHEAD = 0.5
_FIRST = (
    "Keep the first transform as it was, world -> turtle, and make a second TransformStamped() for "
    "the nose: one object that is changed and sent twice is easily mixed up."
)
_TURTLES = ("turtle1", "turtle2")


def check_turtles(exercise: Exercise) -> None:
    """The transforms of both turtles are still published."""
    exercise.simulation.run(1.0)
    for turtle in _TURTLES:
        place, pose = exercise.place("world", turtle, _FIRST), exercise.simulation.pose(turtle)
        exercise.expect(
            math.dist((place.x, place.y), (pose.x, pose.y)) < 0.1,
            f"TF says that {turtle} is at ({place.x:.2f}, {place.y:.2f}); it is at "
            f"({pose.x:.2f}, {pose.y:.2f}).",
            _FIRST,
        )


def check_noses(exercise: Exercise) -> None:
    """The frames turtle1_nose and turtle2_nose exist."""
    exercise.simulation.run(1.0)
    frames = exercise.frames()
    for turtle in _TURTLES:
        nose = f"{turtle}_nose"
        known = ", ".join(sorted(frames)) or "none"
        hint = "Send a second TransformStamped in the callback, with sendTransform."
        if any("nose" in frame for frame in frames):
            hint = (
                "Two nodes run this file, one for each turtle. Each needs a name of its own: "
                "child_frame_id = f'{self.turtlename}_nose'."
            )
        exercise.expect(nose in frames, f"There is no frame {nose}. The frames are: {known}.", hint)


def check_parent(exercise: Exercise) -> None:
    """Each nose is a child of its turtle."""
    exercise.simulation.run(1.0)
    frames = exercise.frames()
    for turtle in _TURTLES:
        parent = frames.get(f"{turtle}_nose")
        exercise.expect(
            parent == turtle,
            f"the parent of {turtle}_nose is {parent}.",
            "A frame that moves with the turtle has the turtle as its parent: header.frame_id = "
            "self.turtlename. Then TF does the geometry.",
        )


def check_place(exercise: Exercise) -> None:
    """Each nose is half a metre ahead, wherever the turtle looks."""
    simulation = exercise.simulation
    for turn in (0.0, 1.5):
        simulation.drive("turtle1", angular=turn)
        simulation.run(1.5)
        for turtle in _TURTLES:
            place = exercise.place(turtle, f"{turtle}_nose")
            hint = "In a turtle's own frame x is ahead and y is to the left: x = 0.5, y = 0."
            if math.dist(place[:2], (_AHEAD, 0.0)) < 1.0 and abs(place.y) > 0.1 and place.x < 0.1:
                hint = "That is to the side: x is ahead, y is to the left."
            exercise.expect(
                math.dist(place[:2], (_AHEAD, 0.0)) < 0.02,
                f"{turtle} sees its nose {place.x:.2f} m ahead and {place.y:.2f} m to the left.",
                hint,
            )


def check_following(exercise: Exercise) -> None:
    """Turtle2 still follows turtle1."""
    exercise.simulation.run(15.0)
    left = exercise.simulation.distance("turtle1", "turtle2")
    exercise.expect(
        left < 0.5,
        f"After 15 s turtle2 is still {left:.2f} m away.",
        "The broadcaster of a turtle must keep its frame: world -> turtle.",
    )
