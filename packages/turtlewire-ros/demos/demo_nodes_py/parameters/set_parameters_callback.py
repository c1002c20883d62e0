"""Changes, rejects and follows parameters with callbacks.

Try ``ros2 param set /set_parameters_callback param1 1.0``, and a value above 5.0.
"""

from __future__ import annotations

from collections.abc import Sequence

from demo_nodes_py.spin import spin
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class SetParametersCallback(Node):
    """Sets ``param2`` to 4.0 whenever ``param1`` is set, which must be at most 5.0."""

    def __init__(self) -> None:
        super().__init__("set_parameters_callback")
        self.internal_tracked_param_1: float = self.declare_parameter("param1", 0.0).value
        self.internal_tracked_param_2: float = self.declare_parameter("param2", 0.0).value
        self.add_pre_set_parameters_callback(self._add_param2)
        self.add_on_set_parameters_callback(self._check)
        self.add_post_set_parameters_callback(self._follow)

    def _add_param2(self, parameters: list[Parameter]) -> list[Parameter]:
        if any(parameter.name == "param1" for parameter in parameters):
            # Added before the check, so it is checked and set together with `param1`.
            parameters.append(Parameter("param2", Parameter.Type.DOUBLE, 4.0))
        return parameters

    def _check(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        # Only checks: another callback may still reject the change, so `_follow` takes the values.
        for parameter in parameters:
            if parameter.name == "param1" and parameter.value > 5.0:
                return SetParametersResult(successful=False, reason="cannot set param1 > 5.0")
        return SetParametersResult(successful=True)

    def _follow(self, parameters: Sequence[Parameter]) -> None:
        for parameter in parameters:
            if parameter.name == "param1":
                self.internal_tracked_param_1 = parameter.value
            elif parameter.name == "param2":
                self.internal_tracked_param_2 = parameter.value


def main(args: list[str] | None = None) -> None:
    """Offer the parameters until Ctrl-C."""
    spin(SetParametersCallback, args)
