"""Differences from a real robot_state_publisher: fixed faults, log lines that explain,
and changes of Lyrical.
"""

import re
import signal

import pytest
from tests.places import ROS2
from tests.programs import lines_in

from rclpy.serialization import serialize_message
from robot_state_publisher.node import StartError
from robot_state_publisher.publish_times import PublishTimes
from sensor_msgs.msg import JointState


def robot(*joints):
    links = "".join(f'<link name="{name}_link"/>' for name, _, _ in joints)
    elements = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="base"/><child link="{name}_link"/>'
        f"{inside}</joint>"
        for name, kind, inside in joints
    )
    return f'<robot name="r"><link name="base"/>{links}{elements}</robot>'


ONE = robot(("turn", "continuous", ""))


def joint_state(stamp_ms=0, **positions):
    message = JointState(name=list(positions), position=list(positions.values()))
    message.header.stamp.sec, rest = divmod(stamp_ms, 1000)
    message.header.stamp.nanosec = rest * 1_000_000
    return message


def frames(messages):
    return [[each.child_frame_id for each in message.transforms] for message in messages]


def lines(capfd, pattern):
    return re.findall(pattern, capfd.readouterr().err)


def test_a_mimic_joint_of_a_mimic_joint_moves(rig):
    # ROS 2 resolves chains only if the alphabet has their joints in the right order.
    chain = rig(
        robot(
            ("a", "continuous", '<axis xyz="0 0 1"/><mimic joint="b" multiplier="2"/>'),
            ("b", "continuous", '<mimic joint="c" offset="0.5"/>'),
            ("c", "continuous", ""),
        )
    )
    chain.send(joint_state(5000, c=1.0))
    (message,) = chain.transforms()
    assert [each.child_frame_id for each in message.transforms] == ["a_link", "b_link", "c_link"]
    rotation = message.transforms[0].transform.rotation
    assert rotation.z == pytest.approx(0.9974949866)  # sin(3 / 2)


def test_skipped_messages_are_told_once(rig, capfd):
    fast = rig(ONE)
    for number in range(10):
        fast.send(joint_state(1000 + 10 * number, turn=1.0))
    assert len(fast.transforms()) == 2  # after 0 and 50 ms
    (line,) = lines(capfd, r"\[INFO\].*Skipping joint states (.*)")
    assert line == (
        "whose stamps are less than 50 ms after the last one published, because"
        " publish_frequency is 20. To publish more of them:"
        " ros2 param set /robot_state_publisher publish_frequency 1000.0"
    )


def test_unchanged_stamps_are_reported(rig, capfd):
    stamps = rig(ONE)
    for _ in range(3):
        stamps.send(joint_state(0, turn=1.0))
    stamps.transforms()
    (line,) = lines(capfd, r"Skipping joint states (.*)")
    assert line.startswith("whose stamp, 0.000000000 s, does not advance.")
    assert line.endswith("ros2 param set /robot_state_publisher ignore_timestamp true")
    assert stamps.set_parameter("ignore_timestamp", True) == [True, ""]
    for _ in range(3):
        stamps.send(joint_state(0, turn=1.0))
    assert frames(stamps.transforms()) == [["turn_link"]] * 3


def test_zero_frequency_publishes_every_forward_stamp(rig):
    free = rig(ONE, publish_frequency=0.0)
    for stamp in (1000, 1000, 1001, 999):
        free.send(joint_state(stamp, turn=1.0))
    assert len(free.transforms()) == 3


def test_unknown_joints_are_told_after_a_while(rig, capfd):
    strange = rig(ONE)
    strange.send(joint_state(1000, elbow=1.0, wrist=2.0))
    strange.send(joint_state(1000, knee=1.0))
    text = ""

    def told():
        nonlocal text
        text += capfd.readouterr().err
        return "No joint in the joint states" in text

    strange.spin_until(told)
    assert (
        "No joint in the joint states is a moving joint of the robot 'r', so no transforms are"
        " published: received elbow, wrist, knee; its moving joints are turn." in text
    )
    strange.send(joint_state(2000, elbow=1.0))
    assert not strange.publisher._diagnosis._timer


