"""Mistakes of beginners: the error is raised at the mistake, and says what to do."""

import contextlib
import threading
import time

import pytest

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy import exceptions
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.exceptions import NoTypeSupportImportedException
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.arguments import Arguments
from rclpy.node import Node
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger
from turtlesim.action import RotateAbsolute
from turtlewire.wire import report

MISTAKES = {
    "a timer gets what the callback returned": (
        lambda node, executor: (node.create_timer(0.001, None), executor.spin_once(10)),
        TypeError,
        "Pass the function itself (self.tick), not what it returns (self.tick())",
    ),
    "a timer gets no function": (
        lambda node, _: node.create_timer(1.0, 5),
        TypeError,
        "Pass the function itself",
    ),
    "a service gets what the callback returned": (
        lambda node, _: node.create_service(AddTwoInts, "add", None),
        TypeError,
        "Pass the function itself (self.callback)",
    ),
    "type and topic in the wrong order": (
        lambda node, _: node.create_publisher("chatter", String, 10),
        AttributeError,
        "Expected a class such as std_msgs.msg.String, not an object of type str",
    ),
    "a message instead of its class": (
        lambda node, _: node.create_subscription(String(), "chatter", print, 10),
        AttributeError,
        "not an object of type String",
    ),
    "a topic without a name": (
        lambda node, _: node.create_publisher(String, None, 10),
        TypeError,
        "is a str, not None",
    ),
    "the class of a request": (
        lambda node, _: node.create_client(AddTwoInts, "add").call_async(AddTwoInts.Request),
        TypeError,
        "A request of service '/add' is a AddTwoInts.Request(), not the class AddTwoInts_Request",
    ),
    "the class of a goal": (
        lambda node, _: ActionClient(node, RotateAbsolute, "turn").send_goal_async(
            RotateAbsolute.Goal
        ),
        TypeError,
        "A goal of action 'turn' is a RotateAbsolute.Goal(), not the class",
    ),
    "the class of a node": (
        lambda _, executor: executor.add_node(Node),
        TypeError,
        "not the class Node",
    ),
    "several nodes at once": (
        lambda node, executor: executor.add_node([node]),
        TypeError,
        "not an object of type list",
    ),
    "a future that a function forgot to return": (
        lambda _, executor: executor.spin_until_future_complete(None),
        TypeError,
        "Expected a Future, such as call_async() returns, not None",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_the_error_says_what_to_do(node, executor, mistake):
    make, error, help_ = MISTAKES[mistake]
    with pytest.raises(error) as caught:
        make(node, executor)
    assert help_ in getattr(caught.value, "hint", "") or help_ in str(caught.value)


class Forgetful(Node):
    """Does not call the constructor of its base."""

    def __init__(self):
        self.publisher = self.create_publisher(String, "chatter", 10)


def test_a_node_that_forgets_to_call_the_constructor_of_its_base():
    with pytest.raises(AttributeError) as caught:
        Forgetful()
    assert str(caught.value) == "'Forgetful' object has no attribute '_rclpy_endpoints'"
    assert caught.value.hint.endswith("call super().__init__('name') first")


def test_a_service_that_forgets_to_return_its_response(node, executor):
    node.create_service(AddTwoInts, "add", lambda _request, response: setattr(response, "sum", 1))
    response = node.create_client(AddTwoInts, "add").call_async(AddTwoInts.Request())
    with pytest.raises(TypeError) as caught:
        executor.spin_until_future_complete(response, timeout_sec=60)
    text = str(caught.value)
    assert text.startswith("The callback of service '/add' has to return its second argument")
    assert text.endswith("it returned None")


def test_one_topic_with_two_types(node, capfd, monkeypatch):
    monkeypatch.setattr(report, "_said", set())
    node.create_subscription(String, "chatter", print, 10)
    node.create_publisher(Int32, "chatter", 10)
    node.create_subscription(Int32, "chatter", print, 10)
    node.create_publisher(Int32, "chatter", 10)
    said = [line for line in capfd.readouterr().err.splitlines() if "chatter" in line]
    assert [line.partition("]: ")[2] for line in said] == [
        (
            "topic /chatter has the type std_msgs/msg/Int32, but this process subscribes to "
            "std_msgs/msg/String: no messages get through. "
            "Use the topic's type, or another topic name."
        ),
        (
            "topic /chatter has the type std_msgs/msg/String, but this process publishes "
            "std_msgs/msg/Int32: no messages get through. "
            "Use the topic's type, or another topic name."
        ),
    ]


def test_a_client_of_another_type_than_the_action(node, capfd, monkeypatch):
    monkeypatch.setattr(report, "_said", set())
    ActionServer(node, RotateAbsolute, "turn", print)
    ActionClient(node, Fibonacci, "turn")
    said = [line for line in capfd.readouterr().err.splitlines() if "turn" in line]
    assert len(said) == 2  # what it publishes, and what it subscribes to
    assert all("topic /turn/_action/feedback has the type" in line for line in said)


def test_endpoints_that_have_gone_conflict_with_nothing(node, capfd, monkeypatch):
    monkeypatch.setattr(report, "_said", set())
    node.destroy_subscription(node.create_subscription(String, "chatter", print, 10))
    node.create_publisher(Int32, "chatter", 10)
    assert "chatter" not in capfd.readouterr().err


PEER = """
    import rclpy
    from rclpy.node import Node
    from std_msgs.msg import String

    rclpy.init()
    node = Node("twin")
    publisher = node.create_publisher(String, "chatter", 10)
    print("ready", flush=True)
    rclpy.spin(node)
"""


def test_a_twin_and_another_type_in_another_process(program, capfd, monkeypatch):
    monkeypatch.setattr(report, "_said", set())
    peer = program(PEER)
    assert peer.read_line() == "ready"
    with Context() as context:
        node = Node("twin", context=context)
        node.create_subscription(Int32, "chatter", print, 10)
        assert context.wait_for_graph(
            lambda: (
                node.count_publishers("chatter") == 1
                and node.get_fully_qualified_node_names().count("/twin") == 2
                and node.count_subscribers("chatter") == 1
            ),
            60_000_000_000,
        )
    said = capfd.readouterr().err
    assert said.count("another process runs a node named /twin in domain") == 1
    assert "ROS_DOMAIN_ID" in said
    assert said.count("topic /chatter has the type std_msgs/msg/String") == 1


def test_a_command_line_that_gives_another_type_is_told_in_one_line(program):
    source = """
        import rclpy
        from rclpy.node import Node

        rclpy.init()
        Node("n").declare_parameter("speed", 1.0)
    """
    status, _, errors = program(source, "--ros-args", "-p", "speed:=fast").finish()
    assert status == 1
    first, *rest = errors.strip().splitlines()
    assert first == (
        "rclpy.exceptions.InvalidParameterTypeException: Trying to set parameter 'speed' to 'fast'"
        " of type 'STRING', expecting type 'DOUBLE': speed"
    )
    assert rest == []


def test_a_parameter_file_that_is_nested_too_deeply(tmp_path):
    path = tmp_path / "deep.yaml"
    path.write_text(
        "".join(f"{' ' * level}n{level}:\n" for level in range(3000)) + " " * 3000 + "1"
    )
    with pytest.raises(RCLError, match="More than 100 names within each other"):
        Arguments.parse_global(["program", "--ros-args", "--params-file", str(path)])


def test_two_executors_that_wait_for_each_other(context, capfd):
    """Each serves what the other one's only thread waits for."""
    nodes = [Node(name, context=context) for name in ("left", "right")]
    executors = [SingleThreadedExecutor(context=context) for _ in nodes]
    clients = [
        node.create_client(Trigger, other.get_name(), callback_group=ReentrantCallbackGroup())
        for node, other in zip(nodes, reversed(nodes), strict=True)
    ]
    warned = threading.Event()

    def ask(client):
        def answer(_, response):
            future = client.call_async(Trigger.Request())
            while not warned.is_set():
                with contextlib.suppress(TimeoutError):
                    client._block_for(future, 2.0)
            return response

        return answer

    threads = []
    for node, client, executor in zip(nodes, clients, executors, strict=True):
        node.create_service(Trigger, node.get_name(), ask(client))
        executor.add_node(node)
        threads.append(threading.Thread(target=executor.spin, daemon=True))
        threads[-1].start()
    caller = Node("caller", context=context)
    caller.create_client(Trigger, "left").call_async(Trigger.Request())
    said = ""
    deadline = time.monotonic() + 60
    while "another executor" not in said and time.monotonic() < deadline:
        warned.wait(0.1)
        said += capfd.readouterr().err
    warned.set()
    for executor, thread in zip(executors, threads, strict=True):
        executor.shutdown()
        thread.join(60)
    assert "which another executor of this process serves" in said


def test_after_a_mistake_the_executor_still_shuts_down(context):
    executor = SingleThreadedExecutor(context=context)
    with pytest.raises(TypeError):
        executor.add_node(Node)
    assert executor.get_nodes() == []
    assert executor.shutdown()


def test_a_message_class_of_another_installation(node):
    class FromElsewhere(type):
        _TYPE_SUPPORT = None

    class String(metaclass=FromElsewhere):
        pass

    with pytest.raises(NoTypeSupportImportedException) as caught:
        node.create_publisher(String, "a", 1)
    assert "comes from another ROS 2 installation" in caught.value.hint


# The texts of errors.


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (exceptions.NotInitializedException(), "rclpy.init() has not been called."),
        (exceptions.NoTypeSupportImportedException(), "no type_support imported"),
        (exceptions.ROSInterruptException(), "rclpy.shutdown() has been called"),
    ],
)
def test_texts(error, text):
    assert str(error) == text


def test_hints_are_notes():
    error = exceptions.ParameterNotDeclaredException("a").with_hint("declared are ['b'].")
    assert error.hint == "declared are ['b']."
    assert getattr(error, "__notes__", [error.hint]) == [error.hint]
