"""The solutions run unchanged by `ros2 launch`, with the launch files that students get."""

import math
import signal
import threading

import pytest
from tests.places import ROS2

from turtle_class import commands
from turtle_class.catalogue import chosen
from turtlewire import Buffer, msg
from turtlewire.tf.listener import TransformListener
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

from .conftest import solve

POSE = "turtlesim/msg/Pose"
MINUTE_NS = 60_000_000_000
#: Of each exercise: target, source, and where turtle1 and turtle2, as (x, y, theta), put it.
LINKS = {
    "camera": [("turtle1", "camera", lambda one, two: (0.2, 0.0))],
    "odometry": [
        ("world", "turtle1/base_link", lambda one, two: one[:2]),
        ("world", "turtle2/base_link", lambda one, two: two[:2]),
    ],
    "find_the_fault": [("world", "turtle2", lambda one, two: one[:2])],  # it has followed
    "meeting_point": [
        ("world", "meeting_point", lambda one, two: ((one[0] + two[0]) / 2, (one[1] + two[1]) / 2))
    ],
}
HAS_TWO = [name for name in LINKS if name != "camera"]


class Wire:
    """Collects the messages of the exercise's nodes."""

    def __init__(self):
        self.context = open_context()
        self.node = self.context.create_node("looker")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self.node, context=self.context)
        self.poses = {}
        self.more = threading.Condition()
        for name in ("turtle1", "turtle2"):
            self.watch(name)

    def watch(self, name):
        def take(cdr, _):
            pose = msg.deserialize(msg.get_message(POSE), cdr)
            with self.more:
                self.poses[name] = (pose.x, pose.y, pose.theta)
                self.more.notify_all()

        self.node.create_subscription(
            f"/{name}/pose", TypeId(POSE, msg.type_hash(POSE)), QoS(), take
        )

    def wait_for(self, condition):
        """Wait until the condition holds; it is checked at each pose."""
        with self.more:
            assert self.more.wait_for(condition, 120), self.poses

    def is_there(self, target, source, place):
        if not self.buffer.can_transform(target, source):
            return False
        found = self.buffer.lookup_transform(target, source).translation
        wanted = place(self.poses["turtle1"], self.poses.get("turtle2"))
        return math.dist(found[:2], wanted) < 0.6

    def close(self):
        self.listener.close()
        self.context.close()


@pytest.fixture
def wire():
    wire = Wire()
    yield wire
    wire.close()


@pytest.mark.slow
@pytest.mark.parametrize("name", LINKS)
def test_the_solution_runs_by_ros2_launch(name, run, wire, tmp_path):
    commands.start(tmp_path, [name])
    solve(chosen([name])[0], tmp_path / name)
    environment = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
    launch = run(ROS2, "launch", tmp_path / name / "exercise.launch.py", environment=environment)
    wire.wait_for(lambda: len(wire.poses) == 1 + (name in HAS_TWO))
    for target, source, place in LINKS[name]:
        wire.wait_for(lambda: wire.is_there(target, source, place))  # noqa: B023
    launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0, launch.text
    assert launch.survivors() == []
    assert "Traceback" not in launch.text


def test_each_launch_file_is_python_and_names_each_program(tmp_path):
    commands.start(tmp_path, [])
    for exercise in chosen([]):
        text = (tmp_path / exercise.name / "exercise.launch.py").read_text(encoding="utf-8")
        compile(text, exercise.name, "exec")
        assert all(f'str(HERE / "{file}")' in text for file in exercise.files), exercise.name
        assert max(map(len, text.splitlines())) <= 100
