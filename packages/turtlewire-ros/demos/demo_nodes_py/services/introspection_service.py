"""A service whose requests and responses can be watched.

``ros2 param set /introspection_service service_configure_introspection contents`` publishes them on
``/add_two_ints/_service_event``; ``metadata`` leaves the contents out.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from demo_nodes_py.services.introspection import check, state_of
from demo_nodes_py.spin import spin
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.qos import qos_profile_system_default

if TYPE_CHECKING:
    from rclpy.parameter import Parameter

_PARAMETER = "service_configure_introspection"


class IntrospectionServiceNode(Node):
    """Adds two integers."""

    def __init__(self) -> None:
        super().__init__("introspection_service")
        self.srv = self.create_service(AddTwoInts, "add_two_ints", self._add)
        # Before the declaration, so that the callbacks also get a value from the command line.
        self.add_on_set_parameters_callback(lambda given: check(_PARAMETER, given))
        self.add_post_set_parameters_callback(self._configure)
        self.declare_parameter(_PARAMETER, "disabled")

    def _add(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        response.sum = request.a + request.b
        self.get_logger().info(f"Incoming request\na: {request.a} b: {request.b}")
        return response

    def _configure(self, parameters: Sequence[Parameter]) -> None:
        for state in state_of(_PARAMETER, parameters):
            self.srv.configure_introspection(self.get_clock(), qos_profile_system_default, state)


def main(args: list[str] | None = None) -> None:
    """Serve until Ctrl-C."""
    spin(IntrospectionServiceNode, args)
