"""Typical mistakes of students, as changes of the solutions, and the expected hints."""

from __future__ import annotations

from typing import NamedTuple


class WrongAnswer(NamedTuple):
    """A solution with a mistake: wrong texts by the right ones, and a part of the hint."""

    exercise: str
    name: str
    changes: dict[str, str]
    hint: str

    def files(self, lesson):
        """The files that a student with this mistake hands in."""
        files = lesson.solution()
        name = lesson.files[0]
        for right, wrong in self.changes.items():
            assert right in files[name], (self.exercise, self.name, right)
            files[name] = files[name].replace(right, wrong)
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
DX = "dx * math.cos(a) + dy * math.sin(a)"
DY = "-dx * math.sin(a) + dy * math.cos(a)"
FOUND = "found.transform.translation"
WRONG_ANSWERS = [
    WrongAnswer("static", "degrees", {"math.pi / 2": "90"}, "takes radians"),
    WrongAnswer(
        "static",
        "swapped",
        {
            "frame_id = 'world'": "frame_id = 'A'",
            "child_frame_id = 'tower'": "child_frame_id = 'world'",
            "frame_id = 'A'": "frame_id = 'tower'",
        },
        "swap them",
    ),
    WrongAnswer(
        "static",
        "not_static",
        {"StaticTransformBroadcaster": "TransformBroadcaster"},
        "for later listeners",
    ),
    WrongAnswer("static", "no_rotation", {"= q[3]": "= 0.0", "= q[2]": "= 0.0"}, "w is 1"),
    WrongAnswer("static", "x_and_y", {"2.0": "8.1", "8.0": "2.0", "8.1": "8.0"}, "swapped"),
    WrongAnswer(
        "broadcaster", "one_name", {"f'{self.turtlename}_nose'": "'nose'"}, "a name of its own"
    ),
    WrongAnswer(
        "broadcaster",
        "parent_world",
        {"nose.header.frame_id = self.turtlename": "nose.header.frame_id = 'world'"},
        "moves with the turtle",
    ),
    WrongAnswer(
        "broadcaster",
        "to_the_side",
        {"nose.transform.translation.x": "nose.transform.translation.y"},
        "x is ahead",
    ),
    WrongAnswer(
        "broadcaster",
        "same_object",
        {
            "nose = TransformStamped()": "nose = t",
            "        self.tf_broadcaster.sendTransform(t)\n": "",
        },
        "Keep the first transform",
    ),
    WrongAnswer(
        "listener",
        "frames_swapped",
        {
            LOOKUP: LOOKUP.replace("to_frame", "A")
            .replace("from_frame", "to_frame")
            .replace("A_rel", "from_frame_rel")
        },
        "target is turtle2, source is turtle1",
    ),
    WrongAnswer("listener", "no_distance", {"distance - 1.0": "distance"}, "subtract 1.0"),
    WrongAnswer(
        "listener",
        "time_now",
        {"rclpy.time.Time()": "self.get_clock().now()"},
        "Look up the latest transform",
    ),
    WrongAnswer("listener", "misspelt", {"msg = Twist()": "msg = Twits()"}, "Import the name"),
    WrongAnswer("fixed_carrot", "in_front", {"= -1.0": "= 1.0"}, "x points ahead"),
    WrongAnswer(
        "fixed_carrot",
        "at_the_side",
        {
            "translation.x = -1.0": "translation.x = 0.0",
            "translation.y = 0.0": "translation.y = -1.0",
        },
        "y points to the left",
    ),
    WrongAnswer(
        "fixed_carrot",
        "parent_world",
        {"frame_id = 'turtle1'": "frame_id = 'world'"},
        "header.frame_id = 'turtle1'",
    ),
    WrongAnswer(
        "dynamic_carrot",
        "wall_time",
        {"import math\n": "import math\nimport time\n", "(now.nanoseconds / 1e9)": "time.time()"},
        "time.time\\(\\) does not follow",
    ),
    WrongAnswer("dynamic_carrot", "parent_world", {"'turtle1'": "'world'"}, "around turtle1"),
    WrongAnswer(
        "dynamic_carrot",
        "whole_seconds",
        {"(now.nanoseconds / 1e9)": "now.seconds_nanoseconds()[0]"},
        "Whole seconds are too coarse",
    ),
    WrongAnswer("dynamic_carrot", "no_stamp", {"= now.to_msg()": "= t.header.stamp"}, "1970"),
    WrongAnswer(
        "time_travel",
        "one_time",
        {FULL: LOOKUP.replace("rclpy.time.Time()", "when")},
        "its own position three seconds ago",
    ),
    WrongAnswer("time_travel", "present", {FULL: LOOKUP}, "position three seconds ago"),
    WrongAnswer(
        "time_travel", "five_seconds", {"seconds=3.0": "seconds=5.0"}, "Three seconds, not more"
    ),
    WrongAnswer(
        "time_travel",
        "moving_fixed_frame",
        {"fixed_frame='world'": "fixed_frame='turtle2'"},
        "does not move in between",
    ),
    WrongAnswer("faults", "no_limit", {"> 1e9": "> 1e12"}, "publish nothing if"),
    WrongAnswer("faults", "wrong_order", {"> 1e9": "< 1e9"}, "The age is now minus stamp"),
    WrongAnswer(
        "faults",
        "not_caught",
        {"except TransformException as ex": "except ZeroDivisionError as ex"},
        "Catch TransformException",
    ),
    WrongAnswer("faults", "too_strict", {"> 1e9": "> 1e6"}, "compare its age with one second"),
    WrongAnswer("camera", "degrees", {"math.radians(30)": "30.0"}, "takes radians"),
    WrongAnswer(
        "camera",
        "w_first",
        {f"= q[{old}]": f"= q [{(old + 3) % 4}]" for old in range(4)},
        "The order is x, y, z, w",
    ),
    WrongAnswer(
        "camera",
        "roll",
        {"0.0, math.radians(30), 0.0": "math.radians(30), 0.0, 0.0"},
        "That is roll",
    ),
    WrongAnswer(
        "camera", "yaw", {"0.0, math.radians(30), 0.0": "0.0, 0.0, math.radians(30)"}, "That is yaw"
    ),
    WrongAnswer("camera", "looks_up", {"math.radians(30)": "-math.radians(30)"}, "That is up"),
    WrongAnswer("camera", "no_w", {"= q[1]": "= 0.0", "= q[3]": "= 0.0"}, "must have length 1"),
    WrongAnswer(
        "camera",
        "y_is_up",
        {
            "translation.z = 0.3": "translation.z = 0.0",
            "translation.y = 0.0": "translation.y = 0.3",
        },
        "up is z",
    ),
    WrongAnswer("camera", "on_world", {"'turtle1'": "'world'"}, "moves with turtle1"),
    WrongAnswer("odometry", "not_turned", {DX: "dx", DY: "dy"}, "also has a heading"),
    WrongAnswer("odometry", "wrong_sign", {DY: DY.removeprefix("-")}, "also has a heading"),
    WrongAnswer(
        "odometry", "one_name", {"f'{self.turtlename}/odom'": "'odom'"}, "names of its own"
    ),
    WrongAnswer(
        "odometry",
        "absolute_heading",
        {"pose.theta - odom.theta": "pose.theta"},
        "adds the rotations",
    ),
    WrongAnswer(
        "odometry", "moving_start", {"if self.start is None:": "if True:"}, "the first pose"
    ),
    WrongAnswer(
        "find_the_fault",
        "name_left",
        {"= self.turtlename\n\n": "= 'turtle1'\n\n"},
        "two nodes: which name",
    ),
    WrongAnswer(
        "find_the_fault",
        "stamp_left",
        {"t.header.stamp = self.get_clock().now().to_msg()": "t.header.stamp.sec = 1"},
        "node's clock",
    ),
    WrongAnswer("find_the_fault", "place_left", {"= msg.y": "= msg.x"}, "x and y"),
    WrongAnswer(
        "find_the_fault", "heading_left", {"(0, 0, msg.theta)": "(msg.theta, 0, 0)"}, "is yaw"
    ),
    WrongAnswer(
        "meeting_point",
        "not_halved",
        {f"{FOUND}.x / 2": f"{FOUND}.x", f"{FOUND}.y / 2": f"{FOUND}.y"},
        "take half",
    ),
    WrongAnswer(
        "meeting_point",
        "frames_swapped",
        {"'turtle1',\n                'turtle2',": "'turtle2', 'turtle1',"},
        "target frame comes first",
    ),
    WrongAnswer(
        "meeting_point",
        "on_world",
        {"frame_id = 'turtle1'": "frame_id = 'world'"},
        "in turtle1's frame",
    ),
    WrongAnswer(
        "meeting_point",
        "clock",
        {"stamp = found.header.stamp": "stamp = self.get_clock().now().to_msg()"},
        "copy its header.stamp",
    ),
    WrongAnswer(
        "meeting_point",
        "time_now",
        {"rclpy.time.Time()": "self.get_clock().now()"},
        "look up the latest",
    ),
]
