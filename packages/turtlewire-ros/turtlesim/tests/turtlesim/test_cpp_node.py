"""Nodes that answer to parameters as C++ nodes do; the texts are the captures'."""

from __future__ import annotations

import pytest

import rclpy
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.parameter import Parameter
from turtlesim.cpp_node import CppNode

QOS = "qos_overrides./parameter_events.publisher.depth"


@pytest.fixture
def node():
    rclpy.init(args=[])
    made = CppNode("sim")
    made.declare_parameter(
        "red",
        69,
        ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=255, step=1)]),
    )
    yield made
    made.destroy_node()
    rclpy.try_shutdown()


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("red", 300, "Parameter {red} doesn't comply with integer range."),
        (
            "red",
            "abc",
            (
                "Wrong parameter type, parameter {red} is of type {integer}, setting it to "
                "{string} "
                "is not allowed."
            ),
        ),
        ("red", None, "cannot undeclare a statically typed parameter"),
        ("nope", 1, "parameter 'nope' cannot be set because it was not declared"),
        (QOS, 1, f"parameter '{QOS}' cannot be set because it is read-only"),
    ],
)
def test_rejected_values(node, name, value, reason):
    result = node.set_parameters_atomically(
        [Parameter("red", value=1), Parameter(name, value=value)]
    )
    assert (result.successful, result.reason) == (False, reason)
    assert node.get_parameter("red").value == 69


def test_settings(node):
    result = node.set_parameters_atomically([Parameter("red", value=255)])
    assert result.successful
    assert node.get_parameter("red").value == 255


def test_it_hears_of_parameter_events(node):
    def hears() -> bool:
        return "/parameter_events" in dict(node.get_subscriber_names_and_types_by_node("sim", "/"))

    assert node.context.wait_for_graph(hears, 60_000_000_000)
    assert node.get_parameter(QOS).value == 1000
