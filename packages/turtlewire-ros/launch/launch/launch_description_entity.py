"""Base of launch descriptions and actions, and the argument that one declares."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext
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


class LaunchDescriptionEntity:
    """An entity that a launch visits; a visit may return further entities."""

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Take effect; the returned entities are visited next."""
        raise NotImplementedError(f"{type(self).__name__} does not define visit()")

    def describe(self) -> str:
        """Return the text of this entity in descriptions."""
        return repr(self)

    @property
    def launch_argument(self) -> LaunchArgument | None:
        """The launch argument that it declares, or None."""
        return None

    @property
    def is_conditional(self) -> bool:
        """True if a condition decides if a visit takes effect."""
        return False

    @property
    def is_inclusion(self) -> bool:
        """True if it includes another launch description."""
        return False

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities that a visit always returns, for inspection without running."""
        return []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return groups of entities that a visit returns under a condition, with the conditions."""
        return []

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Return a future that is done when the entity has completed; None if a visit does it."""
        return None
