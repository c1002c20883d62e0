"""A node that looks like a C++ node, as turtlesim's are in ROS 2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_parameter_events

# What rclcpp declares for its publisher of parameter events.
_QOS_OVERRIDES = {
    "depth": 1000,
    "durability": "volatile",
    "history": "keep_last",
    "reliability": "reliable",
}
_TYPE_NAMES = {
    Parameter.Type.BOOL: "boolean",
    Parameter.Type.INTEGER: "integer",
    Parameter.Type.DOUBLE: "double",
    Parameter.Type.STRING: "string",
}


class CppNode(Node):
    """A node with the endpoints, parameters and error texts that rclcpp gives each node.

    Args:
        node_name: Name of the node.
        options: Passed on to :class:`rclpy.node.Node`.
    """

    def __init__(self, node_name: str, **options: Any) -> None:
        super().__init__(node_name, **options)
        # As in rclcpp, whose clock subscribes to learn of `use_sim_time`.
        self.create_subscription(
            ParameterEvent, "/parameter_events", lambda _: None, qos_profile_parameter_events
        )
        for name, value in _QOS_OVERRIDES.items():
            self.declare_parameter(
                f"qos_overrides./parameter_events.publisher.{name}",
                value,
                ParameterDescriptor(read_only=True),
            )

    def set_parameters_atomically(self, parameter_list: Sequence[Parameter]) -> SetParametersResult:
        """Set all, or none when one of them is rejected."""
        for parameter in parameter_list:
            reason = self._refusal(parameter)
            if reason:
                return SetParametersResult(successful=False, reason=reason)
        return super().set_parameters_atomically(list(parameter_list))

    def _refusal(self, parameter: Parameter) -> str:
        """Return why a parameter cannot be set; an empty string when it can."""
        name = parameter.name
        if not self.has_parameter(name):
            return f"parameter '{name}' cannot be set because it was not declared"
        descriptor = self.describe_parameter(name)
        if descriptor.read_only:
            return f"parameter '{name}' cannot be set because it is read-only"
        if parameter.type_ is Parameter.Type.NOT_SET:
            return "cannot undeclare a statically typed parameter"
        declared = self.get_parameter(name).type_
        if parameter.type_ is not declared and not descriptor.dynamic_typing:
            kinds = [
                _TYPE_NAMES.get(kind, kind.name.lower()) for kind in (declared, parameter.type_)
            ]
            return (
                f"Wrong parameter type, parameter {{{name}}} is of type {{{kinds[0]}}}, "
                f"setting it to {{{kinds[1]}}} is not allowed."
            )
        if any(
            not limits.from_value <= parameter.value <= limits.to_value
            for limits in descriptor.integer_range
        ):
            return f"Parameter {{{name}}} doesn't comply with integer range."
        return ""
