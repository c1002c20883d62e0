"""A client whose requests and responses can be watched.

``ros2 param set /introspection_client client_configure_introspection contents`` publishes them on
``/add_two_ints/_service_event``; ``metadata`` leaves the contents out.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from demo_nodes_py.services.introspection import check, state_of
from demo_nodes_py.spin import spin
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.qos import qos_profile_system_default

if TYPE_CHECKING:
    from rclpy.parameter import Parameter

_PARAMETER = "client_configure_introspection"


class IntrospectionClientNode(Node):
    """Asks for the sum of 2 and 3 twice a second."""

    def __init__(self) -> None:
        super().__init__("introspection_client")
        self.cli = self.create_client(AddTwoInts, "add_two_ints")
        # Before the declaration, so that the callbacks also get a value from the command line.
        self.add_on_set_parameters_callback(lambda given: check(_PARAMETER, given))
        self.add_post_set_parameters_callback(self._configure)
        self.declare_parameter(_PARAMETER, "disabled")
        self.timer = self.create_timer(0.5, self._ask)
        self.future: Any = None

    def _configure(self, parameters: Sequence[Parameter]) -> None:
        for state in state_of(_PARAMETER, parameters):
            self.cli.configure_introspection(self.get_clock(), qos_profile_system_default, state)

    def _ask(self) -> None:
        if not self.cli.service_is_ready():
            return
        if self.future is None:
            self.future = self.cli.call_async(AddTwoInts.Request(a=2, b=3))
        elif self.future.done():
            self.get_logger().info(f"Result of add_two_ints: {self.future.result().sum}")
            self.future = None


def main(args: list[str] | None = None) -> None:
    """Ask until Ctrl-C."""
    spin(IntrospectionClientNode, args)
