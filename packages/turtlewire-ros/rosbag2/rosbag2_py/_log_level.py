"""The level of the logs of recorder and player."""

from __future__ import annotations

from rclpy.logging import get_logging_severity_from_string, set_logger_level

__all__ = ["set_log_level"]


def set_log_level(log_level: str) -> None:
    """Set the level of all loggers without one of their own.

    Raises:
        RuntimeError: There is no such level.
    """
    set_logger_level("", get_logging_severity_from_string(log_level))
