"""Commands without an answer: `--timeout`, servers that end or misread, names that are unknown."""

import sys
import threading

import pytest
from tests.programs import ROS2

import rclpy
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy_components import ComponentManager
from ros2cli.main import main
from ros2cli.node.direct import DirectNode
from ros2component import api as components
from ros2lifecycle import api as lifecycle
from ros2param import api
from ros2param import api as parameters
from turtlewire.errors import UncallableServiceError
from turtlewire.wire import open_context

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
    words = ("action", "send_goal", "/count", "example_interfaces/action/Fibonacci")

    def send(order, distro):
        goal = (*ROS2, *words, f"{{order: {order}}}", "-t", "1")
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
    return run(*ROS2, *words)


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
    assert verb.text == (
        "The service type provided is not valid (<class 'std_msgs.msg._string.String'>), "
        "this might be a message or action"
    )


# Commands end with the reason when a server would misread their requests.

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
