"""Faults of transforms in a simulation, programs started by their main, and late beginnings."""

import re
import sys
from types import SimpleNamespace

import pytest
from tests.places import ROOT

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.serialization import serialize_message
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener
from turtlesim.testing import Simulation
from turtlesim.testing.faults import (
    Delay,
    FaultyTransforms,
    Loss,
    MissingStatic,
    TwoPublishers,
    WrongFrame,
    WrongTime,
)
from turtlesim.testing.programs import ProgramError
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.tf_findings import tf_findings
from turtlewire.doctor.tf_traffic import TfListener

VERBATIM = ROOT / "tests" / "tutorial" / "verbatim" / "learning_tf2_py" / "learning_tf2_py"
TICK_S = 0.016


class Broadcaster(Node):
    """Tells once a tick where `robot` is: at x = seconds."""

    def __init__(self):
        super().__init__("broadcaster")
        self.broadcaster = TransformBroadcaster(self)
        self.fixed = StaticTransformBroadcaster(self)
        self.fixed.sendTransform(self.transform("robot", "camera", 0.5))
        self.create_timer(TICK_S, self.send)

    def transform(self, parent, child, x):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id, t.child_frame_id = parent, child
        t.transform.translation.x = x
        t.transform.rotation.w = 1.0
        return t

    def send(self):
        seconds = self.get_clock().now().nanoseconds / 1e9
        self.broadcaster.sendTransform(self.transform("world", "robot", seconds))
        self.broadcaster.sendTransform(self.transform("world", "other", seconds))


class Scene:
    """A simulation with a buffer and, once :meth:`start` was called, the broadcaster."""

    def __init__(self, simulation):
        self.simulation = simulation
        listener = simulation.start(lambda: Node("listener"))
        self.buffer = Buffer()
        self._listener = TransformListener(self.buffer, listener)

    def start(self):
        self.simulation.start(Broadcaster)

    def x_of(self, frame):
        found = self.buffer.lookup_transform("world", frame, Time())
        return found.transform.translation.x, found.header.stamp

    def doctor(self):
        """What the doctor finds in two simulated seconds."""
        wire = self.simulation.node.context.wire
        listener = TfListener(wire)
        self.simulation.run(2.0)
        found = [*graph_findings(wire.graph), *tf_findings(wire.graph, listener.close())]
        return "\n".join(finding.text for finding in found)


@pytest.fixture
def scene():
    with Simulation(begin=20.0) as simulation:
        yield Scene(simulation)


def test_without_a_fault_all_is_well(scene):
    scene.start()
    scene.simulation.run(5.0)
    assert scene.x_of("robot")[0] == pytest.approx(scene.simulation.now, abs=2 * TICK_S)
    assert scene.doctor() == ""


def test_simulated_time_may_begin_later(scene):
    assert scene.simulation.now == pytest.approx(20.0)
    assert scene.simulation.node.get_clock().now().nanoseconds == 20_000_000_000


def test_a_delay_is_as_long_as_it_says_and_ends_when_faults_are_cleared(scene):
    scene.start()
    scene.simulation.inject(Delay(3.0, "robot"))
    scene.simulation.run(5.0)
    now = scene.simulation.now
    assert scene.x_of("robot")[0] == pytest.approx(now - 3.0, abs=2 * TICK_S)
    assert scene.x_of("other")[0] == pytest.approx(now, abs=2 * TICK_S)
    assert "The newest transform of 'robot' is 3.0 s old." in scene.doctor()
    scene.simulation.clear_faults()
    scene.simulation.run(0.1)
    assert scene.x_of("robot")[0] == pytest.approx(scene.simulation.now, abs=2 * TICK_S)


def test_loss_loses_its_share_and_the_same_ones_each_time():
    heard = []
    for _ in range(2):
        with Simulation() as simulation:
            scene = Scene(simulation)
            scene.start()
            simulation.inject(Loss(0.75, "robot"))
            xs = set()
            for _ in range(400):
                simulation.step()
                if scene.buffer.can_transform("world", "robot", Time()):
                    xs.add(scene.x_of("robot")[0])
            heard.append(xs)
    assert heard[0] == heard[1]
    assert 60 < len(heard[0]) < 140


def test_loss_is_found_with_its_share_and_rhythm(scene):
    scene.start()
    scene.simulation.inject(Loss(0.8, "robot"))
    assert re.fullmatch(
        r"About [78]\d% of the transforms of 'robot' are missing: expected every 16 ms, "
        r"longest gap 0\.\d\d s\.",
        scene.doctor(),
    )


def test_loss_rejects_a_share_outside_0_to_1():
    with pytest.raises(ValueError, match="from 0 to 1, not 90"):
        Loss(90)


def test_a_wrong_frame_makes_two_trees(scene):
    scene.start()
    scene.simulation.inject(WrongFrame("robot", "wolrd"))
    scene.simulation.run(1.0)
    assert "2 separate trees, with the roots" in scene.doctor()
    assert not scene.buffer.can_transform("world", "robot", Time())


