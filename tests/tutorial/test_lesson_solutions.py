"""The solutions of the lessons in the tab: the same files, launched for real on the wire."""

import itertools
import json
import math
import re
import sys

import pytest
from tests.places import LEARNING, LESSONS, ROS2

from turtle_lesson.lesson import load_lesson
from turtlesim.testing.faults import WrongTime
from turtlewire import Buffer, msg
from turtlewire.tf.listener import TransformListener
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

pytestmark = [pytest.mark.slow, pytest.mark.timeout(300)]
PACKAGE = LEARNING
LONG_NS = 60_000_000_000
MIDDLE = 499 / 90  # where turtle1 stands
#: Where the faults' lesson publishes turtle1's transforms, for a fault on their way to /tf.
BEFORE_THE_FAULT = "/tf_before_the_fault"
LAUNCH = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(package="turtlesim", executable="turtlesim_node", name="sim"),
        {actions}
    ])
"""


def launch_file_of(lesson, folder):
    """Write the solution and a launch file that starts what the lesson starts."""
    actions = []
    for turtle in lesson.turtles:
        place = {"x": turtle.x, "y": turtle.y, "theta": turtle.theta, "name": turtle.name}
        call = [str(ROS2), "service", "call", "/spawn", "turtlesim/srv/Spawn", json.dumps(place)]
        actions.append(f"ExecuteProcess(cmd={call})")
    for program in lesson.programs:
        arguments = list(program.arguments)
        if program.source in lesson.files:
            start = f"executable={sys.executable!r}"
            arguments.insert(0, str(folder / program.source))
        else:
            package, executable = program.source.split(".")
            start = f"package={package!r}, executable={executable!r}"
        name = f", name={program.name!r}" if program.name else ""
        if lesson.folder.name == "faults" and program.name == "broadcaster1":
            name += f", remappings=[('/tf', {BEFORE_THE_FAULT!r})]"
        parameters = dict(program.parameters)
        actions.append(f"Node({start}{name}, arguments={arguments}, parameters=[{parameters}])")
    for file, source in lesson.solution().items():
        (folder / file).write_text(source, encoding="utf-8")
    path = folder / "lesson.launch.py"
    path.write_text(LAUNCH.format(actions=",\n        ".join(actions)), encoding="utf-8")
    return path


def type_id(name):
    return TypeId(name, msg.type_hash(name))


class Scene:
    """The state that a check examines: the turtles, and TF."""

    def __init__(self, turtles, buffer, launch):
        self.turtles = turtles
        self.buffer = buffer
        self.launch = launch

    def hear(self, topic, name, take):
        """Call a function with each message of a topic."""
        kind = msg.get_message(name)
        self.turtles.node.create_subscription(
            topic, type_id(name), QoS(depth=100), lambda cdr, _: take(msg.deserialize(kind, cdr))
        )

    def publisher(self, topic, name):
        """A function that publishes a message; a subscription is there already."""
        publisher = self.turtles.node.create_publisher(topic, type_id(name), QoS(depth=100))
        there = self.turtles.context.graph.wait_for(publisher.subscription_count, LONG_NS)
        assert there
        return lambda message: publisher.publish(msg.serialize(message))

    def drive_off(self):
        """Let turtle1 drive one metre."""
        twist = msg.get_message("geometry_msgs/msg/Twist")()
        twist.linear.x = 1.0
        self.publisher("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")(twist)

    def wait_until_still(self):
        """Wait until turtle2 has come so near to turtle1 that it hardly moves."""
        self.wait_for_gap(lambda gap: gap < 0.1)

    def place(self, target, source):
        """Return the pose of `source` in `target`, as soon as TF has it."""
        return self.buffer.lookup_transform(target, source, timeout_ns=LONG_NS)

    def wait_for_gap(self, is_right, other=(MIDDLE, MIDDLE)):
        """Wait until turtle2's distance from a place satisfies a condition."""
        poses = self.turtles.poses

        def gap():
            turtle2 = poses.get("turtle2")
            return math.inf if turtle2 is None else math.dist((turtle2.x, turtle2.y), other)

        self.turtles.wait_for(lambda: is_right(gap()))


def check_static(scene):
    tower = scene.place("world", "tower")
    assert tower.translation == pytest.approx((2.0, 8.0, 0.0))
    assert tower.rotation == pytest.approx((0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))


def check_broadcaster(scene):
    for turtle in ("turtle1", "turtle2"):
        nose = scene.place(turtle, f"{turtle}_nose")
        assert nose.translation == pytest.approx((0.5, 0.0, 0.0), abs=1e-6)
    scene.wait_for_gap(lambda gap: gap < 0.5)


