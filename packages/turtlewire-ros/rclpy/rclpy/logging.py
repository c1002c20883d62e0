"""Loggers by name, their levels, and where their messages go.

A line goes to the standard error stream, to a file in :func:`get_logging_directory`, and to
``/rosout`` when its logger belongs to a node::

    [INFO] [1700000000.123456789] [turtle_tf2_broadcaster]: text
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .impl import log_levels, log_output
from .impl.logging_severity import LoggingSeverity
from .impl.rcutils_logger import RcutilsLogger

if TYPE_CHECKING:
    from pathlib import Path


__all__ = [
    "LoggingSeverity",
    "clear_config",
    "get_logger",
    "get_logger_effective_level",
    "get_logger_level",
    "get_logging_directory",
    "get_logging_severity_from_string",
    "initialize",
    "set_logger_level",
    "shutdown",
]

_root_logger = RcutilsLogger()


def get_logger(name: str) -> RcutilsLogger:
    """Return the logger of this name.

    Raises:
        ValueError: The name is empty.
    """
    if not name:
        raise ValueError("Logger name must not be empty.")
    return _root_logger.get_child(name)


def initialize() -> None:
    """Read the environment again and open a log file for the next message."""
    log_output.configure()


def shutdown() -> None:
    """Close the log file; messages still go to the console."""
    log_output.shutdown()


def clear_config() -> None:
    """Forget all levels and start again."""
    log_levels.reset()
    initialize()


# Nothing can fail here.
def set_logger_level(name: str, level: int, detailed_error: bool = False) -> None:  # noqa: ARG001
    """Set the level of a logger; an empty name means the default, ``UNSET`` inherits.

    Raises:
        ValueError: The severity does not exist.
    """
    log_levels.set_level(name, LoggingSeverity(level))


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Return the level that decides about messages of a logger.

    Its own, or the nearest ancestor's, or the default.
    """
    return LoggingSeverity(log_levels.effective(name))


def get_logger_level(name: str) -> LoggingSeverity:
    """Return the level that was set for this logger itself; ``UNSET`` when it inherits."""
    return LoggingSeverity(log_levels.own(name))


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Return the severity of a name such as ``info``; upper and lower case are the same.

    Raises:
        RuntimeError: The severity does not exist.
    """
    try:
        return LoggingSeverity[log_severity.upper()]
    except KeyError:
        known = ", ".join(severity.name for severity in LoggingSeverity)
        raise RuntimeError(
            f"There is no log severity '{log_severity}'; choose from {known}"
        ) from None


def get_logging_directory() -> Path:
    """Return the directory of log files.

    ROS_LOG_DIR, else the folder ``log`` in ROS_HOME, else ``~/.ros/log``.
    """
    from pathlib import Path

    return Path(log_output.directory())