@pytest.mark.parametrize(("offset", "text"), [(5.0, "5.0 s in the future"), (-5.0, "5.0 s old")])
def test_a_wrong_time_is_found(scene, offset, text):
    scene.start()
    scene.simulation.inject(WrongTime(offset, "robot"))
    scene.simulation.run(1.0)
    x, stamp = scene.x_of("robot")
    assert stamp.sec + stamp.nanosec / 1e9 == pytest.approx(x + offset)
    assert f"The newest transform of 'robot' is {text}." in scene.doctor()


def test_stamps_end_at_zero():
    with Simulation() as simulation:
        scene = Scene(simulation)
        scene.start()
        simulation.inject(WrongTime(-5.0))
        simulation.run(1.0)
        assert scene.x_of("robot")[1].sec == 0


def test_a_missing_static_frame_is_missing_also_for_those_who_come_later(scene):
    scene.simulation.inject(MissingStatic("camera"))
    scene.start()
    scene.simulation.run(1.0)
    assert "camera" not in scene.buffer.all_frames_as_yaml()
    assert "No static transforms received from /broadcaster." in scene.doctor()
    assert "camera" not in Scene(scene.simulation).buffer.all_frames_as_yaml()


def test_two_publishers_are_named_and_end_when_faults_are_cleared(scene):
    scene.start()
    scene.simulation.inject(TwoPublishers("robot", x=-5.0))
    said = scene.doctor()
    assert "The frame 'robot' is published by /broadcaster and /second_broadcaster." in said
    assert "leaps by up to" in said
    scene.simulation.clear_faults()
    assert scene.doctor() == ""


def test_faults_add_up(scene):
    scene.start()
    scene.simulation.inject(Delay(1.0))
    scene.simulation.inject(Delay(1.0))
    scene.simulation.inject(Loss(1.0, "other"))
    scene.simulation.run(4.0)
    assert scene.x_of("robot")[0] == pytest.approx(scene.simulation.now - 2.0, abs=2 * TICK_S)
    assert "other" not in scene.buffer.all_frames_as_yaml()


def test_messages_that_are_late_for_a_closed_publisher_are_dropped(scene):
    node = scene.simulation.start(Broadcaster)
    scene.simulation.inject(Delay(1.0))
    scene.simulation.run(0.5)
    scene.simulation.remove(node)
    scene.simulation.run(2.0)
    assert "other" not in scene.buffer.all_frames_as_yaml()


# Programs


@pytest.fixture
def printed(monkeypatch):
    """The document's two files as modules."""
    monkeypatch.syspath_prepend(str(VERBATIM))
    names = ("turtle_tf2_broadcaster", "turtle_tf2_listener")
    yield [__import__(name) for name in names]
    for name in names:
        sys.modules.pop(name, None)


def test_the_documents_files_run_by_their_main(printed):
    broadcaster, listener = printed
    with Simulation() as simulation:
        simulation.spawn("turtle2", x=4.0, y=2.0)
        for turtle in ("turtle1", "turtle2"):
            (node,) = simulation.start_program(
                broadcaster.main, name=f"{turtle}_broadcaster", turtlename=turtle
            )
            assert node.get_name() == f"{turtle}_broadcaster"
        simulation.start_program(listener.main)
        simulation.run(15.0)
        assert simulation.distance("turtle1", "turtle2") < 0.1
    assert not rclpy.ok()


def test_a_program_gets_its_command_line_and_may_spin_an_executor():
    seen = []

    def main():
        seen.append(sys.argv[1:])
        with rclpy.init():
            executor = SingleThreadedExecutor()
            executor.add_node(Node("one"))
            executor.add_node(Node("two"))
            executor.spin()

    with Simulation() as simulation:
        nodes = simulation.start_program(main, "a", "b")
        assert sorted(node.get_name() for node in nodes) == ["one", "two"]
        assert seen == [["a", "b"]]
        simulation.run(0.1)


@pytest.mark.parametrize(
    ("main", "text"),
    [
        (lambda: None, "did not spin a node"),
        (lambda: sys.exit("usage: …"), "main\\(\\) ended the program: usage"),
        (lambda: rclpy.spin_once(Node("n")), "rclpy.spin_once cannot wait here"),
    ],
)
def test_a_program_that_cannot_take_part_says_why(main, text):
    with Simulation() as simulation, pytest.raises(ProgramError, match=text) as error:
        simulation.start_program(main)
    assert error.value.hint


def test_an_error_of_main_comes_through_and_rclpy_is_as_before():
    spin = rclpy.spin

    def main():
        raise ZeroDivisionError

    with Simulation() as simulation, pytest.raises(ZeroDivisionError):
        simulation.start_program(main)
    assert rclpy.spin is spin


@pytest.mark.parametrize(("steps", "arrived"), [(9, 0), (10, 1), (11, 1)])
def test_a_delay_ends_with_its_last_step(steps, arrived):
    """The sum of ten tenths is a little less than 1."""
    got, faulty = [], FaultyTransforms(SimpleNamespace(tamper=None))
    sender = SimpleNamespace(topic="/tf", deliver=got.append)
    faulty.faults.append(Delay(1.0))
    cdr = serialize_message(TFMessage(transforms=[TransformStamped()]))
    faulty._tamper(sender, (cdr, None))
    faulty.advance(sum([0.1] * steps))
    assert len(got) == arrived
