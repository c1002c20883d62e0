"""The callbacks of a program that see, change and decide about parameters that are set."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from rcl_interfaces.msg import SetParametersResult
    from rclpy.parameter import Parameter

__all__ = ["ParameterCallbacks"]

#: ROS 2's text.
_NO_DECISION = "Callback returned an invalid type, it should return SetParameterResult."


class ParameterCallbacks:
    """Three lists of callbacks, each called newest first.

    Attributes:
        before: Each gets the list of parameters, and returns what is set instead.
        deciding: Each gets the list and accepts or refuses it.
        after: Each gets what was set.
    """

    def __init__(self) -> None:
        self.before: list[Callable[[list[Parameter]], list[Parameter]]] = []
        self.deciding: list[Callable[[list[Parameter]], SetParametersResult]] = []
        self.after: list[Callable[[list[Parameter]], None]] = []

    def changed_list(self, parameters: list[Parameter]) -> list[Parameter]:
        """Return the parameters that callbacks put in place of ``parameters``."""
        # A copy, here and below: a callback may add or remove callbacks.
        for callback in list(self.before):
            parameters = callback(parameters)
            if not parameters:
                return []
        return parameters

    def refusal(self, parameters: list[Parameter]) -> str:
        """Return why a callback rejects ``parameters``, or an empty string.

        A callback that returns no decision refuses, with a warning, as in ROS 2.
        """
        from rcl_interfaces.msg import SetParametersResult

        for callback in list(self.deciding):
            result = callback(parameters)
            if not isinstance(result, SetParametersResult):
                warnings.warn(f"{_NO_DECISION} {callback!r} returned {result!r}", stacklevel=2)
                return _NO_DECISION
            if not result.successful:
                return result.reason or "rejected by a callback that gave no reason"
        return ""

    def tell(self, parameters: list[Parameter]) -> None:
        """Report that ``parameters`` were set or declared."""
        for callback in list(self.after):
            callback(parameters)