def test_a_known_joint_ends_the_watch(rig):
    late = rig(ONE)
    late.send(joint_state(1000, elbow=1.0))
    late.send(joint_state(1000, turn=1.0))
    assert list(late.publisher.timers) == []


def test_floating_joint_is_reported(rig, capfd):
    floating = rig(robot(("drift", "floating", "")))
    (line,) = lines(capfd, r"\[INFO\].*(The joint .*)")
    assert line == (
        "The joint 'drift' is floating, so its transform is not published here; another node must"
        " publish it, from 'base' to 'drift_link'."
    )
    assert frames(floating.static) == [[]]


def test_mimic_joints_in_a_loop_are_told_and_the_rest_moves(rig, capfd):
    loop = rig(
        robot(
            ("a", "continuous", '<mimic joint="b"/>'),
            ("b", "continuous", '<mimic joint="a"/>'),
            ("c", "continuous", ""),
        )
    )
    (line,) = lines(capfd, r"\[WARN\].*(Joints mimic .*)")
    assert (
        line
        == 'Joints mimic each other in a loop: a -> b -> a (line 1 in <mimic> in <joint name="a">)'
    )
    loop.send(joint_state(1000, c=1.0))
    assert frames(loop.transforms()) == [["c_link"]]


def test_a_malformed_message_is_one_line(rig, capfd):
    damaged = rig(ONE)
    cdr = serialize_message(joint_state(1000, turn=1.0))
    damaged.send(cdr[:40])
    damaged.send(joint_state(1000, turn=1.0))
    assert frames(damaged.transforms()) == [["turn_link"]]
    (line,) = lines(capfd, r"\[ERROR\].*(Ignoring .*)")
    assert line.startswith("Ignoring malformed sensor_msgs/msg/JointState:")


def test_a_refused_description_changes_nothing(rig):
    steady = rig(ONE)
    broken = ONE.replace("</robot>", '<link name="base"/></robot>')
    refused = [False, "Unable to initialize urdf::model from robot description"]
    assert steady.set_parameter("robot_description", broken) == refused
    steady.send(joint_state(1000, turn=1.0))
    assert frames(steady.transforms()) == [["turn_link"]]
    assert len(steady.descriptions) == 1


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ({"publish_frequency": -1.0}, "publish_frequency must be between 0 and 1000"),
        (
            {"frame_prefix": 3},
            "parameter {frame_prefix} is of type {string}, setting it to {integer}",
        ),
    ],
)
def test_wrong_parameters(rig, parameters, text):
    with pytest.raises(StartError) as caught:
        rig(ONE, **parameters)
    assert text in str(caught.value)


def test_names_that_a_peer_invents_are_forgotten():
    times = PublishTimes()
    for number in range(30_000):
        times.published((f"joint_{number}",), 1)
    assert len(times._times) <= 10_001


def test_times_of_joints_in_different_messages():
    times = PublishTimes()
    arm, both = ("a", "b"), ("b", "c")
    assert times.earliest(arm, 100) == 0
    times.published(arm, 50)
    assert times.earliest(arm, 100) == 50
    assert times.earliest(arm, 40) == 40  # a stamp in the future does not count
    assert times.earliest(both, 100) == 0
    times.published(both, 60)
    assert times.earliest(arm, 100) == 50
    assert times.earliest(both, 100) == 60
    times.clear()
    assert times.earliest(both, 100) == 0


# `ros2 run robot_state_publisher robot_state_publisher`, seen from outside.


URDF = """<robot name="r">
  <link name="base"/><link name="arm"/><link name="tool"/>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="arm"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="tip" type="fixed">
    <parent link="arm"/><child link="tool"/><origin xyz="0 0 2"/>
  </joint>
</robot>"""
STATE = "{header: {stamp: {sec: 10}}, name: [turn], position: [0.0]}"


