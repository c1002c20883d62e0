"""Views of a node for its built-in parts, which do not depend on the whole node."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from rcl_interfaces.msg import (
        ListParametersResult,
        ParameterDescriptor,
        SetParametersResult,
    )
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.parameter import Parameter
    from rclpy.qos import QoSProfile


class ServiceOwner(Protocol):
    """A node that offers services."""

    def get_name(self) -> str:
        """Base name."""
        ...

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = ...,
    ) -> Any:
        """Offer a service."""
        ...


class ParameterOwner(ServiceOwner, Protocol):
    """A node that also has parameters."""

    def has_parameter(self, name: str) -> bool:
        """Return True if a parameter is declared."""
        ...

    def declare_parameter(
        self, name: str, value: Any = None, descriptor: ParameterDescriptor | None = None
    ) -> Parameter:
        """Declare a parameter."""
        ...

    def get_parameter(self, name: str) -> Parameter:
        """Return a parameter."""
        ...

    def get_parameter_type(self, name: str) -> Any:
        """Return the type of a parameter."""
        ...

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return the descriptor of a parameter."""
        ...

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """Return the names of parameters."""
        ...

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set all parameters, or none."""
        ...


class TimeSourceOwner(Protocol):
    """A node whose parameter says whether its clock follows ``/clock``."""

    def has_parameter(self, name: str) -> bool:
        """Return True if a parameter is declared."""
        ...

    def declare_parameter(self, name: str, value: Any = None) -> Parameter:
        """Declare a parameter."""
        ...

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        """Return a parameter."""
        ...

    def add_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Let ``callback`` accept or reject new values."""
        ...

    def remove_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Undo :meth:`add_on_set_parameters_callback`."""
        ...

    def get_logger(self) -> RcutilsLogger:
        """Return the logger of the node."""
        ...

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Callable[[Any], Any], qos_profile: QoSProfile
    ) -> Any:
        """Announce a subscription."""
        ...
