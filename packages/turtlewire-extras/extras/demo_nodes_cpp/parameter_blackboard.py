"""A node that holds any parameters, for other nodes and ``ros2 param`` to read and set."""

from __future__ import annotations

from demo_nodes_py.spin import spin
from rclpy.node import Node

__all__ = ["ParameterBlackboard", "main"]


class ParameterBlackboard(Node):
    """Accepts every parameter."""

    def __init__(self) -> None:
        super().__init__(
            "parameter_blackboard",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        count = len(self.list_parameters([], 0).names)
        self.get_logger().info(
            f"Parameter blackboard node named '{self.get_fully_qualified_name()}' ready, and "
            f"serving '{count}' parameters already!"
        )


def main(args: list[str] | None = None) -> None:
    """Hold parameters until Ctrl-C."""
    spin(ParameterBlackboard, args)
