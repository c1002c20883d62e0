"""Checks of what programs pass when they make endpoints."""

from __future__ import annotations

from typing import Any

from rclpy.hints import with_hint
from rclpy.qos import QoSProfile

__all__ = ["check_callable", "validate_qos"]


def check_callable(callback: Any) -> None:
    """Make sure that a callback can be called; TypeError with a hint if it cannot."""
    if not callable(callback):
        error = TypeError(f"'{type(callback).__name__}' object is not callable")
        raise with_hint(
            error, "Pass the function itself (self.callback), not what it returns (self.callback())"
        )


def validate_qos(qos_or_depth: QoSProfile | int) -> QoSProfile:
    """A profile as it is, a depth as the default profile with that depth.

    Raises:
        TypeError: It is neither.
        ValueError: The depth is negative.
    """
    if isinstance(qos_or_depth, QoSProfile):
        return qos_or_depth
    if isinstance(qos_or_depth, int):
        if qos_or_depth < 0:
            raise ValueError("history depth must be greater than or equal to zero")
        return QoSProfile(depth=qos_or_depth)
    raise TypeError(f"Expected QoSProfile or int, but received {type(qos_or_depth)!r}")