def check_listener(scene):
    scene.wait_for_gap(lambda gap: gap < 2.0)
    still = scene.turtles.poses
    scene.turtles.wait_for(lambda: still["turtle2"].linear_velocity < 0.001)
    scene.wait_for_gap(lambda gap: abs(gap - 1.0) < 0.15)


def check_fixed_carrot(scene):
    assert scene.place("turtle1", "carrot1").translation == pytest.approx((-1.0, 0.0, 0.0))
    scene.wait_for_gap(lambda gap: gap < 0.5, (MIDDLE - 1.0, MIDDLE))


def check_dynamic_carrot(scene):
    first = scene.place("turtle1", "carrot1").translation
    assert math.hypot(*first) == pytest.approx(2.0, abs=0.1)

    def has_turned_left():
        x, y, _ = scene.place("turtle1", "carrot1").translation
        turned = math.atan2(y, x) - math.atan2(first[1], first[0])
        return 0.5 < math.remainder(turned, math.tau) < 2.0

    scene.turtles.wait_for(has_turned_left)


def check_time_travel(scene):
    """Turtle2 arrives, and does not set off before turtle1's move is three seconds old.

    Both are told by the stamps of the transforms, so that a busy host makes no difference.
    """
    scene.wait_until_still()
    heard = {"turtle1": [], "turtle2": []}

    def take(message):
        for transform in message.transforms:
            stamp, place = transform.header.stamp, transform.transform.translation
            moment = stamp.sec + stamp.nanosec / 1e9
            heard[transform.child_frame_id].append((moment, place.x, place.y))

    def set_off(turtle, metres):
        """The last moment at which a turtle was not yet so far from where it stood."""
        _, *start = heard[turtle][0]
        for (before, *_), (_, *place) in itertools.pairwise(list(heard[turtle])):
            if math.dist(place, start) > metres:
                return before
        return None

    scene.hear("/tf", "tf2_msgs/msg/TFMessage", take)
    scene.turtles.wait_for(lambda: all(heard.values()))
    scene.drive_off()
    scene.turtles.wait_for(lambda: set_off("turtle2", 0.2) is not None)
    assert set_off("turtle2", 0.2) - set_off("turtle1", 0.001) >= 3.0
    scene.wait_for_gap(lambda gap: gap < 0.5, (MIDDLE + 1.0, MIDDLE))


def check_faults(scene):
    """Turtle2 follows, but not while what it hears of turtle1 is three seconds old."""
    fault = [WrongTime(0.0, "turtle1")]
    send = scene.publisher("/tf", "tf2_msgs/msg/TFMessage")

    def pass_on(message):
        for transform in message.transforms:
            fault[-1].delay_s(transform)
        send(message)

    scene.hear(BEFORE_THE_FAULT, "tf2_msgs/msg/TFMessage", pass_on)
    scene.wait_until_still()
    fault.append(WrongTime(-3.0, "turtle1"))
    poses = scene.turtles.poses
    scene.turtles.wait_for(lambda: re.search(r"turtle1 is [3-9]\.\d s old", scene.launch.text))
    start = poses["turtle2"]
    scene.drive_off()
    scene.turtles.wait_for(lambda: poses["turtle1"].x > MIDDLE + 0.9)
    later = []
    scene.hear("/turtle2/pose", "turtlesim/msg/Pose", later.append)
    scene.turtles.wait_for(lambda: len(later) > 250)  # four seconds of the simulator's
    assert max(math.dist((pose.x, pose.y), (start.x, start.y)) for pose in list(later)) < 0.15
    fault.append(WrongTime(0.0, "turtle1"))
    scene.wait_for_gap(lambda gap: gap < 0.5, (MIDDLE + 1.0, MIDDLE))


CHECKS = {
    "static": check_static,
    "broadcaster": check_broadcaster,
    "listener": check_listener,
    "fixed_carrot": check_fixed_carrot,
    "dynamic_carrot": check_dynamic_carrot,
    "time_travel": check_time_travel,
    "faults": check_faults,
}


def test_each_lesson_has_a_check():
    assert list(CHECKS) == json.loads((LESSONS / "order.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", CHECKS)
def test_a_solution_runs_on_the_wire(name, run, workspace, turtles, tmp_path):
    path = launch_file_of(load_lesson(LESSONS / name), tmp_path)
    launch = run(ROS2, "launch", path, environment=workspace(PACKAGE))
    with TransformListener(buffer := Buffer(), turtles.node, context=turtles.context):
        CHECKS[name](Scene(turtles, buffer, launch))
    launch.end()
