"""Joint states that native code answers, without Python, on the thread that receives them."""

import signal

import pytest
from tests.needs import COMPILED_CORE
from tests.places import ROS2

from sensor_msgs.msg import JointState
from turtlewire.tf.buffer import CORE

ONE = (
    '<robot name="r"><link name="base"/><link name="tip"/><joint name="turn" type="continuous">'
    '<parent link="base"/><child link="tip"/><axis xyz="0 0 1"/></joint></robot>'
)
native_only = pytest.mark.skipif(CORE != "native", reason=COMPILED_CORE)


@pytest.fixture
def native_rig(rig):
    """Makes a Rig whose middleware has native code."""

    def make(*arguments, **parameters):
        made = rig(*arguments, **parameters)
        if made.publisher._relay is None:
            pytest.skip("this middleware has none")
        return made

    return make


def joint_state(stamp_ms, *names, position=1.0):
    message = JointState(name=list(names), position=[position] * len(names))
    message.header.stamp.sec, rest = divmod(stamp_ms, 1000)
    message.header.stamp.nanosec = rest * 1_000_000
    return message


def stamps_ms(messages):
    stamps = [message.transforms[0].header.stamp for message in messages]
    return [stamp.sec * 1000 + stamp.nanosec // 1_000_000 for stamp in stamps]


@native_only
def test_python_handles_the_first_message_of_its_kind_only(native_rig):
    rig = native_rig(ONE)
    for number in range(5):
        rig.send(joint_state(1000 + 100 * number, "turn", position=0.1 * number))
    messages = rig.transforms()
    assert stamps_ms(messages) == [1000, 1100, 1200, 1300, 1400]
    assert messages[4].transforms[0].transform.rotation.z == pytest.approx(0.19866933)
    assert rig.relayed == 4
    rig.send(joint_state(1500, "turn", "more"))
    rig.send(joint_state(1600, "turn", "more"))
    rig.send(joint_state(1700, "turn"))
    assert stamps_ms(rig.transforms()) == [1500, 1600, 1700]
    assert rig.relayed == 6


@native_only
def test_both_know_when_a_joint_was_published_last(native_rig):
    rig = native_rig(ONE)
    rig.send(joint_state(1000, "turn"))
    rig.send(joint_state(1100, "turn"))  # native
    rig.send(joint_state(1120, "turn", "more"))  # Python; `more` was never published
    rig.send(joint_state(1140, "turn", "more"))  # skipped by Python, which reports it
    rig.send(joint_state(1150, "turn"))  # native: skipped
    rig.send(joint_state(1170, "turn"))
    assert stamps_ms(rig.transforms()) == [1000, 1100, 1120, 1170]
    assert rig.relayed == 3


@native_only
def test_parameters_change_what_native_code_does(native_rig):
    rig = native_rig(ONE)
    for stamp in (1000, 1100, 1110, 1120):
        rig.send(joint_state(stamp, "turn"))
    assert rig.set_parameter("publish_frequency", 1000.0) == [True, ""]
    rig.send(joint_state(1130, "turn"))
    assert rig.set_parameter("ignore_timestamp", True) == [True, ""]
    rig.send(joint_state(1, "turn"))
    assert rig.set_parameter("frame_prefix", "a/") == [True, ""]
    rig.send(joint_state(2, "turn"))
    relayed = rig.relayed
    rig.send(joint_state(3, "turn"))
    assert rig.relayed == relayed + 1
    messages = rig.transforms()
    assert stamps_ms(messages) == [1000, 1100, 1130, 1, 2, 3]
    frames = [message.transforms[0].child_frame_id for message in messages]
    assert frames == ["tip"] * 4 + ["a/tip"] * 2


@native_only
def test_a_simulated_clock_that_moves_back(native_rig, capfd):
    rig = native_rig(ONE, use_sim_time=True)
    rig.set_clock(10 * 10**9)
    rig.send(joint_state(9000, "turn"))
    rig.send(joint_state(9100, "turn"))
    assert rig.relayed == 1
    rig.set_clock(1 * 10**9)
    rig.send(joint_state(900, "turn"))
    rig.send(joint_state(1000, "turn"))
    assert stamps_ms(rig.transforms()) == [9000, 9100, 900, 1000]
    assert rig.relayed == 2
    assert capfd.readouterr().err.count("Moved backwards in time") == 1


@native_only
def test_a_node_that_nobody_spins_publishes_nothing(native_rig):
    rig = native_rig(ONE)
    rig.executor.remove_node(rig.publisher)
    for number in range(9):
        rig._joints.publish(joint_state(1000 + 100 * number, "turn"))
    rig.executor.spin_once(timeout_sec=0.1)
    rig.executor.add_node(rig.publisher)
    rig.spin_until(lambda: rig.handled == 5)  # the depth of its subscription
    assert stamps_ms(rig.transforms()) == [1400, 1500, 1600, 1700, 1800]


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="processes cannot be stopped here")
def test_a_subscription_that_stands_still_stops_nobody(run, tmp_path):
    (tmp_path / "robot.urdf").write_text(ONE)
    package = "robot_state_publisher"
    options = ["--ros-args", "-p", "ignore_timestamp:=true"]
    node = run(ROS2, "run", package, package, "robot.urdf", *options, cwd=tmp_path)
    node.wait_for("Robot initialized")
    echo = run(ROS2, "topic", "echo", "--raw", "/tf")
    state = "{name: [turn], position: [1.0]}"
    run(ROS2, "topic", "pub", "--rate", "500", "/joint_states", "sensor_msgs/msg/JointState", state)
    echo.wait_for(r"b'", count=10)
    echo.signal_group(signal.SIGSTOP)
    try:
        other = run(ROS2, "topic", "echo", "--raw", "/tf")
        other.wait_for(r"b'", count=2000)  # many more than the publisher keeps
    finally:
        echo.signal_group(signal.SIGCONT)
    assert "Traceback" not in node.text
