"""Typical mistakes of students in the exercises that are not lessons, and the hints."""

from __future__ import annotations

from typing import NamedTuple


class WrongAnswer(NamedTuple):
    """A solution with a mistake: (right, wrong) texts, and a part of the hint."""

    exercise: str
    name: str
    changes: tuple[tuple[str, str], ...]
    hint: str

    def files(self, lesson):
        """The files that a student with this mistake hands in."""
        (name,) = lesson.files
        text = lesson.solution()[name]
        for right, wrong in self.changes:
            assert right in text, (self.exercise, self.name, right)
            text = text.replace(right, wrong)
        return {name: text}


DX = "dx * math.cos(a) + dy * math.sin(a)"
DY = "-dx * math.sin(a) + dy * math.cos(a)"
FOUND = "found.transform.translation"
WRONG_ANSWERS = [
    WrongAnswer("camera", "degrees", (("math.radians(30)", "30.0"),), "takes radians"),
    WrongAnswer(
        "camera",
        "w_first",
        tuple((f"= q[{old}]", f"= q [{(old + 3) % 4}]") for old in range(4)),
        "The order is x, y, z, w",
    ),
    WrongAnswer(
        "camera",
        "roll",
        (("0.0, math.radians(30), 0.0", "math.radians(30), 0.0, 0.0"),),
        "That is roll",
    ),
    WrongAnswer(
        "camera",
        "yaw",
        (("0.0, math.radians(30), 0.0", "0.0, 0.0, math.radians(30)"),),
        "That is yaw",
    ),
    WrongAnswer("camera", "looks_up", (("math.radians(30)", "-math.radians(30)"),), "That is up"),
    WrongAnswer("camera", "no_w", (("= q[1]", "= 0.0"), ("= q[3]", "= 0.0")), "must have length 1"),
    WrongAnswer(
        "camera",
        "y_is_up",
        (
            ("translation.z = 0.3", "translation.z = 0.0"),
            ("translation.y = 0.0", "translation.y = 0.3"),
        ),
        "up is z",
    ),
    WrongAnswer("camera", "on_world", (("'turtle1'", "'world'"),), "moves with turtle1"),
    WrongAnswer("odometry", "not_turned", ((DX, "dx"), (DY, "dy")), "also has a heading"),
    WrongAnswer("odometry", "wrong_sign", ((DY, DY.removeprefix("-")),), "also has a heading"),
    WrongAnswer(
        "odometry", "one_name", (("f'{self.turtlename}/odom'", "'odom'"),), "names of its own"
    ),
    WrongAnswer(
        "odometry",
        "absolute_heading",
        (("pose.theta - odom.theta", "pose.theta"),),
        "adds the rotations",
    ),
    WrongAnswer(
        "odometry", "moving_start", (("if self.start is None:", "if True:"),), "the first pose"
    ),
    WrongAnswer(
        "find_the_fault",
        "name_left",
        (("= self.turtlename\n\n", "= 'turtle1'\n\n"),),
        "two nodes: which name",
    ),
    WrongAnswer(
        "find_the_fault",
        "stamp_left",
        (("t.header.stamp = self.get_clock().now().to_msg()", "t.header.stamp.sec = 1"),),
        "node's clock",
    ),
    WrongAnswer("find_the_fault", "place_left", (("= msg.y", "= msg.x"),), "x and y"),
    WrongAnswer(
        "find_the_fault", "heading_left", (("(0, 0, msg.theta)", "(msg.theta, 0, 0)"),), "is yaw"
    ),
    WrongAnswer(
        "meeting_point",
        "not_halved",
        ((f"{FOUND}.x / 2", f"{FOUND}.x"), (f"{FOUND}.y / 2", f"{FOUND}.y")),
        "take half",
    ),
    WrongAnswer(
        "meeting_point",
        "frames_swapped",
        (
            (
                "                'turtle1',\n                'turtle2',",
                "                'turtle2', 'turtle1',",
            ),
        ),
        "target frame comes first",
    ),
    WrongAnswer(
        "meeting_point",
        "on_world",
        (("frame_id = 'turtle1'", "frame_id = 'world'"),),
        "in turtle1's frame",
    ),
    WrongAnswer(
        "meeting_point",
        "clock",
        (("stamp = found.header.stamp", "stamp = self.get_clock().now().to_msg()"),),
        "copy its header.stamp",
    ),
    WrongAnswer(
        "meeting_point",
        "time_now",
        (("rclpy.time.Time()", "self.get_clock().now()"),),
        "look up the latest",
    ),
]
