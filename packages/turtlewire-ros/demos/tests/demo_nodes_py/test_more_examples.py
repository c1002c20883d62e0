"""The examples of executors, guard conditions and point clouds, and the rest of demo_nodes_py."""

from __future__ import annotations

import signal
import sys

import pytest
from tests.places import ROS2

import rclpy
from rcl_interfaces.srv import SetParameters
from rclpy.executors import ExternalShutdownException
from sensor_msgs.msg import PointCloud2

EXECUTABLES = {
    "demo_nodes_py": (
        "add_two_ints_client add_two_ints_client_async add_two_ints_server async_param_client"
        " introspection_client introspection_service listener listener_qos listener_serialized"
        " matched_event_detect set_parameters_callback talker talker_qos use_logger_service"
    ),
    "examples_rclpy_executors": (
        "callback_group composed custom_callback_group custom_executor listener talker"
    ),
    "examples_rclpy_guard_conditions": "trigger_guard_condition",
    "examples_rclpy_minimal_action_client": (
        "client client_asyncio client_cancel client_not_composable"
    ),
    "examples_rclpy_minimal_action_server": (
        "server server_defer server_not_composable server_queue_goals server_single_goal"
    ),
    "examples_rclpy_minimal_client": (
        "client client_async client_async_callback client_async_member_function"
    ),
    "examples_rclpy_pointcloud_publisher": "pointcloud_publisher",
}
BLACKBOARD = """
import rclpy
rclpy.init()
node = rclpy.create_node("parameter_blackboard", allow_undeclared_parameters=True)
rclpy.spin(node)
"""


def wait_for_parameters_of(name):
    with rclpy.init():
        client = rclpy.create_node("waiting").create_client(SetParameters, f"{name}/set_parameters")
        assert client.wait_for_service(60)


def end(program) -> None:
    program.signal_group(signal.SIGINT)
    assert program.wait() == 0
    assert "Traceback" not in program.text


@pytest.mark.parametrize("package", sorted(EXECUTABLES))
def test_ros2_knows_the_executables(package, run):
    program = run(ROS2, "pkg", "executables", package)
    assert program.wait() == 0
    wanted = [f"{package} {name}" for name in EXECUTABLES[package].split()]
    assert program.text.split("\n")[: len(wanted)] == wanted


@pytest.mark.parametrize(
    ("executable", "talker"),
    [("composed", "talker"), ("callback_group", "double_talker"), ("custom_executor", "talker")],
)
def test_a_process_that_talks_and_listens(start, executable, talker):
    program = start("examples_rclpy_executors", executable)
    program.wait_for(rf'\[{talker}\]: Publishing: "Hello World: 0"$')
    program.wait_for(r'\[listener\]: I heard: "Hello World: \d"$')
    end(program)


def test_an_emergency_stop_is_heard(start, run):
    program = start("examples_rclpy_executors", "custom_executor")
    run(ROS2, "topic", "pub", "/estop", "std_msgs/msg/String", "{data: now}")
    program.wait_for(r"\[estopper\]: I heard: now$")
    end(program)


def test_talker_and_listener_of_the_executors(start):
    listener = start("examples_rclpy_executors", "listener")
    talker = start("examples_rclpy_executors", "talker")
    listener.wait_for(r'\[listener\]: I heard: "Hello World: \d"$')
    end(talker)
    end(listener)


def test_a_callback_group_of_ones_own(start):
    program = start("examples_rclpy_executors", "custom_callback_group")
    program.wait_for(r'\[intermittent_talker\]: Publishing: "Hello World: 10"$')
    end(program)


def test_a_guard_condition(start):
    program = start("examples_rclpy_guard_conditions", "trigger_guard_condition")
    assert program.wait() == 0
    assert program.text.count("guard callback called") == 2


