"""Log lines of a launch: on the screen, in ``launch.log`` and in files of single processes.

Built on the standard library's ``logging``; its level names and constants are available from here.
"""

from logging import CRITICAL, DEBUG, ERROR, INFO, NOTSET, WARNING, Logger, getLevelName
from logging import getLogger as getLogger

from launch.logging.config import (
    LaunchConfig,
    default_log_dir,
    get_logger,
    get_output_loggers,
    launch_config,
    log_launch_config,
    reset,
)

__all__ = [
    "CRITICAL",
    "DEBUG",
    "ERROR",
    "INFO",
    "NOTSET",
    "WARNING",
    "LaunchConfig",
    "Logger",
    "default_log_dir",
    "getLevelName",
    "getLogger",
    "get_logger",
    "get_output_loggers",
    "launch_config",
    "log_launch_config",
    "reset",
]
