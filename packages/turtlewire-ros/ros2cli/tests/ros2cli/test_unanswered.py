"""Servers that end while a command waits for them, and names and types that are not there."""

import sys

import pytest

ROS2 = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"

SERVER = """
import threading
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from std_msgs.msg import Empty as Nothing
from std_srvs.srv import Empty
rclpy.init()
node = rclpy.create_node("sleeper")
node.create_subscription(Nothing, "/heard", print, 1)
said = node.create_publisher(Nothing, "/said", 1)
def sleep(*_):
    print("called", flush=True)
    threading.Event().wait()
service = node.create_service(Empty, "/sleep", sleep)
client = node.create_client(Empty, "/called")
action = ActionServer(node, Fibonacci, "/count", sleep)
print("ready", flush=True)
rclpy.spin(node)
"""

RIGHT_SERVER = """
import rclpy
from std_srvs.srv import SetBool
rclpy.init()
node = rclpy.create_node("right")
service = node.create_service(SetBool, "/sleep", lambda _, response: response)
rclpy.spin(node)
"""


#: DDS takes ten seconds to see that a process has gone, unless the process says less.
SHORT_LEASE = {"CYCLONEDDS_URI": "<Discovery><LeaseDuration>3s</LeaseDuration></Discovery>"}


def ros2(run, *words):
    return run(sys.executable, "-c", ROS2, *words)


@pytest.fixture
def server(run):
    started = run(sys.executable, "-c", SERVER)
    started.wait_for("ready")
    return started


def test_a_killed_server_ends_the_wait(run):
    waiting = {}
    for name, words in {
        "service '/sleep'": "service call /sleep std_srvs/srv/Empty",
        "action '/count'": "action send_goal /count example_interfaces/action/Fibonacci {}",
    }.items():
        source = SERVER.replace('"sleeper"', f'"sleeper{len(waiting)}"')
        server = run(sys.executable, "-c", source, environment=SHORT_LEASE)
        server.wait_for("ready")
        waiting[name] = ros2(run, *words.split())
        server.wait_for("called")
        server.process.kill()
    for name, verb in waiting.items():
        assert verb.wait() == 1
        assert verb.text.endswith(f"The server of {name} ended before it answered")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("service call /called std_srvs/srv/SetBool",
            "The service '/called' has the type std_srvs/srv/Empty, not std_srvs/srv/SetBool"),
        ("service call /slep std_srvs/srv/Empty", "Did you mean: /sleep"),
        ("service call /qqqq std_srvs/srv/Empty", "Known services: /called, /sleep"),
        ("action send_goal /qqqq example_interfaces/action/Fibonacci {}", "Known actions: /count"),
        ("action send_goal /count turtlesim/action/RotateAbsolute {}",
            "The action '/count' has the type .*/Fibonacci, not turtlesim/.*"),
        ("topic echo /heard std_msgs/msg/String",
            "The topic '/heard' has the type std_msgs/msg/Empty, not std_msgs/msg/String"),
        ("topic pub /rosout std_msgs/msg/String",
            "The topic '/rosout' has the type rcl_interfaces/msg/Log, not std_msgs/msg/String"),
    ],
)  # fmt: skip
def test_mistakes_raise_immediately(run, server, words, told):
    ros2(run, *words.split()).wait_for(f"^{told}$")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("topic echo /said std_msgs/msg/String",
            "topic /said has the type std_msgs/msg/Empty, but this process subscribes to"),
        ("topic pub /heard std_msgs/msg/String",
            "topic /heard has the type std_msgs/msg/Empty, but this process publishes"),
    ],
)  # fmt: skip
def test_messages_that_do_not_get_through_are_told_once(run, server, words, told):
    verb = ros2(run, *words.split())
    verb.wait_for(f": {told} std_msgs/msg/String: no messages get through")
    assert verb.text.count("has the type") == 1


def test_requests_that_do_not_get_through_are_told_once(run, server):
    verb = ros2(run, "service", "call", "/sleep", "std_srvs/srv/SetBool")
    verb.wait_for(
        ": service /sleep has the type std_srvs/srv/Empty, but this process calls "
        "std_srvs/srv/SetBool: no requests get through"
    )
    run(sys.executable, "-c", RIGHT_SERVER)
    assert verb.wait() == 0
    assert verb.text.count("has the type") == 1


def test_a_rejected_goal_is_told_and_no_error_of_the_command(run):
    rejecting = SERVER.replace(
        '"/count", sleep)', '"/count", sleep, goal_callback=lambda _: GoalResponse.REJECT)'
    )
    server = run(sys.executable, "-c", f"from rclpy.action import GoalResponse\n{rejecting}")
    server.wait_for("ready")
    verb = ros2(run, "action", "send_goal", "/count", "example_interfaces/action/Fibonacci", "{}")
    assert verb.wait() == 0
    assert verb.text.splitlines()[-1] == "Goal was rejected."


def test_that_there_is_nothing_at_all_is_said(run):
    ros2(run, "service", "call", "/x", "std_srvs/srv/Empty").wait_for("^No node offers any service")


def test_a_goal_waits_no_longer_than_it_is_told(run):
    words = "action send_goal /nobody example_interfaces/action/Fibonacci {} --timeout"
    verb = ros2(run, *words.split(), "1")
    assert verb.wait() == 1
    assert verb.text.endswith("No server of the action '/nobody' came within 1 s")
    assert ros2(run, *words.split(), "-1").wait() == 2


def test_a_class_that_is_no_service(run):
    verb = ros2(run, "service", "call", "/x", "std_msgs/msg/String")
    assert verb.wait() == 1
    assert verb.text == "The service type provided is not valid, this might be a message or action"
