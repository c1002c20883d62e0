"""The parts of a node that its built-in services and publishers see, and its handle."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from rclpy._execution.handle import EndpointImpl, Handle
from rclpy.qos import QoSProfile

if TYPE_CHECKING:
    from rcl_interfaces.msg import (
        ListParametersResult,
        ParameterDescriptor,
        SetParametersResult,
    )
    from rclpy._node.endpoints import OwnEndpoints
    from rclpy._rclpy_pybind11 import rmw_qos_profile_t
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.parameter import Parameter
    from turtlewire.wire import base


class ServiceOwner(Protocol):
    """A node that offers services."""

    def get_name(self) -> str: ...

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = ...,
    ) -> Any: ...


class ParameterOwner(ServiceOwner, Protocol):
    """A node that also has parameters."""

    def has_parameter(self, name: str) -> bool: ...

    def declare_parameter(
        self, name: str, value: Any = None, descriptor: ParameterDescriptor | None = None
    ) -> Parameter: ...

    def get_parameter(self, name: str) -> Parameter: ...

    def get_parameter_type(self, name: str) -> Any: ...

    def describe_parameter(self, name: str) -> ParameterDescriptor: ...

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult: ...

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult: ...


class TimeSourceOwner(Protocol):
    """A node whose parameter says whether its clock follows ``/clock``."""

    def has_parameter(self, name: str) -> bool: ...

    def declare_parameter(self, name: str, value: Any = None) -> Parameter: ...

    def get_parameter_or(self, name: str) -> Parameter: ...

    def add_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None: ...

    def remove_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None: ...

    def get_logger(self) -> RcutilsLogger: ...

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Callable[[Any], Any], qos_profile: QoSProfile
    ) -> Any: ...


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
    ) -> EndpointImpl:
        """Announce an endpoint; see :meth:`OwnEndpoints.announce`."""
        profile = QoSProfile(**pyqos_profile.to_dict())
        return self._endpoints.announce(kind, interface, name, profile)
