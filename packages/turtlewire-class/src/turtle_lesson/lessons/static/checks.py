"""The frame `tower` stands at (2, 8) in the world and looks up."""

import math

from turtle_lesson.exercise import Exercise

_X, _Y, _YAW = 2.0, 8.0, math.pi / 2


def check_frame_exists(exercise: Exercise) -> None:
    """The frame tower exists, and its parent is world."""
    exercise.simulation.run(0.5)
    frames = exercise.frames()
    exercise.expect(
        frames.get("world") != "tower",
        "the parent of world is tower.",
        "header.frame_id is the parent, child_frame_id is the new frame: swap them.",
    )
    others = ", ".join(sorted(frames)) or "none"
    exercise.expect(
        "tower" in frames,
        f"There is no frame tower. Existing frames: {others}.",
        "Set child_frame_id to 'tower'. If the log says that a transform is ignored, its rotation "
        "is not a unit quaternion: without any rotation, w is 1.",
    )
    exercise.expect(
        frames["tower"] == "world",
        f"the parent of tower is {frames['tower']}.",
        "Set header.frame_id to 'world'.",
    )


def check_place(exercise: Exercise) -> None:
    """Tower is at x = 2, y = 8."""
    exercise.simulation.run(0.5)
    place = exercise.place("world", "tower")
    seen = f"tower is at x = {place.x:.2f}, y = {place.y:.2f}."
    swapped = math.dist((place.x, place.y), (_Y, _X)) < 0.05
    exercise.expect(not swapped, seen, "x and y are swapped: x is to the right, y is up.")
    exercise.expect(
        math.dist((place.x, place.y), (_X, _Y)) < 0.05,
        seen,
        "Set translation.x and translation.y, in metres.",
    )


def check_heading(exercise: Exercise) -> None:
    """Tower looks up: a quarter turn to the left."""
    exercise.simulation.run(0.5)
    yaw = exercise.place("world", "tower").yaw
    seen = f"tower is turned by {math.degrees(yaw):.0f}°."
    as_degrees = math.remainder(90.0, math.tau)
    hint = "The third angle of quaternion_from_euler(roll, pitch, yaw) is the one in the plane."
    if abs(math.remainder(yaw - as_degrees, math.tau)) < 0.01:
        hint = "quaternion_from_euler takes radians: a quarter turn is math.pi / 2, not 90."
    if abs(yaw + _YAW) < 0.01:
        hint = "Positive angles turn to the left."
    exercise.expect(abs(math.remainder(yaw - _YAW, math.tau)) < 0.05, seen, hint)


def check_late_listener(exercise: Exercise) -> None:
    """A listener that starts later also receives tower."""
    exercise.simulation.run(5.0)
    late = exercise.another_buffer()
    exercise.simulation.run(1.0)
    exercise.expect(
        "tower" in late.all_frames_as_yaml(),
        "A listener that started after five seconds has not received tower.",
        "StaticTransformBroadcaster keeps its transforms for later listeners; "
        "TransformBroadcaster sends only to listeners that already exist.",
    )
