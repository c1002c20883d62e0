"""Sets, lists, reads and deletes parameters of the node ``/parameter_blackboard``.

That node is C++'s in ROS 2; any node of this name that allows undeclared parameters will do.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient

if TYPE_CHECKING:
    from rclpy.node import Node

_PATIENCE = 3.0  # seconds


def main(args: list[str] | None = None) -> int:
    """Go through all requests; returns the exit status."""
    with rclpy.init(args=args):
        node = rclpy.create_node("async_param_client")
        client = AsyncParameterClient(node, "parameter_blackboard")
        if not client.wait_for_services(timeout_sec=_PATIENCE):
            node.get_logger().error(
                "The parameter services of /parameter_blackboard are not there: start a node of"
                " this name that allows undeclared parameters."
            )
            return 1
        _go_through(node, client)
    return 0


def _go_through(node: Node, client: AsyncParameterClient) -> None:
    log = node.get_logger().info

    def answer(future: Any) -> Any:
        rclpy.spin_until_future_complete(node, future)
        return future.result()

    log("Setting parameters:")
    given = [
        Parameter("int_parameter", Parameter.Type.INTEGER, 10),
        Parameter("string_parameter", Parameter.Type.STRING, "Fee Fi Fo Fum"),
    ]
    for number, result in enumerate(answer(client.set_parameters(given)).results):
        log(f"Result {number}: {result.successful} {result.reason}".rstrip())
    log("Listing Parameters:")
    for name in answer(
        client.list_parameters(["string_parameter", "int_parameter"], 10)
    ).result.names:
        log(f"  - {name}")
    names = [parameter.name for parameter in given]
    log("Getting parameters:")
    for name, value in zip(names, answer(client.get_parameters(names)).values, strict=True):
        log(f"  - {name}: {parameter_value_to_python(value)}")
    log("Deleting parameters:")
    for name, result in zip(names, answer(client.delete_parameters(names)).results, strict=True):
        log(f"  - {name}: {result.successful} {result.reason}".rstrip())
