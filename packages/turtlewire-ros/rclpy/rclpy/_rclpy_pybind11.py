"""Names that programs import from ``rclpy._rclpy_pybind11``.

In turtlewire they are plain Python: error classes, the structures of a duration and of a QoS
profile, and functions that announce an endpoint for the constructor of its class.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Any


class InvalidHandle(RuntimeError):
    """An entity was used after it had been destroyed."""


class RCLError(RuntimeError):
    """An operation of the client library failed."""


class RMWError(RuntimeError):
    """An operation of the middleware failed."""


class UnknownROSArgsError(RuntimeError):
    """``--ros-args`` holds a flag that does not exist."""


class RCLInvalidROSArgsError(RCLError):
    """``--ros-args`` holds a malformed rule or parameter."""


class NodeNameNonExistentError(RCLError):
    """A graph query named a node that is not known."""


class UnsupportedEventTypeError(RCLError):
    """The middleware has no such event."""


class TimerCancelledError(RCLError):
    """A cancelled timer was asked for its next call."""


class rmw_qos_policy_kind_t(IntEnum):  # noqa: N801  ROS 2's name, which its text shows
    """The policies in events of incompatible QoS, equal to ``rclpy.qos.QoSPolicyKind``."""

    RMW_QOS_POLICY_INVALID = 1
    RMW_QOS_POLICY_DURABILITY = 2
    RMW_QOS_POLICY_DEADLINE = 4
    RMW_QOS_POLICY_LIVELINESS = 8
    RMW_QOS_POLICY_RELIABILITY = 16
    RMW_QOS_POLICY_HISTORY = 32
    RMW_QOS_POLICY_LIFESPAN = 64
    RMW_QOS_POLICY_DEPTH = 128
    RMW_QOS_POLICY_LIVELINESS_LEASE_DURATION = 256
    RMW_QOS_POLICY_AVOID_ROS_NAMESPACE_CONVENTIONS = 512

    def __str__(self) -> str:
        """Return the name of the enumeration and of the value."""
        # pybind11's text; since Python 3.11, an IntEnum prints its number.
        return f"{type(self).__name__}.{self.name}"


class rcl_duration_t:  # noqa: N801  ROS 2's name
    """A span of time, from :meth:`rclpy.duration.Duration.get_c_duration`.

    Args:
        nanoseconds: The whole span in nanoseconds.
    """

    def __init__(self, nanoseconds: int) -> None:
        self.nanoseconds = nanoseconds


class rmw_qos_profile_t:  # noqa: N801  ROS 2's name
    """Quality of service, from :meth:`rclpy.qos.QoSProfile.get_c_qos_profile`.

    Later changes of the profile do not change it.

    Args:
        policies: The arguments of :class:`rclpy.qos.QoSProfile`.
    """

    def __init__(self, **policies: Any) -> None:
        self._policies = policies

    def to_dict(self) -> dict[str, Any]:
        """Return the arguments of :class:`rclpy.qos.QoSProfile` for the same profile."""
        return dict(self._policies)


def Publisher(  # noqa: N802  a class in ROS 2, as the others
    node: Any, pymsg_type: Any, topic: str, pyqos_profile: rmw_qos_profile_t
) -> Any:
    """Announce a publisher; return the first argument of :class:`rclpy.publisher.Publisher`.

    Args:
        node: The ``handle`` of the node.
        pymsg_type: Class of its messages.
        topic: Name of the topic.
        pyqos_profile: Its quality of service.
    """
    return node.announce("publisher", pymsg_type, topic, pyqos_profile)


def Subscription(  # noqa: N802
    node: Any, pymsg_type: Any, topic: str, pyqos_profile: rmw_qos_profile_t
) -> Any:
    """Announce a subscription for :class:`rclpy.subscription.Subscription`; see `Publisher`."""
    return node.announce("subscription", pymsg_type, topic, pyqos_profile)


def Service(  # noqa: N802
    node: Any, pysrv_type: Any, service_name: str, pyqos_profile: rmw_qos_profile_t
) -> Any:
    """Announce a service; return the first argument of :class:`rclpy.service.Service`.

    Args:
        node: The ``handle`` of the node.
        pysrv_type: The service class.
        service_name: Name of the service.
        pyqos_profile: Quality of service of requests and responses.
    """
    return node.announce("service", pysrv_type, service_name, pyqos_profile)


def Client(  # noqa: N802
    node: Any, pysrv_type: Any, service_name: str, pyqos_profile: rmw_qos_profile_t
) -> Any:
    """Announce a client; return the argument of :class:`rclpy.client.Client`; see `Service`."""
    return node.announce("client", pysrv_type, service_name, pyqos_profile)
