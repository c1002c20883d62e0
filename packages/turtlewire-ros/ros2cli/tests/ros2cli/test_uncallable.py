"""Commands end with the reason when a server would misread their requests."""

import threading

import pytest

import rclpy
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy_components import ComponentManager
from ros2cli.main import main
from ros2param import api
from turtlewire.errors import UncallableServiceError
from turtlewire.wire import open_context

LONG = 60_000_000_000
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
def strangers(foreign_server):
    """Makes foreign servers, and waits until others know that they belong to /stranger."""

    def make(services):
        for service, type_name in services.items():
            foreign_server(service, type_name)
        context = open_context(middleware="rmw_cyclonedds_cpp")
        graph = context.graph
        assert graph.wait_for(
            lambda: len([each for each in graph.foreign_servers() if each.node]) == len(services),
            LONG,
        )
        context.close()

    return make


@pytest.fixture
def stranger(strangers):
    strangers(SERVICES)


@pytest.fixture
def spun():
    """Makes nodes of a class that another thread spins."""
    context = rclpy.Context()
    rclpy.init(context=context)
    executor = SingleThreadedExecutor(context=context)
    thread = threading.Thread(target=executor.spin)
    nodes = []

    def make(node_class, name):
        nodes.append(node_class(name, context=context))
        executor.add_node(nodes[-1])
        return nodes[-1]

    thread.start()
    yield make
    executor.shutdown()
    thread.join()
    for node in nodes:
        node.destroy_node()
    context.destroy()


@pytest.fixture
def node(spun):
    return spun(Node, "sound")


@pytest.mark.parametrize(
    ("words", "service"),
    [
        (["param", "list", "/stranger"], "/stranger/list_parameters"),
        (["param", "list"], "/stranger/list_parameters"),
        (["param", "dump", "/stranger"], "/stranger/list_parameters"),
        (["lifecycle", "get", "/stranger"], "/stranger/get_state"),
        (["lifecycle", "get"], "/stranger/get_state"),
        (["component", "list", "/stranger"], "/stranger/_container/list_nodes"),
        (["component", "list"], "/stranger/_container/list_nodes"),
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


@pytest.mark.parametrize(
    ("words", "node_class", "shown"),
    [
        (["lifecycle", "get"], LifecycleNode, "/sound: unconfigured [1]\n"),
        (["component", "list"], ComponentManager, "/sound\n/stranger\n"),
    ],
)
def test_a_verb_that_asks_all_nodes_goes_on_with_the_next(
    spun, strangers, capsys, words, node_class, shown
):
    strangers(
        {  # one comes before the other node, one after it
            f"{name}/{service}": SERVICES[f"/stranger/{service}"]
            for name in ("/another", "/stranger")
            for service in ("get_state", "_container/load_node", "_container/list_nodes")
        }
    )
    spun(node_class, "sound")
    assert main(words) == 1
    out, told = capsys.readouterr()
    assert out.endswith(shown)
    for name in ("/another", "/stranger"):
        assert told.count(f"Exception while calling service of node '{name}': service {name}/") == 1
    assert told.count(ADVICE) == 2


def test_managed_nodes_and_containers_are_listed_without_a_request(stranger, capsys):
    assert main(["lifecycle", "nodes"]) == 0
    assert main(["component", "list", "--containers-only"]) == 0
    assert capsys.readouterr() == ("/stranger\n/stranger\n", "")


def test_node_info_tells_it(stranger, capsys):
    assert main(["node", "info", "/stranger"]) == 0
    assert capsys.readouterr().err.startswith(
        "The services of /stranger, including parameters and actions, cannot be called from here: "
        "it runs on a middleware that announces no serviceid. Start the node with "
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
