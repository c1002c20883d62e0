"""Each turtle has its own frames odom and base_link, and they are consistent."""

import math

from turtle_lesson.exercise import Exercise

_TURTLES = ("turtle1", "turtle2")
_ROTATE = (
    "The start also has a heading: rotate (dx, dy) by it, "
    "x = dx * cos(a) + dy * sin(a), y = -dx * sin(a) + dy * cos(a), with a = odom.theta."
)


def check_frames(exercise: Exercise) -> None:
    """Each turtle has its frames: world, odom, base_link."""
    exercise.simulation.run(1.0)
    frames = exercise.frames()
    known = ", ".join(sorted(frames)) or "none"
    for turtle in _TURTLES:
        for child, parent in (("odom", "world"), ("base_link", f"{turtle}/odom")):
            name = f"{turtle}/{child}"
            hint = "Send both transforms for each pose, with sendTransform."
            if child in frames:
                hint = (
                    "Two nodes run this file. Each needs names of its own: "
                    f"f'{{self.turtlename}}/{child}'."
                )
            seen = f"There is no frame {name}. The frames are: {known}."
            exercise.expect(name in frames, seen, hint)
            exercise.expect(
                frames[name] == parent,
                f"the parent of {name} is {frames[name]}.",
                f"{parent} is its parent: the chain is world -> odom -> base_link.",
            )


def check_start(exercise: Exercise) -> None:
    """The frames odom stay where the turtles started."""
    starts = {turtle: exercise.simulation.pose(turtle) for turtle in _TURTLES}
    for turtle in _TURTLES:
        exercise.simulation.drive(turtle, linear=1.0)
    exercise.simulation.run(2.0)
    for turtle, start in starts.items():
        place = exercise.place("world", f"{turtle}/odom")
        exercise.expect(
            math.dist(place[:2], (start.x, start.y)) < 0.1,
            f"{turtle} began at ({start.x:.1f}, {start.y:.1f}); its odom is at "
            f"({place.x:.1f}, {place.y:.1f}).",
            "odom is the first pose: keep it in self.start, and do not change it.",
        )
        exercise.expect(
            abs(math.remainder(place.yaw - start.theta, math.tau)) < 0.05,
            f"{turtle} began with a heading of {math.degrees(start.theta):.0f}°; its odom has "
            f"{math.degrees(place.yaw):.0f}°.",
            "odom has the heading of the first pose as well: odom.theta.",
        )


def check_ahead(exercise: Exercise) -> None:
    """A turtle that drives straight ahead moves along the x axis of its odom."""
    exercise.simulation.run(0.2)
    for turtle in _TURTLES:
        exercise.simulation.drive(turtle, linear=1.5)
    exercise.simulation.run(2.0)
    for turtle in _TURTLES:
        place = exercise.place(f"{turtle}/odom", f"{turtle}/base_link")
        hint = _ROTATE
        if math.hypot(place.x, place.y) < 0.2:
            hint = "base_link moves: take dx = pose.x - odom.x and dy = pose.y - odom.y."
        exercise.expect(
            place.x > 1.0 and abs(place.y) < 0.1,
            f"{turtle} drove 1.5 m straight ahead, and its base_link is at x = {place.x:.1f} m, "
            f"y = {place.y:.1f} m of its odom.",
            hint,
        )


def check_curve(exercise: Exercise) -> None:
    """After a curve, the whole chain agrees with the pose of the turtle."""
    for _ in range(3):
        for turtle in _TURTLES:
            exercise.simulation.drive(turtle, linear=1.0, angular=0.7)
        exercise.simulation.run(1.0)
    exercise.simulation.run(1.0)
    for turtle in _TURTLES:
        place, pose = (
            exercise.place("world", f"{turtle}/base_link"),
            exercise.simulation.pose(turtle),
        )
        exercise.expect(
            math.dist(place[:2], (pose.x, pose.y)) < 0.1,
            f"{turtle} is at ({pose.x:.1f}, {pose.y:.1f}); by TF it is at "
            f"({place.x:.1f}, {place.y:.1f}).",
            _ROTATE,
        )
        exercise.expect(
            abs(math.remainder(place.yaw - pose.theta, math.tau)) < 0.1,
            f"{turtle}'s heading is {math.degrees(pose.theta):.0f}°; by TF it is "
            f"{math.degrees(place.yaw):.0f}°.",
            "TF adds the rotations of the chain: theta = pose.theta - odom.theta.",
        )
