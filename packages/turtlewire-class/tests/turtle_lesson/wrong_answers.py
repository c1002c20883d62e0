"""Typical mistakes of students, as changes of the solutions, and the expected hints."""

from __future__ import annotations

from typing import NamedTuple


class WrongAnswer(NamedTuple):
    """A solution with a mistake: (right, wrong) texts, and a part of the hint."""

    lesson: str
    name: str
    changes: tuple[tuple[str, str], ...]
    hint: str

    def files(self, lesson):
        """The files that a student with this mistake hands in."""
        files = lesson.solution()
        for right, wrong in self.changes:
            assert right in files[lesson.files[0]], (self.lesson, self.name, right)
            files[lesson.files[0]] = files[lesson.files[0]].replace(right, wrong)
        return files


LOOKUP = """self.tf_buffer.lookup_transform(
                to_frame_rel,
                from_frame_rel,
                rclpy.time.Time()
            )"""
FULL = """self.tf_buffer.lookup_transform_full(
                target_frame=to_frame_rel,
                target_time=rclpy.time.Time(),
                source_frame=from_frame_rel,
                source_time=when,
                fixed_frame='world'
            )"""
WRONG_ANSWERS = [
    WrongAnswer("static", "degrees", (("math.pi / 2", "90"),), "takes radians"),
    WrongAnswer(
        "static",
        "swapped",
        (
            ("frame_id = 'world'", "frame_id = 'A'"),
            ("child_frame_id = 'tower'", "child_frame_id = 'world'"),
            ("frame_id = 'A'", "frame_id = 'tower'"),
        ),
        "swap them",
    ),
    WrongAnswer(
        "static",
        "not_static",
        (("StaticTransformBroadcaster", "TransformBroadcaster"),),
        "for later listeners",
    ),
    WrongAnswer("static", "no_rotation", (("= q[3]", "= 0.0"), ("= q[2]", "= 0.0")), "w is 1"),
    WrongAnswer("static", "x_and_y", (("2.0", "8.1"), ("8.0", "2.0"), ("8.1", "8.0")), "swapped"),
    WrongAnswer(
        "broadcaster", "one_name", (("f'{self.turtlename}_nose'", "'nose'"),), "a name of its own"
    ),
    WrongAnswer(
        "broadcaster",
        "parent_world",
        (("nose.header.frame_id = self.turtlename", "nose.header.frame_id = 'world'"),),
        "moves with the turtle",
    ),
    WrongAnswer(
        "broadcaster",
        "to_the_side",
        (("nose.transform.translation.x", "nose.transform.translation.y"),),
        "x is ahead",
    ),
    WrongAnswer(
        "broadcaster",
        "same_object",
        (
            ("nose = TransformStamped()", "nose = t"),
            ("        self.tf_broadcaster.sendTransform(t)\n", ""),
        ),
        "Keep the first transform",
    ),
    WrongAnswer(
        "listener",
        "frames_swapped",
        (
            (
                LOOKUP,
                LOOKUP.replace("to_frame", "A")
                .replace("from_frame", "to_frame")
                .replace("A_rel", "from_frame_rel"),
            ),
        ),
        "target is turtle2, source is turtle1",
    ),
    WrongAnswer("listener", "no_distance", (("distance - 1.0", "distance"),), "subtract 1.0"),
    WrongAnswer(
        "listener",
        "time_now",
        (("rclpy.time.Time()", "self.get_clock().now()"),),
        "Look up the latest transform",
    ),
    WrongAnswer("listener", "misspelt", (("msg = Twist()", "msg = Twits()"),), "Import the name"),
    WrongAnswer("fixed_carrot", "in_front", (("= -1.0", "= 1.0"),), "x points ahead"),
    WrongAnswer(
        "fixed_carrot",
        "at_the_side",
        (
            ("translation.x = -1.0", "translation.x = 0.0"),
            ("translation.y = 0.0", "translation.y = -1.0"),
        ),
        "y points to the left",
    ),
    WrongAnswer(
        "fixed_carrot",
        "parent_world",
        (("frame_id = 'turtle1'", "frame_id = 'world'"),),
        "header.frame_id = 'turtle1'",
    ),
    WrongAnswer(
        "dynamic_carrot",
        "wall_time",
        (
            ("import math\n", "import math\nimport time\n"),
            ("(now.nanoseconds / 1e9)", "time.time()"),
        ),
        "time.time\\(\\) does not follow",
    ),
    WrongAnswer("dynamic_carrot", "parent_world", (("'turtle1'", "'world'"),), "around turtle1"),
    WrongAnswer(
        "dynamic_carrot",
        "whole_seconds",
        (("(now.nanoseconds / 1e9)", "now.seconds_nanoseconds()[0]"),),
        "Whole seconds are too coarse",
    ),
    WrongAnswer("dynamic_carrot", "no_stamp", (("= now.to_msg()", "= t.header.stamp"),), "1970"),
    WrongAnswer(
        "time_travel",
        "one_time",
        ((FULL, LOOKUP.replace("rclpy.time.Time()", "when")),),
        "its own position three seconds ago",
    ),
    WrongAnswer("time_travel", "present", ((FULL, LOOKUP),), "position three seconds ago"),
    WrongAnswer(
        "time_travel", "five_seconds", (("seconds=3.0", "seconds=5.0"),), "Three seconds, not more"
    ),
    WrongAnswer(
        "time_travel",
        "moving_fixed_frame",
        (("fixed_frame='world'", "fixed_frame='turtle2'"),),
        "does not move in between",
    ),
    WrongAnswer("faults", "no_limit", (("> 1e9", "> 1e12"),), "publish nothing if"),
    WrongAnswer("faults", "wrong_order", (("> 1e9", "< 1e9"),), "The age is now minus stamp"),
    WrongAnswer(
        "faults",
        "not_caught",
        (("except TransformException as ex", "except ZeroDivisionError as ex"),),
        "Catch TransformException",
    ),
    WrongAnswer("faults", "too_strict", (("> 1e9", "> 1e6"),), "compare its age with one second"),
]
