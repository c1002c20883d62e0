"""The errors of ROS 2's client library, with its texts.

Exceptions of executors are in :mod:`rclpy.executors`, of the layers below in
``rclpy._rclpy_pybind11``. Some carry a ``hint``: what exists and what to do; tracebacks show it as
a note on Python 3.11 and later.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._rclpy_pybind11 import InvalidHandle, TimerCancelledError
from .impl.hints import with_hint

if TYPE_CHECKING:
    from typing_extensions import Self

    from .parameter import Parameter

__all__ = [
    "InvalidHandle",
    "InvalidNamespaceException",
    "InvalidNodeNameException",
    "InvalidParameterException",
    "InvalidParameterTypeException",
    "InvalidParameterValueException",
    "InvalidServiceNameException",
    "InvalidTopicNameException",
    "NameValidationException",
    "NoTypeSupportImportedException",
    "NotInitializedException",
    "ParameterAlreadyDeclaredException",
    "ParameterException",
    "ParameterImmutableException",
    "ParameterNotDeclaredException",
    "ParameterUninitializedException",
    "ROSInterruptException",
    "TimeSourceChangedError",
    "TimerCancelledError",
]


class NotInitializedException(Exception):
    """Something needs ``rclpy.init()`` first."""

    def __init__(self, message: str | None = None) -> None:
        text = "rclpy.init() has not been called."
        super().__init__(f"{text} msg:{message}" if message else text)


class NoTypeSupportImportedException(Exception):
    """A class is not a message type."""

    def __init__(self, *args: object) -> None:
        super().__init__("no type_support imported", *args)


class NameValidationException(Exception):
    """A name breaks the rules of ROS 2.

    Attributes:
        name_type: What the name is for, for example ``topic name``.
        name: The name.
        error_msg: Which rule is broken.
        invalid_index: Where in the name.
    """

    def __init__(
        self, name_type: str, name: str, error_msg: str, invalid_index: int, *args: object
    ) -> None:
        marker = " " * invalid_index + "^"
        super().__init__(f"Invalid {name_type}: {error_msg}:\n  '{name}'\n   {marker}", *args)
        self.name_type = name_type
        self.name = name
        self.error_msg = error_msg
        self.invalid_index = invalid_index


class InvalidNamespaceException(NameValidationException):
    """A namespace breaks the rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("namespace", name, error_msg, invalid_index, *args)


class InvalidNodeNameException(NameValidationException):
    """A node name breaks the rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("node name", name, error_msg, invalid_index, *args)


class InvalidTopicNameException(NameValidationException):
    """A topic name breaks the rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("topic name", name, error_msg, invalid_index, *args)


class InvalidServiceNameException(NameValidationException):
    """A service name breaks the rules."""

    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: object) -> None:
        super().__init__("service name", name, error_msg, invalid_index, *args)


class ParameterException(Exception):
    """Base of the errors around parameters."""

    hint: str = ""

    def __init__(self, error_msg: str, parameters: Any, *args: object) -> None:
        super().__init__(f"{error_msg}: {parameters}", *args)

    def with_hint(self, hint: str) -> Self:
        """Attach ``hint`` and return the same error."""
        return with_hint(self, hint)


class ParameterNotDeclaredException(ParameterException):
    """A parameter is used that was never declared."""

    def __init__(self, parameters: Any, *args: object) -> None:
        super().__init__("Invalid access to undeclared parameter(s)", parameters, *args)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter is declared for the second time."""

    def __init__(self, parameters: Any, *args: object) -> None:
        super().__init__("Parameter(s) already declared", parameters, *args)


class InvalidParameterException(ParameterException):
    """A parameter has an impossible name."""

    def __init__(self, parameter_name: Any, *args: object) -> None:
        super().__init__("Invalid parameter name", parameter_name, *args)


class InvalidParameterTypeException(ParameterException):
    """A value has another type than its parameter was declared with.

    Attributes:
        is_of_command_line: Whether the user typed the value: then the program is not at fault, and
            needs no traceback.
    """

    is_of_command_line = False

    def __init__(self, desired_parameter: Parameter, expected_type: str) -> None:
        super().__init__(
            f"Trying to set parameter '{desired_parameter.name}' to '{desired_parameter.value}'"
            f" of type '{desired_parameter.type_.name}', expecting type '{expected_type}'",
            desired_parameter.name,
        )


class InvalidParameterValueException(ParameterException):
    """A value is out of range or was rejected by a callback."""

    def __init__(self, parameter: str, value: Any, reason: str) -> None:
        text = f"Invalid parameter value ({value}) for parameter"
        super().__init__(f"{text}. Reason: {reason}" if reason else text, parameter)


class ParameterImmutableException(ParameterException):
    """An attempt to change a read-only parameter."""

    def __init__(self, parameter_name: Any, *args: object) -> None:
        super().__init__("Attempted to modify read-only parameter", parameter_name, *args)


class ParameterUninitializedException(ParameterException):
    """A parameter that was declared with a type alone is read before it has a value."""

    def __init__(self, parameter_name: Any, *args: object) -> None:
        super().__init__(
            f"The parameter '{parameter_name}' is not initialized", parameter_name, *args
        )


class TimeSourceChangedError(Exception):
    """A clock began or ended to follow ``/clock`` during a sleep."""


class ROSInterruptException(Exception):
    """A wait has ended because of the shutdown."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.shutdown() has been called", *args)
