"""Declares an argument of a launch file that is true or false."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.some_substitutions_type import SomeSubstitutionsType

_CHOICES = ("true", "false", "True", "False", "TRUE", "FALSE")


@expose_action("bool_arg")
class DeclareBooleanLaunchArgument(DeclareLaunchArgument):
    """Declares an argument that is true or false.

    Args:
        name: Its name.
        default_value: Its value when it is not given: a bool, or a text that is one.
        **kwargs: See :class:`DeclareLaunchArgument`.

    Raises:
        ValueError: ``choices`` are given.
    """

    def __init__(
        self,
        name: str,
        *,
        default_value: bool | SomeSubstitutionsType | None = None,
        **kwargs: Any,
    ) -> None:
        if "choices" in kwargs:
            raise ValueError("Cannot specify choices for bool_arg")
        default = str(default_value) if isinstance(default_value, bool) else default_value
        super().__init__(name, default_value=default, choices=_CHOICES, **kwargs)
