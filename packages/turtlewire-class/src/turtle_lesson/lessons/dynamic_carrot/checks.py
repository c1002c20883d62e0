"""The carrot circles around turtle1: two metres away, once in ten seconds, to the left."""

import math

from turtle_lesson.exercise import Exercise

_RADIUS, _RATE = 2.0, math.tau / 10.0


def check_parent(exercise: Exercise) -> None:
    """The frame carrot1 is a child of turtle1, and its stamps are fresh."""
    exercise.simulation.run(2.0)
    frames = exercise.frames()
    exercise.expect(
        frames.get("carrot1") == "turtle1",
        f"the parent of carrot1 is {frames.get('carrot1', 'missing: the frame does not exist')}.",
        "The carrot circles around turtle1: header.frame_id = 'turtle1'.",
    )
    stamp = exercise.stamp("turtle1", "carrot1")
    age = exercise.simulation.now - stamp
    exercise.expect(
        abs(age) < 0.5,
        f"The newest stamp of carrot1 is {age:.1f} s behind the clock.",
        "Stamp with the node's clock, self.get_clock().now(): time.time() is another clock when "
        "time is simulated, and an empty stamp is the year 1970.",
    )


def check_radius(exercise: Exercise) -> None:
    """The carrot is two metres away, all the time."""
    for _ in range(20):
        exercise.simulation.run(0.6)
        place = exercise.place("turtle1", "carrot1")
        away = math.hypot(place.x, place.y)
        exercise.expect(
            abs(away - _RADIUS) < 0.1,
            f"The carrot is {away:.2f} m from turtle1.",
            "A circle is x = r * cos(angle), y = r * sin(angle), with the same angle and r = 2.",
        )


def check_turns(exercise: Exercise) -> None:
    """It completes a circle in ten seconds, to the left."""
    exercise.simulation.run(1.0)
    first = exercise.place("turtle1", "carrot1")
    exercise.simulation.run(1.0)
    second = exercise.place("turtle1", "carrot1")
    turn = math.remainder(math.atan2(second.y, second.x) - math.atan2(first.y, first.x), math.tau)
    seen = f"In a second it turns by {math.degrees(turn):.0f}°; 36° are wanted."
    hint = "angle = 2 * pi * seconds / 10, with seconds = self.get_clock().now().nanoseconds / 1e9."
    if "time.time(" in "".join(exercise.files.values()):
        hint = "time.time() does not follow simulated time: use self.get_clock().now()."
    elif abs(turn + _RATE) < 0.1:
        hint = "It goes round to the right: y = r * sin(angle), or the angle's sign."
    exercise.expect(abs(turn - _RATE) < 0.1, seen, hint)


def check_smooth(exercise: Exercise) -> None:
    """It moves smoothly, without jumps."""
    exercise.simulation.run(1.0)
    before = exercise.place("turtle1", "carrot1")
    for _ in range(20):
        exercise.simulation.run(0.2)
        place = exercise.place("turtle1", "carrot1")
        leap = math.dist(place[:2], before[:2])
        exercise.expect(
            leap < 0.6,
            f"The carrot leaps by {leap:.2f} m within 0.2 s.",
            "Whole seconds are too coarse: use now.nanoseconds / 1e9, not the field sec alone.",
        )
        before = place
