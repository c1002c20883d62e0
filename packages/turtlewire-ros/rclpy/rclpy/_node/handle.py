"""The stand-in for a node's handle of ROS 2's C library."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._execution.handle import Handle
from rclpy.qos import QoSProfile

if TYPE_CHECKING:
    from rclpy._node.endpoints import OwnEndpoints
    from rclpy._rclpy_pybind11 import rmw_qos_profile_t
    from turtlewire.wire import base


class NodeHandle(Handle):
    """Gives what the middleware's node has, and announces endpoints.

    Args:
        wire: The middleware's side of the node.
        endpoints: The endpoints of the node.
    """

    def __init__(self, wire: base.Node, endpoints: OwnEndpoints) -> None:
        super().__init__(wire)
        self._endpoints = endpoints

    def announce(
        self, kind: str, interface: Any, name: str, pyqos_profile: rmw_qos_profile_t
    ) -> Any:
        """Announce an endpoint; return what the constructor of its class needs.

        Args:
            kind: ``publisher``, ``subscription``, ``service`` or ``client``.
            interface: The class of its messages, or the service class.
            name: Name of the topic or service.
            pyqos_profile: Its quality of service.
        """
        announce = getattr(self._endpoints, f"{kind}_impl")
        return announce(interface, name, QoSProfile(**pyqos_profile.to_dict()))