def test_from_joint_state_to_transform(run, tmp_path):
    (tmp_path / "robot.urdf").write_text(URDF)
    package = "robot_state_publisher"
    publisher = run(
        *(ROS2, "run", package, package, "robot.urdf", "--ros-args", "-p", "frame_prefix:=r1_"),
        *("-p", "ignore_timestamp:=true"),
        cwd=tmp_path,
    )
    publisher.wait_for("Robot initialized")
    run(ROS2, "topic", "pub", "--rate", "20", "/joint_states", "sensor_msgs/msg/JointState", STATE)
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "r1_base", "r1_tool")
    echo.wait_for(r"Translation: \[1\.000, 0\.000, 2\.000\]")
    description = run(ROS2, "topic", "echo", "--once", "--full-length", "/robot_description")
    description.wait_for("robot name")
    publisher.signal_group(signal.SIGINT)
    assert publisher.wait() == 0
    assert publisher.survivors() == []
    assert "Traceback" not in publisher.text


def test_help(run):
    program = run(ROS2, "run", "robot_state_publisher", "robot_state_publisher", "--help")
    assert program.wait() == 0
    assert "ignore_timestamp" in program.text


START = """
import rclpy
from rclpy.parameter import Parameter
from robot_state_publisher import RobotStatePublisher
rclpy.init()
URDF = '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="fixed">' \\
    '<parent link="a"/><child link="b"/></joint></robot>'
def start(**parameters):
    overrides = [Parameter(name, value=value) for name, value in parameters.items()]
    try:
        return RobotStatePublisher(parameter_overrides=overrides, urdf_file=__file__)
    except RuntimeError as error:
        print(error)
"""

FREQUENCIES = """
start(robot_description=URDF, publish_frequency=0.0)
start(robot_description=URDF, publish_frequency=1000.1)
node = start(robot_description=URDF, publish_frequency=1000.0)
for value in (0.0, 1000.5, 0.1):
    (result,) = node.set_parameters([Parameter("publish_frequency", value=value)])
    print(result.successful, result.reason)
"""

TOPIC = """
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
node = start(use_robot_description_topic=True)
print(node.has_parameter("robot_description"), node.count_publishers("/robot_description"))
node.get_logger().error = lambda text, *_, **__: print("told:", text)
other = rclpy.create_node("other")
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
executor = SingleThreadedExecutor()
executor.add_node(node)
executor.add_node(other)
got = []
other.create_subscription(TFMessage, "/tf_static", got.append, latched)
publisher = other.create_publisher(String, "robot_description", latched)
for text in ("<robot/>", URDF, URDF.replace('"b"', '"c"')):
    count = len(got)
    publisher.publish(String(data=text))
    executor.spin_once(60)
    while text != "<robot/>" and len(got) == count:
        executor.spin_once(60)
    print([each.child_frame_id for message in got for each in message.transforms])
print(node.robot.root)
"""


def test_frequencies_are_more_than_zero_in_lyrical():
    assert lines_in("lyrical", START.replace("__file__", "''") + FREQUENCIES) == [
        "publish_frequency must be between 0 (exclusive) and 1000",
        "publish_frequency must be between 0 (exclusive) and 1000",
        "False publish_frequency must be between 0.0 (exclusive) and 1000.0",
        "False publish_frequency must be between 0.0 (exclusive) and 1000.0",
        "True ",
    ]


def test_a_file_is_no_description_in_lyrical(tmp_path):
    program = "START\nstart()".replace("START", START)
    program = f"__file__ = {str(tmp_path)!r}\n{program}"
    assert lines_in("lyrical", program) == ["robot_description parameter must not be empty"]
    assert lines_in("kilted", program) == [f"Failed to open URDF file: {tmp_path}: Is a directory"]


def test_the_description_from_a_topic():
    shown = lines_in("lyrical", START.replace("__file__", "''") + TOPIC)
    assert shown[0] == "False 0"
    assert shown[1].startswith("told: Failed to parse robot description from topic: ")
    assert shown[2:4] == ["[]", "['b']"]
    assert shown[4].endswith("'c']")
    assert shown[5] == "a"


def test_up_to_kilted_there_is_no_such_parameter():
    program = "node = start(robot_description=URDF)\n"
    program += "print(node.has_parameter('use_robot_description_topic'))"
    assert lines_in("kilted", START.replace("__file__", "''") + program) == ["False"]
