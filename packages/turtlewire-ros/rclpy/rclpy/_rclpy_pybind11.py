"""Names that programs import from ``rclpy._rclpy_pybind11``: error classes, and an enumeration.

In turtlewire they are plain Python.
"""

from __future__ import annotations

from enum import IntEnum

__all__ = [
    "InvalidHandle",
    "NodeNameNonExistentError",
    "RCLError",
    "RCLInvalidROSArgsError",
    "RMWError",
    "TimerCancelledError",
    "UnknownROSArgsError",
    "UnsupportedEventTypeError",
    "rmw_qos_policy_kind_t",
]


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
