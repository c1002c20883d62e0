"""A declared argument of a launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from launch.substitution import Substitution

__all__ = ["LaunchArgument"]


class LaunchArgument(Protocol):
    """The description of a ``DeclareLaunchArgument``."""

    #: Whether it is declared only under a condition; known after a search for arguments.
    conditionally_included: bool

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def default_value(self) -> list[Substitution] | None:
        """Its value when it is not given; None if it must be given."""

    @property
    def description(self) -> str:
        """Purpose of the argument."""

    @property
    def choices(self) -> list[str] | None:
        """The values it may have, or None for any."""
