"""tf2_py's times: messages with ``sec`` and ``nanosec``, and rclpy's with ``nanoseconds``."""

from __future__ import annotations

from typing import Any

from turtlewire.call_errors import ros_time_error


def to_moment(time: Any) -> int | None:
    """Return the nanoseconds of a time of a question; time 0, the latest, is the engine's None."""
    return to_nanoseconds(time) or None


def to_nanoseconds(value: Any, what: str = "time") -> int:
    """Return the nanoseconds of a time or duration.

    Args:
        value: A builtin_interfaces message, or an rclpy ``Time`` or ``Duration``.
        what: ``time`` or ``duration``, for the error.

    Raises:
        TypeError: ``value`` is neither. Numbers are refused, because their unit is unknown.
    """
    if hasattr(value, "sec") and hasattr(value, "nanosec"):
        return int(value.sec) * 1_000_000_000 + int(value.nanosec)
    if hasattr(value, "nanoseconds"):
        return int(value.nanoseconds)
    raise ros_time_error(what, value)
