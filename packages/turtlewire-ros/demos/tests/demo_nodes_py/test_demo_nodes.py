"""ROS 2's demo and example nodes, started as their tutorials say."""

from __future__ import annotations

import signal
import sys
from itertools import groupby

import pytest

from geometry_msgs.msg import Twist, TwistStamped

FIBONACCI = r"array\('i', \[0, 1, 1, 2, 3, 5, 8, 13, 21, 34, 55\]\)"


def end(program) -> None:
    program.signal_group(signal.SIGINT)
    assert program.wait() == 0
    assert "Traceback" not in program.text


def test_talker_and_listener(start):
    listener = start("demo_nodes_py", "listener")
    talker = start("demo_nodes_py", "talker")
    talker.wait_for(r'^\[INFO\] \[[\d.]+\] \[talker\]: Publishing: "Hello World: 0"$')
    listener.wait_for(r"^\[INFO\] \[[\d.]+\] \[listener\]: I heard: \[Hello World: \d\]$")
    end(talker)
    end(listener)


def test_a_best_effort_talker_and_its_listener(start):
    listener = start("demo_nodes_py", "listener_qos", "-n", "2")
    talker = start("demo_nodes_py", "talker_qos")
    listener.wait_for(r"\[listener_qos\]: Best effort listener")
    talker.wait_for(r"\[talker_qos\]: Best effort talker")
    listener.wait_for(r"\[listener_qos\]: I heard: \[Hello World: \d+\]", count=2)
    assert listener.wait() == 0
    end(talker)


@pytest.mark.parametrize(
    "client",
    [("demo_nodes_py", "add_two_ints_client"), ("demo_nodes_py", "add_two_ints_client_async")],
)
def test_the_demo_service(start, client):
    server = start("demo_nodes_py", "add_two_ints_server")
    asked = start(*client)
    asked.wait_for(r"\[add_two_ints_client\]: Result of add_two_ints: 5$")
    assert asked.wait() == 0
    server.wait_for("^a: 2 b: 3$")
    end(server)


@pytest.mark.parametrize("style", ["member_function", "local_function", "old_school"])
def test_minimal_publishers(start, style):
    publisher = start("examples_rclpy_minimal_publisher", f"publisher_{style}")
    publisher.wait_for(r'\[minimal_publisher\]: Publishing: "Hello World: 1"$')
    end(publisher)


@pytest.mark.parametrize("style", ["member_function", "lambda", "old_school"])
def test_minimal_subscribers(start, style):
    subscriber = start("examples_rclpy_minimal_subscriber", f"subscriber_{style}")
    publisher = start("examples_rclpy_minimal_publisher", "publisher_member_function")
    subscriber.wait_for(r'\[minimal_subscriber\]: I heard: "Hello World: \d+"$')
    end(publisher)
    end(subscriber)


@pytest.mark.parametrize("service", ["service", "service_member_function"])
def test_minimal_service_and_clients(start, service):
    server = start("examples_rclpy_minimal_service", service)
    for client in (
        "client",
        "client_async",
        "client_async_callback",
        "client_async_member_function",
    ):
        asked = start("examples_rclpy_minimal_client", client)
        asked.wait_for("Result of add_two_ints: for 41 \\+ 1 = 42$")
        assert asked.wait() == 0
    own = start("examples_rclpy_minimal_client", "client_async_member_function", "2", "3")
    own.wait_for("Result of add_two_ints: for 2 \\+ 3 = 5$")
    server.wait_for(r"\[minimal_service\]: Incoming request$", count=5)
    end(server)


@pytest.mark.parametrize(
    "client",
    [
        ("demo_nodes_py", "add_two_ints_client"),
        ("examples_rclpy_minimal_client", "client"),
        ("examples_rclpy_minimal_client", "client_async_callback"),
    ],
)
def test_ctrl_c_ends_the_wait_for_a_service(start, client):
    waiting = start(*client)
    waiting.wait_for("service not available, waiting again...$")
    end(waiting)


def test_minimal_action(start):
    server = start("examples_rclpy_minimal_action_server", "server")
    cancelling = start("examples_rclpy_minimal_action_client", "client_cancel")
    cancelling.wait_for(r"\[minimal_action_client\]: Goal successfully canceled$")
    assert cancelling.wait() == 0
    server.wait_for(r"\[minimal_action_server\]: Goal canceled$")
    end(server)


HURRIED = """
import time
time.sleep = lambda _: None  # the server waits a second before each number
from examples_rclpy_minimal_action_server.server import main
main()
"""


def test_minimal_action_result(start, run):
    server = run(sys.executable, "-c", HURRIED)
    asking = start("examples_rclpy_minimal_action_client", "client")
    asking.wait_for(rf"\[minimal_action_client\]: Goal succeeded! Result: {FIBONACCI}$")
    assert asking.wait() == 0
    end(server)


def velocity_of(message) -> tuple[float, float, float]:
    twist = message.twist if isinstance(message, TwistStamped) else message
    return round(twist.linear.x, 3), round(twist.linear.y, 3), round(twist.angular.z, 3)


def velocities_of(messages) -> list[tuple[float, float, float]]:
    return [velocity for velocity, _ in groupby(map(velocity_of, messages))]


@pytest.mark.parametrize("stamped", [False, True])
def test_teleop_keys_are_velocities_and_the_end_is_a_stop(start, listening, stamped):
    options = ["-p", "stamped:=true", "-p", "frame_id:=base"] if stamped else []
    messages = listening(TwistStamped if stamped else Twist, "cmd_vel")
    teleop = start(
        "teleop_twist_keyboard", "teleop_twist_keyboard", "--ros-args", *options, terminal=True
    )
    teleop.wait_for("^CTRL-C to quit$")
    teleop.wait_for("^currently:\tspeed 0.5\tturn 1.0 $")
    while not messages.wait_until(bool, timeout=1):  # until both sides know each other
        teleop.type("k")
    teleop.type("qJu")
    teleop.wait_for("^currently:\tspeed 0.55\\d*\tturn 1.1")
    driven = [(0, 0, 0), (0, 0.55, 0), (0.55, 0, 1.1)]
    # Ctrl-C discards what was typed and is not read yet.
    assert messages.wait_until(lambda got: velocities_of(got) == driven), messages.got
    teleop.type("\x03")
    assert teleop.wait() == 0
    expected = [*driven, (0, 0, 0)]
    assert messages.wait_until(lambda got: velocities_of(got) == expected), messages.got
    if stamped:
        assert {message.header.frame_id for message in messages.got} == {"base"}


def test_teleop_needs_a_terminal_and_stamps_for_a_frame(start):
    without = start("teleop_twist_keyboard", "teleop_twist_keyboard")
    without.wait_for("reads keys from a terminal")
    assert without.wait() == 1
    unstamped = start(
        "teleop_twist_keyboard", "teleop_twist_keyboard", "--ros-args", "-p", "frame_id:=base",
        terminal=True,
    )  # fmt: skip
    unstamped.wait_for("'frame_id' can only be set when 'stamped' is True")
    assert unstamped.wait() == 1
