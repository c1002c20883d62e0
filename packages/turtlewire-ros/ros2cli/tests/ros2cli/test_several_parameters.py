"""`ros2 param get` and `set` of several parameters, and of all nodes."""

import sys

import pytest
from tests.completion import offered

from ros2cli.main import main

NODES = """
import rclpy
from rclpy.executors import SingleThreadedExecutor
rclpy.init()
executor = SingleThreadedExecutor()
for name, parameters in {"a": {"speed": 20.0, "on": True}, "b": {"speed": 3}, "c": {}}.items():
    node = rclpy.create_node(name)
    for parameter, value in parameters.items():
        node.declare_parameter(parameter, value)
    executor.add_node(node)
print("ready", flush=True)
executor.spin()
"""


@pytest.fixture
def nodes(run):
    run(sys.executable, "-c", NODES).wait_for("ready")


def told(capsys, words, status=0):
    assert main(["param", *words.split()]) == status
    return capsys.readouterr()


def test_several_parameters_of_a_node(nodes, capsys):
    text = "speed:\n  Double value is: 20.0\non:\n  Boolean value is: True\n"
    assert told(capsys, "get /a speed on") == (text, "")
    assert told(capsys, "get --hide-type /a on speed") == ("on: True\nspeed: 20.0\n", "")
    assert told(capsys, "get /a speed") == ("Double value is: 20.0\n", "")
    missing = "Parameter(s) 'on', 'sped' not available on node\nDid you mean: speed\n"
    assert told(capsys, "get /a on sped", 1) == ("", missing)


def test_a_parameter_of_all_nodes(nodes, capsys):
    text = "/a:\n  Double value is: 20.0\n/b:\n  Integer value is: 3\n"
    assert told(capsys, "get speed") == (text, "")
    assert told(capsys, "get on --hide-type --service-timeout 60") == ("/a: True\n", "")
    assert told(capsys, "get sped", 1) == ("", "Parameter 'sped' not set on any node\n")
    hint = "Parameter '/a' not set on any node\n/a is a node: also name one of its parameters\n"
    assert told(capsys, "get /a", 1) == ("", hint)


def test_several_parameters_are_set(nodes, capsys):
    text = "speed: Set parameter successful\non: Set parameter successful\n"
    assert told(capsys, "set /a speed 1.5 on false") == (text, "")
    assert told(capsys, "get /a on speed --hide-type").out == "on: False\nspeed: 1.5\n"
    out, err = told(capsys, "set /a speed fast on true")
    assert out == "on: Set parameter successful\n"
    assert err.startswith("speed: Setting parameter failed: Wrong parameter type, expected ")
    assert told(capsys, "set /a on true") == ("Set parameter successful\n", "")
    pairs = "Parameters must be provided as name/value pairs: name value [name value ...]."
    assert told(capsys, "set /a speed 1.0 on", 1) == ("", f"{pairs} Got 3 argument(s).\n")


def test_all_parameters_are_set_or_none(nodes, capsys):
    text = "Set parameters atomically successful\n"
    assert told(capsys, "set --atomic /a speed 2.5 on false") == (text, "")
    out, err = told(capsys, "set --atomic /a speed 9.5 on maybe")
    assert out == ""
    assert err.startswith("Setting parameters atomically failed: Wrong parameter type, expected ")
    assert told(capsys, "get /a on speed --hide-type").out == "on: False\nspeed: 2.5\n"


def test_completion_of_a_second_parameter(nodes):
    assert "on" in set().union(*(offered("ros2 param get /a speed o") for _ in range(3)))
