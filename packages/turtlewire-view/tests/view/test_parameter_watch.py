"""A parameter of a node: its text, or why there is none."""

from __future__ import annotations

import contextlib
import queue
import threading

import pytest

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from std_srvs.srv import Empty
from turtlewire import msg
from turtlewire.errors import WireError
from turtlewire.wire.qos import QoS
from turtlewire_view import LiveSource
from turtlewire_view.source import ParameterAnswer

LIMIT_S = 60


@pytest.fixture
def source():
    with contextlib.closing(LiveSource()) as source:
        yield source


@pytest.fixture
def describer():
    """Starts nodes that have the given parameters."""
    stack = contextlib.ExitStack()

    def describer(name="describer", **parameters):
        context = rclpy.Context()
        context.init()
        stack.callback(context.try_shutdown)
        given = [Parameter(key, value=value) for key, value in parameters.items()]
        node = rclpy.create_node(
            name, context=context, parameter_overrides=given,
            automatically_declare_parameters_from_overrides=True,
        )  # fmt: skip
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        thread = threading.Thread(target=executor.spin)
        thread.start()
        stack.callback(thread.join)
        stack.callback(executor.shutdown)
        return node

    with stack:
        yield describer


def ask(source, node, name):
    answers = queue.SimpleQueue()
    end = source.ask_parameter(node, name, answers.put)
    return answers, end


def wait_for(answers, accept):
    while True:
        answer = answers.get(timeout=LIMIT_S)
        if accept(answer):
            return answer


def test_the_text_of_a_node_that_comes_later(source, describer):
    answers, end = ask(source, "/describer", "robot")
    with contextlib.closing(contextlib.ExitStack()) as stack:
        stack.callback(end)
        absent = answers.get(timeout=LIMIT_S)
        assert absent.problem.startswith("there is no node /describer with parameters; nodes with ")
        describer(robot="<robot/>")
        assert wait_for(answers, lambda answer: answer.text) == ParameterAnswer("<robot/>")


def test_a_node_that_starts_before_another_ends_is_asked(source, describer):
    first = describer(robot="<first/>")
    answers, end = ask(source, "/describer", "robot")
    with contextlib.closing(contextlib.ExitStack()) as stack:
        stack.callback(end)
        wait_for(answers, lambda answer: answer.text == "<first/>")
        describer(robot="<second/>")
        first.destroy_node()
        wait_for(answers, lambda answer: answer.text == "<second/>")


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("none", "the node /describer has no parameter 'none'"),
        ("count", "the parameter 'count' of /describer is an integer, no string"),
    ],
)
def test_why_there_is_no_text(source, describer, name, why):
    describer(count=3)
    answers, end = ask(source, "/describer", name)
    with contextlib.closing(contextlib.ExitStack()) as stack:
        stack.callback(end)
        assert wait_for(answers, lambda answer: answer.problem == why)


def test_a_request_that_cannot_be_sent_is_a_problem(source, describer, monkeypatch):
    def fail(_):
        raise WireError("out of resources")

    answers = queue.SimpleQueue()
    calls = source.ask_service("/reset", "std_srvs/srv/Empty", answers.put)
    monkeypatch.setattr(calls._client, "send_request", fail)
    describer().create_service(Empty, "/reset", lambda _, response: response)
    wait_for(answers, lambda answer: answer.problem == "out of resources")
    monkeypatch.undo()
    calls.again()
    wait_for(answers, lambda answer: answer.cdr)
    calls.close()


def test_no_lock_is_held_while_an_answer_is_given(source, describer):
    """The graph's news can be taken while the callback of an answer has not returned."""
    entered, left, texts = threading.Event(), threading.Event(), queue.SimpleQueue()

    def take(answer):
        if answer.text:
            texts.put(answer.text)
        entered.set()
        assert left.wait(LIMIT_S)

    end = source.ask_parameter("/describer", "robot", take)
    assert entered.wait(LIMIT_S)
    describer(robot="<robot/>")
    graph = source._context.graph
    assert graph.wait_for(
        lambda: any(n.name == "describer" for n in graph.nodes()), 10**9 * LIMIT_S
    )
    told = threading.Thread(target=graph.notify_changed, daemon=True)
    told.start()
    told.join(LIMIT_S)
    assert not told.is_alive()
    left.set()
    assert texts.get(timeout=LIMIT_S) == "<robot/>"
    end()


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("/not a node", "namespace must not contain characters other than"),
        ("describer", "namespace must be absolute"),
        ("", "namespace must not be empty"),
    ],
)
def test_a_name_that_no_node_has(source, name, fault):
    answers, end = ask(source, name, "robot")
    end()
    problem = answers.get(timeout=LIMIT_S).problem
    assert problem.startswith(f"{name!r} is not the name of a node: {fault}")


def test_a_changed_parameter_is_followed(source, describer, robot):
    """Its node's own event may come before the view has found that publisher: one more is sent."""
    node = describer(robot="<robot/>")
    events = robot.publisher("/parameter_events", "rcl_interfaces/msg/ParameterEvent", QoS())
    answers, end = ask(source, "/describer", "robot")
    assert robot.wait_for(events.is_heard)
    assert wait_for(answers, lambda answer: answer.text).text == "<robot/>"
    for kind in ("new", "changed"):
        text = f"<robot name='{kind}'/>"
        node.set_parameters([Parameter("robot", value=text)])
        event = msg.get_message("rcl_interfaces/msg/ParameterEvent")(node="/describer")
        changed = msg.get_message("rcl_interfaces/msg/Parameter")(name="robot")
        setattr(event, f"{kind}_parameters", [changed])
        events.publish(msg.serialize(event))
        wait_for(answers, lambda answer, text=text: answer.text == text)
    end()


def test_a_node_that_would_misread_the_request_is_named(source, foreign_server):
    foreign_server("/stranger/get_parameters", "rcl_interfaces/srv/GetParameters")
    answers, end = ask(source, "/stranger", "robot")
    with contextlib.closing(contextlib.ExitStack()) as stack:
        stack.callback(end)
        answer = wait_for(answers, lambda answer: "is not called" in answer.problem)
    assert "Start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp" in answer.problem
