"""Mistakes that beginners make: the error comes where the mistake is, and says what to do."""

from __future__ import annotations

import pytest

from example_interfaces.srv import AddTwoInts
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from turtlesim.action import RotateAbsolute

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
        executor.spin_until_future_complete(response, timeout_sec=10)
    assert str(caught.value) == ""  # as in ROS 2
    assert caught.value.hint.startswith(
        "The callback of service '/add' has to return its second argument"
    )
    assert caught.value.hint.endswith("it returned None")


def test_after_a_mistake_the_executor_still_shuts_down(context):
    executor = SingleThreadedExecutor(context=context)
    with pytest.raises(TypeError):
        executor.add_node(Node)
    assert executor.get_nodes() == []
    assert executor.shutdown()
