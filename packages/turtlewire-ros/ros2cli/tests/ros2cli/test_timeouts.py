"""The option `--timeout` of verbs that wait for the answer of a node which does not spin."""

import sys

import pytest

from ros2cli.main import main
from ros2cli.node.direct import DirectNode
from ros2component import api as components
from ros2lifecycle import api as lifecycle
from ros2param import api as parameters

#: Its services are there, but nothing answers.
SILENT = """
import threading
import rclpy
from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rclpy.lifecycle import LifecycleNode
rclpy.init()
node = LifecycleNode("silent")
services = [
    node.create_service(kind, f"/silent/_container/{name}", print)
    for name, kind in {
        "list_nodes": ListNodes, "load_node": LoadNode, "unload_node": UnloadNode
    }.items()
]
print("ready", flush=True)
threading.Event().wait()
"""


@pytest.fixture
def silent(run):
    run(sys.executable, "-c", SILENT).wait_for("ready")


PARAM = "Timed out waiting for {} response from node /silent (timeout: 0.3s)"
LIFECYCLE = "Timed out waiting for {} response (timeout: 0.3s)"
COMPONENT = "Timed out waiting for {} response from '/silent' container (timeout: 0.3s)"
EACH = "Exception while calling service of node '/silent': "


OF_VERBS = {
    "param list /silent --service-timeout": PARAM.format("list_parameters"),
    "param list --service-timeout": PARAM.format("list_parameters"),
    "param get /silent speed --service-timeout": PARAM.format("get_parameters"),
    "param set /silent speed 1 --service-timeout": PARAM.format("set_parameters"),
    "param describe /silent speed --service-timeout": PARAM.format("describe_parameters"),
    "param dump /silent --service-timeout": PARAM.format("list_parameters"),
    "lifecycle get /silent --timeout": LIFECYCLE.format("get_state"),
    "lifecycle get --timeout": EACH + LIFECYCLE.format("get_state"),
    "lifecycle list /silent --timeout": LIFECYCLE.format("get_available_transitions"),
    "lifecycle list -a /silent --timeout": LIFECYCLE.format("get_transition_graph"),
    "lifecycle set /silent 1 --timeout": LIFECYCLE.format("get_available_transitions"),
    "component list /silent --timeout": COMPONENT.format("list_nodes"),
    "component list --timeout": EACH + COMPONENT.format("list_nodes"),
    "component load /silent some some.Node --timeout": COMPONENT.format("load_node"),
    "component unload /silent 1 --timeout": COMPONENT.format("unload_node"),
}


def test_verbs_end_in_time(silent, capsys):
    for words, told in OF_VERBS.items():
        assert main([*words.split(), "0.3"]) == 1
        assert capsys.readouterr().err == f"{told}\n"


GOALS = """
import threading
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
rclpy.init()
node = rclpy.create_node("goals")
ended = threading.Event()
def reply(goal):
    if goal.order == 0:
        ended.wait()
    return GoalResponse.ACCEPT
def cancel(handle):
    if handle.request.order == 1:
        ended.wait()
    return CancelResponse.ACCEPT
def execute(handle):
    if handle.request.order == 3:
        ended.wait(1.5)
        handle.succeed()
        return Fibonacci.Result()
    while not handle.is_cancel_requested:
        ended.wait(0.01)
    handle.canceled()
    return Fibonacci.Result()
options = {"goal_callback": reply, "cancel_callback": cancel}
server = ActionServer(
    node, Fibonacci, "/count", execute, callback_group=ReentrantCallbackGroup(), **options
)
executor = MultiThreadedExecutor(8)
executor.add_node(node)
print("ready", flush=True)
executor.spin()
"""


def test_a_goal_ends_in_time_in_lyrical(run):
    run(sys.executable, "-c", GOALS).wait_for("ready")
    program = "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))"
    words = ("action", "send_goal", "/count", "example_interfaces/action/Fibonacci")

    def send(order, distro):
        goal = (sys.executable, "-c", program, *words, f"{{order: {order}}}", "-t", "1")
        return run(*goal, environment={"ROS_DISTRO": distro})

    late = "Timed out waiting for goal {} after 1 seconds."
    ends = {
        0: late.format("acceptance"),
        1: late.format("cancellation"),
        2: "Canceling goal...\nGoal canceled.\n" + late.format("result"),
    }
    for order, told in ends.items():
        verb = send(order, "lyrical")
        assert verb.wait() == 1
        assert verb.text.endswith(told)
    # Up to Kilted, the result may take longer than the time.
    verb = send(3, "kilted")
    assert verb.wait() == 0
    assert verb.text.endswith("Goal finished with status: SUCCEEDED")


@pytest.mark.parametrize(
    "words", ["lifecycle get", "lifecycle set /x 1", "component list", "component unload /x 1"]
)
def test_times_are_positive(capsys, words):
    with pytest.raises(SystemExit):
        main([*words.split(), "--timeout", "0"])
    assert "argument --timeout: value must be positive" in capsys.readouterr().err


def test_functions_of_the_packages_have_the_times(silent):
    with DirectNode(None) as node:
        given = {"node": node, "node_name": "/silent", "timeout": 0.3}
        with pytest.raises(RuntimeError, match=r"set_parameters_atomically response from node /s"):
            parameters.call_set_parameters_atomically(parameters=[], **given)
        with pytest.raises(RuntimeError, match=r"get_parameters response .*\(timeout: 0.3s\)"):
            parameters.call_get_parameters(parameter_names=["speed"], **given)
        answers = lifecycle.call_get_states(node=node, node_names=["/silent"], timeout=0.3)
        assert str(answers["/silent"]) == LIFECYCLE.format("get_state")
        found = components.get_components_in_container(
            node=node, remote_container_node_name="/silent", timeout=0.3
        )
        assert found == (False, COMPONENT.format("list_nodes"))
