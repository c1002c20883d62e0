"""The camera is on turtle1 and looks 30 degrees down."""

import math

from rclpy.time import Time
from tf2_ros import TransformException
from tf_transformations import quaternion_matrix
from turtle_lesson.exercise import Exercise, NotYet

_PLACE = (0.2, 0.0, 0.3)
_DOWN = math.radians(30)
_NO_UNIT = (
    "The quaternion must have length 1; all zeros is not a rotation. Copy all four numbers "
    "of quaternion_from_euler: q[0] to x, q[1] to y, q[2] to z, q[3] to w."
)


def _quaternion(exercise: Exercise) -> tuple[float, float, float, float]:
    exercise.simulation.run(1.0)
    try:
        found = exercise.buffer.lookup_transform("turtle1", "camera", Time()).transform.rotation
    except TransformException as error:
        hint = _NO_UNIT if "camera" not in exercise.frames() else ""
        hint = hint or "Keep child_frame_id = 'camera' and header.frame_id = 'turtle1'."
        raise NotYet(f"There is no transform from turtle1 to camera: {error}", hint) from error
    return found.x, found.y, found.z, found.w


def check_parent(exercise: Exercise) -> None:
    """The frame camera is a child of turtle1."""
    _quaternion(exercise)
    parent = exercise.frames()["camera"]
    exercise.expect(
        parent == "turtle1",
        f"the parent of camera is {parent}.",
        "The camera moves with turtle1: header.frame_id = 'turtle1'.",
    )


def check_place(exercise: Exercise) -> None:
    """It is 0.2 m ahead and 0.3 m up."""
    _quaternion(exercise)
    found = exercise.buffer.lookup_transform("turtle1", "camera", Time()).transform.translation
    place = (found.x, found.y, found.z)
    hint = "In turtle1's frame x is ahead, y to the left and z up; all in metres: 20 cm are 0.2."
    if math.dist(place, (_PLACE[0], _PLACE[2], 0.0)) < 0.01:
        hint = "That is to the left: up is z."
    seen = f"camera is {place[0]:.2f} m ahead, {place[1]:.2f} m left, {place[2]:.2f} m up."
    exercise.expect(math.dist(place, _PLACE) < 0.01, seen, hint)


def check_view(exercise: Exercise) -> None:
    """It looks ahead and 30° down, and is level."""
    x, y, z, w = _quaternion(exercise)
    matrix = quaternion_matrix((x, y, z, w))
    looks, left = [row[0] for row in matrix[:3]], [row[1] for row in matrix[:3]]
    wanted = (math.cos(_DOWN), 0.0, -math.sin(_DOWN))
    down = math.degrees(math.asin(max(-1.0, min(1.0, -looks[2]))))
    side = math.degrees(math.atan2(looks[1], looks[0]))
    lean = math.degrees(math.asin(max(-1.0, min(1.0, left[2]))))
    seen = f"It looks {down:.0f}° down and {side:.0f}° to the left, and leans by {lean:.0f}°."
    right = math.dist(looks, wanted) < 0.02 and abs(lean) < 1.0
    exercise.expect(right, seen, _hint((x, y, z, w), down, side, lean))


def _hint(q: tuple[float, float, float, float], down: float, side: float, lean: float) -> str:
    swapped = (math.cos(_DOWN / 2), 0.0, math.sin(_DOWN / 2), 0.0)
    if math.dist(q, swapped) < 0.01:
        return "The order is x, y, z, w: w, which is near 1 for small angles, comes last."
    in_degrees = math.remainder(30.0, math.tau)
    if abs(abs(math.remainder(math.radians(down), math.tau)) - abs(in_degrees)) < 0.02 or (
        abs(q[1] - math.sin(15.0)) < 0.01
    ):
        return "quaternion_from_euler takes radians: math.radians(30)."
    if abs(down + 30) < 1:
        return "That is up: a positive pitch turns the x axis down."
    if abs(abs(lean) - 30) < 1 and abs(down) < 1:
        return "That is roll, which turns about x. To look down, turn about y: pitch."
    if abs(abs(side) - 30) < 1:
        return "That is yaw, which turns about z, in the plane. To look down, turn about y: pitch."
    return "roll, pitch, yaw = 0.0, math.radians(30), 0.0"
