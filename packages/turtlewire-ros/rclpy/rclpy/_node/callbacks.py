"""The callbacks of a program that see, change and decide about parameters that are set."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from rcl_interfaces.msg import SetParametersResult
    from rclpy.parameter import Parameter

__all__ = ["ParameterCallbacks"]


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
        for callback in list(self.before):
            parameters = callback(parameters)
            if not parameters:
                return []
        return parameters

    def refusal(self, parameters: list[Parameter]) -> str:
        """Why a callback refuses ``parameters``, an empty string if none does.

        Raises:
            TypeError: A callback returned no decision.
        """
        for callback in list(self.deciding):
            result = callback(parameters)
            if result is None:
                raise TypeError(
                    f"{callback!r} decides about parameters: it has to return a "
                    "SetParametersResult, but returned None"
                )
            if not result.successful:
                return result.reason or "refused by a callback, which gave no reason"
        return ""

    def tell(self, parameters: list[Parameter]) -> None:
        """Say that ``parameters`` were set or declared."""
        for callback in list(self.after):
            callback(parameters)
