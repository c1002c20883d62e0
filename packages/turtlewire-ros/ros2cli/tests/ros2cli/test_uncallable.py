"""Commands end with the reason when a server would misread their requests."""

from __future__ import annotations

import threading

import pytest

import rclpy
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from ros2cli.main import main
from ros2param import api
from turtlewire.errors import UncallableServiceError

WHY = (
    "service {} is not called: its server runs on a middleware that announces no serviceid, which "
    "would misread our requests"
)
ADVICE = "Start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp, or both ends with "
SERVICES = {
    "/stranger/list_parameters": "rcl_interfaces/srv/ListParameters",
    "/stranger/get_state": "lifecycle_msgs/srv/GetState",
    "/stranger/_container/load_node": "composition_interfaces/srv/LoadNode",
    "/stranger/_container/list_nodes": "composition_interfaces/srv/ListNodes",
    "/clear": "std_srvs/srv/Empty",
    "/turn/_action/send_goal": "turtlesim/action/RotateAbsolute_SendGoal",
}


@pytest.fixture
def stranger(foreign_server):
    for service, type_name in SERVICES.items():
        foreign_server(service, type_name)


@pytest.fixture
def node():
    """A node that another thread spins."""
    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node("sound", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    yield node
    executor.shutdown()
    thread.join()
    node.destroy_node()
    context.destroy()


@pytest.mark.parametrize(
    ("words", "service"),
    [
        (["param", "list", "/stranger"], "/stranger/list_parameters"),
        (["param", "list"], "/stranger/list_parameters"),
        (["param", "dump", "/stranger"], "/stranger/list_parameters"),
        (["lifecycle", "get", "/stranger"], "/stranger/get_state"),
        (["component", "list", "/stranger"], "/stranger/_container/list_nodes"),
        (["service", "call", "/clear", "std_srvs/srv/Empty"], "/clear"),
        (
            ["action", "send_goal", "/turn", "turtlesim/action/RotateAbsolute", "{}"],
            "/turn/_action/send_goal",
        ),
    ],
)
def test_the_command_ends_with_the_reason(stranger, capsys, words, service):
    assert main(words) == 1
    told = capsys.readouterr().err
    assert WHY.format(service) in told
    assert ADVICE in told


def test_the_parameters_of_other_nodes_are_listed(stranger, node, capsys):
    assert main(["param", "list"]) == 1
    out, told = capsys.readouterr()
    assert "/sound:\n  start_type_description_service\n" in out
    assert told.count("Exception while calling list_parameters service of node '/stranger'") == 1


def test_node_info_tells_it(stranger, capsys):
    assert main(["node", "info", "/stranger"]) == 0
    assert capsys.readouterr().err.startswith(
        "The services of /stranger, those of parameters and actions included, cannot be called "
        "from here: it runs on a middleware that announces no serviceid. Start the node with "
    )


def test_the_functions_of_ros2param_raise_it(stranger, node):
    with pytest.raises(UncallableServiceError):
        api.call_get_parameters(node=node, node_name="/stranger", parameter_names=["a"])
    assert api.call_list_parameters(node=node, node_name="/stranger") is None


def test_an_action_client_logs_it_once(stranger, node, capfd):
    from turtlesim.action import RotateAbsolute

    client = ActionClient(node, RotateAbsolute, "turn")
    said = ""
    while not said:
        assert not client.wait_for_server(timeout_sec=1.0)
        said = capfd.readouterr().err
    assert said.count(WHY.format("/turn/_action/send_goal")) == 1
    assert not client.wait_for_server(timeout_sec=0.01)
    future = client.send_goal_async(RotateAbsolute.Goal())
    assert isinstance(future.exception(), UncallableServiceError)
    assert capfd.readouterr().err == ""
    client.destroy()
