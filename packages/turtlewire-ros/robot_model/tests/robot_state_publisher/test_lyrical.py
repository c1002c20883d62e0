"""Changes of Lyrical's robot_state_publisher: the description from a topic, and frequencies."""

from tests.distros import lines_in

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
