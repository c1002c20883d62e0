"""Turtle2 goes where turtle1 was three seconds ago."""

import math

from turtle_lesson.exercise import Exercise

_FULL = (
    "lookup_transform_full(target_frame='turtle2', target_time=Time(), source_frame='turtle1', "
    "source_time=three seconds ago, fixed_frame='world') uses two times in one lookup: where "
    "turtle1 was then, in the frame of turtle2 now."
)


def _settle(exercise: Exercise) -> None:
    exercise.simulation.run(25.0)


def check_arrives(exercise: Exercise) -> None:
    """Turtle2 reaches a stationary turtle1, and stays there."""
    _settle(exercise)
    farthest = 0.0
    for _ in range(10):
        exercise.simulation.run(0.5)
        farthest = max(farthest, exercise.simulation.distance("turtle1", "turtle2"))
    hint = (
        "With one time for both turtles, turtle2 steers by its own position three seconds ago, "
        "and misses. " + _FULL
    )
    source = "\n".join(exercise.files.values())
    if "fixed_frame" in source and "'world'" not in source and '"world"' not in source:
        hint = "The fixed frame must be one that does not move in between: 'world'."
    elif "lookup_transform_full" in source:
        hint = (
            "Keep target_time=Time(), turtle2's current position, and a source_time in the past: "
            "now - Duration(seconds=3.0). The fixed frame is 'world'."
        )
    exercise.expect(farthest < 0.5, f"turtle2 is up to {farthest:.2f} m away.", hint)


def _drive_off(exercise: Exercise) -> tuple[float, float]:
    """Let turtle1 drive three metres within a second; turtle2's place before."""
    _settle(exercise)
    pose = exercise.simulation.pose("turtle2")
    exercise.simulation.drive("turtle1", linear=3.0)
    return pose.x, pose.y


def check_waits(exercise: Exercise) -> None:
    """Check that turtle2 learns three seconds later that turtle1 drives off."""
    start = _drive_off(exercise)
    exercise.simulation.run(2.5)
    pose = exercise.simulation.pose("turtle2")
    moved = math.dist((pose.x, pose.y), start)
    exercise.expect(
        moved < 0.3,
        f"2.5 s after turtle1 drove off, turtle2 had moved {moved:.2f} m.",
        "Use turtle1's position three seconds ago: source_time = "
        "self.get_clock().now() - Duration(seconds=3.0).",
    )


def check_follows(exercise: Exercise) -> None:
    """After three seconds turtle2 also sets off."""
    start = _drive_off(exercise)
    exercise.simulation.run(5.0)
    pose = exercise.simulation.pose("turtle2")
    moved = math.dist((pose.x, pose.y), start)
    exercise.expect(
        moved > 0.6,
        f"5 s after turtle1 drove off, turtle2 had moved {moved:.2f} m.",
        "Three seconds, not more: Duration(seconds=3.0).",
    )
    exercise.simulation.run(15.0)
    left = exercise.simulation.distance("turtle1", "turtle2")
    exercise.expect(left < 0.5, f"In the end turtle2 is {left:.2f} m away.", _FULL)
