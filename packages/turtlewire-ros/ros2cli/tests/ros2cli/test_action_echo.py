"""`ros2 action find` and `ros2 action echo` with a server and a client."""

import sys

import pytest
import yaml
from tests.programs import offered

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.qos import qos_profile_services_default
from rclpy.service_introspection import ServiceIntrospectionState
from ros2action.verb.echo import ActionInterfaces
from ros2cli.main import main

ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)
SERVER = """
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
rclpy.init()
node = rclpy.create_node("counter")
def count(goal):
    goal.publish_feedback(Fibonacci.Feedback(sequence=range(200)))
    goal.succeed()
    return Fibonacci.Result(sequence=[0, 1])
server = ActionServer(node, Fibonacci, "count", count)
print("ready", flush=True)
rclpy.spin(node)
"""


@pytest.fixture
def server(run):
    run(sys.executable, "-c", SERVER).wait_for("ready")


@pytest.fixture
def count_to(server):
    """Send a goal and wait for its result, after a subscription to the topic has come."""
    with rclpy.init(args=[]) as context:
        node = rclpy.create_node("customer")
        client = ActionClient(node, Fibonacci, "count")
        client._goal_client.configure_introspection(
            node.get_clock(), qos_profile_services_default, ServiceIntrospectionState.CONTENTS
        )

        def send(order, topic=None):
            own = topic in ("/count/_action/status", "/count/_action/feedback")
            assert topic is None or context.wait_for_graph(
                lambda: node.count_subscribers(topic) == 1 + own, 60_000_000_000
            )
            assert client.wait_for_server(60)
            future = client.send_goal_async(Fibonacci.Goal(order=order))
            rclpy.spin_until_future_complete(node, future, timeout_sec=60)
            result = future.result().get_result_async()
            rclpy.spin_until_future_complete(node, result, timeout_sec=60)
            return result.result().status

        yield send
        client.destroy()


def blocks(text):
    """Return the interface and the YAML of each message that was printed."""
    parts = [part.strip("\n") for part in (text + "\n").split("---\n")]
    heads = [part.partition("\n") for part in parts if part]
    return [(head.removeprefix("interface: "), yaml.safe_load(rest)) for head, _, rest in heads]


def test_names_of_a_type(server, capsys):
    assert main(["action", "find", "example_interfaces/action/Fibonacci"]) == 0
    assert main(["action", "find", "example_interfaces/action/Fibonacci", "-c"]) == 0
    assert main(["action", "find", "turtlesim/action/RotateAbsolute"]) == 0
    assert capsys.readouterr() == ("/count\n1\n", "")
    assert main(["action", "find", "turtlesim/action/RotatAbsolute", "--count-actions"]) == 0
    near = "Did you mean: turtlesim/action/RotateAbsolute\n"
    assert capsys.readouterr() == ("0\n", near)


def test_messages_of_all_interfaces(run, count_to):
    echo = run(*ROS2, "action", "echo", "/count")
    assert count_to(5, "/count/_action/status") == 4
    echo.wait_for("^  status: 4$")
    echo.wait_for("^interface: FEEDBACK_TOPIC$")
    echo.wait_for("  event_type: RESPONSE_RECEIVED")
    echo.process.terminate()
    echo.wait()
    found = blocks(echo.text)
    events = [value for name, value in found if name == "GOAL_SERVICE"]
    assert [event["info"]["event_type"] for event in events] == [
        "REQUEST_SENT",
        "RESPONSE_RECEIVED",
    ]
    assert [event["request"] and event["request"][0]["goal"] for event in events] == [
        {"order": 5},
        [],
    ]
    assert [event["response"] and event["response"][0]["accepted"] for event in events] == [
        [],
        True,
    ]
    assert {name for name, _ in found} == {"GOAL_SERVICE", "FEEDBACK_TOPIC", "STATUS_TOPIC"}
    (feedback,) = (value for name, value in found if name == "FEEDBACK_TOPIC")
    assert feedback["feedback"]["sequence"] == [*range(128), "..."]


def test_only_the_interfaces_that_are_asked_for(run, count_to):
    words = ("-i", "FEEDBACK_TOPIC | CANCEL_SERVICE", "--csv", "-l", "3")
    echo = run(*ROS2, "action", "echo", "count", "example_interfaces/action/Fibonacci", *words)
    count_to(5, "/count/_action/feedback")
    (line,) = echo.wait_for("_TOPIC|_SERVICE")
    assert line.string.startswith("FEEDBACK_TOPIC,")
    assert line.string.endswith(",0,1,2,...")
    assert len(echo.text.splitlines()) == 1


def test_a_reader_of_an_action_that_ends_early_is_no_error(run, count_to):
    command = f"{sys.executable} -c '{ROS2[2]}' action echo /count -i FEEDBACK_TOPIC | head -1"
    reader = run("bash", "-c", command)
    count_to(5, "/count/_action/feedback")
    reader.wait_for("^interface: FEEDBACK_TOPIC$")
    count_to(5)  # the first line ends `head`; now at the latest a message finds the pipe closed
    assert reader.wait() == 0
    assert reader.text == "interface: FEEDBACK_TOPIC"


@pytest.mark.parametrize(
    ("words", "told", "hint"),
    [
        ("/none", "Cannot find type for '/none'", ""),
        ("/count -i=", "Input action interface name is empty.", ""),
        (
            "/count -i FEEDBACK_TOPIC|STATE_TOPIC",
            '"STATE_TOPIC" is incorrect interface name.',
            "Did you mean: STATUS_TOPIC",
        ),
        (
            "/count -i xyz",
            '"xyz" is incorrect interface name.',
            f"Interfaces: {', '.join(ActionInterfaces.__members__)}",
        ),
        (
            "/count turtlesim/action/RotatAbsolute",
            "The action name '/count' is invalid",
            "Did you mean: turtlesim/action/RotateAbsolute",
        ),
        (
            "/count qq/action/Zzz",
            "The action name '/count' is invalid",
            "There is no action type 'qq/action/Zzz'",
        ),
    ],
)
def test_wrong_words(capsys, words, told, hint):
    assert main(["action", "echo", *words.split()]) == 1
    assert capsys.readouterr() == ("", f"{told}\n{hint}\n" if hint else f"{told}\n")


def test_a_name_that_is_near(server, capsys):
    assert main(["action", "echo", "/coumt"]) == 1
    assert capsys.readouterr().err == "Cannot find type for '/coumt'\nDid you mean: /count\n"


def test_an_action_without_a_server_is_told_of(run):
    words = ("/nothing", "example_interfaces/action/Fibonacci", "-i", "STATUS_TOPIC")
    echo = run(*ROS2, "action", "echo", *words)
    echo.wait_for("^No publishers on '/nothing/_action/status'; is a server of the action running")


def test_completion():
    assert offered("ros2 action ec") == {"echo"}
    assert offered("ros2 action find example_interfaces/action/Fib") == {
        "example_interfaces/action/Fibonacci"
    }
