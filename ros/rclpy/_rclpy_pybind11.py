"""The error classes that ROS 2 programs reach through ``rclpy._rclpy_pybind11``.

Here they have no C extension behind them.
"""

from __future__ import annotations

__all__ = [
    "InvalidHandle",
    "NodeNameNonExistentError",
    "RCLError",
    "RCLInvalidROSArgsError",
    "RMWError",
    "TimerCancelledError",
    "UnknownROSArgsError",
    "UnsupportedEventTypeError",
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
