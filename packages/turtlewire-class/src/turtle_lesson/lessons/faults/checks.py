"""Turtle2 follows only transforms that are fresh."""

import math

from turtle_lesson.exercise import Exercise
from turtlesim.testing.faults import Delay, Loss, WrongFrame

_AGE = (
    "The time of the transform is t.header.stamp. age = self.get_clock().now() - "
    "rclpy.time.Time.from_msg(t.header.stamp); publish nothing if age.nanoseconds > 1e9."
)


def check_follows(exercise: Exercise) -> None:
    """Without a fault, turtle2 comes to turtle1."""
    exercise.simulation.run(15.0)
    left = exercise.simulation.distance("turtle1", "turtle2")
    exercise.expect(
        left < 0.5,
        f"After 15 s turtle2 is {left:.2f} m away.",
        "Accept fresh transforms: look up the latest one, rclpy.time.Time(), and compare its age "
        "with one second. The age is now minus stamp, in this order.",
    )


def check_survives(exercise: Exercise) -> None:
    """After a wrong frame for a while, the listener recovers."""
    simulation = exercise.simulation
    simulation.inject(WrongFrame("turtle1", "wolrd"))
    simulation.run(3.0)
    simulation.clear_faults()
    simulation.run(15.0)
    left = simulation.distance("turtle1", "turtle2")
    exercise.expect(
        left < 0.5,
        f"After the fault turtle2 is still {left:.2f} m away.",
        "Catch TransformException, log it and return: the next call of the timer tries again.",
    )


def check_old_news(exercise: Exercise) -> None:
    """With transforms that are three seconds late, turtle2 stays where it is."""
    simulation = exercise.simulation
    simulation.run(12.0)
    simulation.inject(Delay(3.0, "turtle1"))
    simulation.run(3.0)
    start = simulation.pose("turtle2")
    for _ in range(6):
        simulation.drive("turtle1", linear=1.0, angular=0.5)
        simulation.run(1.0)
    pose = simulation.pose("turtle2")
    moved = math.dist((pose.x, pose.y), (start.x, start.y))
    exercise.expect(
        moved < 0.3, f"turtle2 drove {moved:.2f} m by transforms that were 3 s old.", _AGE
    )


def check_losses(exercise: Exercise) -> None:
    """With nine of ten transforms lost, turtle2 still follows."""
    exercise.simulation.inject(Loss(0.9))
    exercise.simulation.run(20.0)
    left = exercise.simulation.distance("turtle1", "turtle2")
    exercise.expect(
        left < 0.7,
        f"After 20 s turtle2 is {left:.2f} m away.",
        "One second is the limit: a transform that is 0.2 s old is good enough.",
    )
