"""A declared argument of a launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from launch.substitution import Substitution


class LaunchArgument(Protocol):
    """The description of a ``DeclareLaunchArgument``."""

    #: Whether it is declared only under a condition; known after a search for arguments.
    conditionally_included: bool

    @property
    def name(self) -> str:
        """The name of the argument."""

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value of the argument if the user does not set it; None if it is required."""

    @property
    def description(self) -> str:
        """Purpose of the argument."""

    @property
    def choices(self) -> list[str] | None:
        """The values it may have, or None for any."""
