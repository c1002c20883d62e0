"""The broadcaster has no bugs left."""

import math

from turtle_lesson.exercise import Exercise

_TURTLES = ("turtle1", "turtle2")


def check_names(exercise: Exercise) -> None:
    """Each turtle has a frame, a child of world."""
    exercise.simulation.run(1.0)
    frames = exercise.frames()
    known = ", ".join(f"{parent} -> {frame}" for frame, parent in sorted(frames.items())) or "none"
    for turtle in _TURTLES:
        exercise.expect(
            turtle in frames,
            f"There is no frame {turtle}. The frames are: {known}.",
            "`turtlewire frames` shows one turtle only, published by two nodes: which name does "
            "each of them give its frame? It is in self.turtlename.",
        )
        exercise.expect(
            frames[turtle] == "world",
            f"the parent of {turtle} is {frames[turtle]}.",
            "header.frame_id is the parent, child_frame_id the turtle: world -> turtle.",
        )


def check_stamps(exercise: Exercise) -> None:
    """The stamps are fresh."""
    exercise.simulation.run(2.0)
    for turtle in _TURTLES:
        age = exercise.simulation.now - exercise.stamp("world", turtle)
        exercise.expect(
            abs(age) < 0.5,
            f"The newest transform of {turtle} is {age:.1f} s old.",
            "`turtlewire doctor` also reports it. A transform is valid at a time: stamp it with "
            "the node's clock, self.get_clock().now().to_msg().",
        )


def check_places(exercise: Exercise) -> None:
    """TF and turtlesim agree on the positions of the turtles."""
    exercise.simulation.run(1.0)
    for turtle in ("turtle2", "turtle1"):
        place, pose = exercise.place("world", turtle), exercise.simulation.pose(turtle)
        exercise.expect(
            math.dist(place[:2], (pose.x, pose.y)) < 0.1,
            f"{turtle} is at ({pose.x:.1f}, {pose.y:.1f}); by TF it is at "
            f"({place.x:.1f}, {place.y:.1f}).",
            "Compare each number of the translation with /turtle2/pose: x and y.",
        )


def check_headings(exercise: Exercise) -> None:
    """TF and turtlesim agree on the headings of the turtles."""
    exercise.simulation.drive("turtle1", angular=1.0)
    exercise.simulation.run(2.0)
    place, pose = exercise.place("world", "turtle1"), exercise.simulation.pose("turtle1")
    exercise.expect(
        abs(math.remainder(place.yaw - pose.theta, math.tau)) < 0.1,
        f"turtle1's heading is {math.degrees(pose.theta):.0f}°; by TF it is "
        f"{math.degrees(place.yaw):.0f}°.",
        "quaternion_from_euler(roll, pitch, yaw): a turtle turns in the plane, which is yaw.",
    )


def check_following(exercise: Exercise) -> None:
    """Turtle2 follows turtle1."""
    exercise.simulation.run(15.0)
    left = exercise.simulation.distance("turtle1", "turtle2")
    exercise.expect(
        left < 0.5,
        f"After 15 s turtle2 is still {left:.2f} m away.",
        "Drive turtle1 and compare `tf2_echo world turtle1` with /turtle1/pose: every number.",
    )
