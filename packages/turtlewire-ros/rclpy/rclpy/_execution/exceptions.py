"""Exceptions that end an executor's wait without a callback to run."""

from __future__ import annotations

#: Where they can be imported from, and what tracebacks say.
_MODULE = "rclpy.executors"


class TimeoutException(Exception):
    """The time of a wait was over."""

    __module__ = _MODULE


class ShutdownException(Exception):
    """The executor was shut down."""

    __module__ = _MODULE


class ExternalShutdownException(Exception):
    """The context was shut down by a signal or by another thread."""

    __module__ = _MODULE

    def __init__(self, *args: object) -> None:
        super().__init__("The passed context is already shutdown", *args)


class ConditionReachedException(Exception):
    """The condition of a spin has become true."""

    __module__ = _MODULE