def test_a_cloud(run, start):
    program = start("examples_rclpy_pointcloud_publisher", "pointcloud_publisher")
    found = []
    with rclpy.init():
        node = rclpy.create_node("cloud_rig")
        node.create_subscription(PointCloud2, "test_cloud", found.append, 1)
        try:
            while not found:
                rclpy.spin_once(node)
        except ExternalShutdownException:
            pytest.fail("the context was shut down")
    cloud = found[0]
    assert (cloud.header.frame_id, cloud.width, cloud.point_step) == ("map", 10_000, 16)
    assert [field.name for field in cloud.fields] == ["x", "y", "z", "intensity"]
    end(program)


def test_a_listener_of_bytes(start):
    listener = start("demo_nodes_py", "listener_serialized")
    talker = start("demo_nodes_py", "talker")
    listener.wait_for(r'\[serialized_subscriber\]: I heard: "b.*Hello World')
    end(talker)
    end(listener)


def test_parameters_with_callbacks(start, run):
    node = start("demo_nodes_py", "set_parameters_callback")
    wait_for_parameters_of("set_parameters_callback")
    setting = run(ROS2, "param", "set", "/set_parameters_callback", "param1", "1.0")
    assert setting.wait() == 0
    reading = run(ROS2, "param", "get", "/set_parameters_callback", "param2")
    assert reading.wait() == 0
    assert "4.0" in reading.text
    refused = run(ROS2, "param", "set", "/set_parameters_callback", "param1", "6.0")
    refused.wait()
    assert "cannot set param1 > 5.0" in refused.text
    end(node)


def test_parameters_of_another_node(start, run):
    alone = start("demo_nodes_py", "async_param_client")
    assert alone.wait() == 1
    assert "parameter services of /parameter_blackboard are not there" in alone.text
    run(sys.executable, "-c", BLACKBOARD)
    wait_for_parameters_of("parameter_blackboard")
    client = start("demo_nodes_py", "async_param_client")
    assert client.wait() == 0
    assert "  - string_parameter: Fee Fi Fo Fum" in client.text
    assert "  - int_parameter: 10" in client.text


@pytest.mark.slow
def test_services_that_are_watched(start, run):
    service = start("demo_nodes_py", "introspection_service")
    client = start("demo_nodes_py", "introspection_client")
    client.wait_for(r"\[introspection_client\]: Result of add_two_ints: 5$")
    configure = "service_configure_introspection"
    wrong = run(ROS2, "param", "set", "/introspection_service", configure, "all")
    wrong.wait()
    assert "must be one of 'disabled', 'metadata', or 'contents'" in wrong.text
    setting = run(ROS2, "param", "set", "/introspection_service", configure, "contents")
    assert setting.wait() == 0
    echo = run(ROS2, "service", "echo", "/add_two_ints")
    echo.wait_for(r"sum: 5")
    end(client)
    end(service)


def test_matched_events(start):
    program = start("demo_nodes_py", "matched_event_detect")
    assert program.wait() == 0
    said = [line.split("]: ")[1] for line in program.text.splitlines() if "matched_event" in line]
    count = "The changed number of connected {0} is {1} and current number of connected {0} is 2."
    count_1 = count.replace(" is 2.", " is 1.")
    wanted = []
    for what in ("subscription", "publisher"):
        wanted += [
            f"First {what} is connected.",
            count.format(what, 1),
            count_1.format(what, -1),
            f"Last {what} is disconnected.",
        ]
    assert said == wanted


def test_levels_of_a_logger(start):
    program = start("demo_nodes_py", "use_logger_service")
    assert program.wait() == 0
    lines = [line.split("]: ")[1] for line in program.text.splitlines() if "Output" in line]
    for number, levels in enumerate(
        ["INFO WARN ERROR", "DEBUG INFO WARN ERROR", "INFO WARN ERROR", "WARN ERROR", "ERROR"], 1
    ):
        found = [line for line in lines if line.startswith(f"Output {number} ")]
        assert found == [f"Output {number} with {level} logger level." for level in levels.split()]
