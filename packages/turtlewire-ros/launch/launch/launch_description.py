"""A list of entities, in the order of their visits."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch import logging
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchArgument


class LaunchDescription(LaunchDescriptionEntity):
    """A list of entities, which a launch file returns.

    Args:
        initial_entities: The entities.
        deprecated_reason: When given, a use of the description warns with it.
    """

    def __init__(
        self,
        initial_entities: Iterable[LaunchDescriptionEntity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        self._entities = list(initial_entities or ())
        self._deprecated_reason = deprecated_reason

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """The entities."""
        return self._entities

    @property
    def deprecated(self) -> bool:
        """True if a use of the description warns."""
        return self._deprecated_reason is not None

    @property
    def deprecated_reason(self) -> str | None:
        """The reason for the deprecation, and the replacement."""
        return self._deprecated_reason

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Append an entity."""
        self._entities.append(entity)

    def add_action(self, action: LaunchDescriptionEntity) -> None:
        """Append an action."""
        self.add_entity(action)

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the entities."""
        del context
        if self._deprecated_reason is not None:
            logging.get_logger().warning(
                "This LaunchDescription is deprecated: %s",
                self._deprecated_reason or "no reason given",
            )
        return self._entities

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities."""
        return self._entities

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[LaunchArgument]:
        """Return the arguments that this description and its inclusions declare, each once.

        Args:
            conditional_inclusion: Whether the description itself is only included under a
                condition.
        """
        return [
            argument
            for argument, _ in self.get_launch_arguments_with_include_launch_description_actions(
                conditional_inclusion
            )
        ]

    def get_launch_arguments_with_include_launch_description_actions(
        self, conditional_inclusion: bool = False
    ) -> list[tuple[LaunchArgument, list[LaunchDescriptionEntity]]]:
        """Return the declared arguments, each with the chain of inclusions that leads to it."""
        found: list[tuple[LaunchArgument, list[LaunchDescriptionEntity]]] = []
        _collect_arguments(self._entities, conditional_inclusion, [], found)
        return found


def _collect_arguments(
    entities: Iterable[LaunchDescriptionEntity],
    conditional: bool,
    inclusions: list[LaunchDescriptionEntity],
    found: list[tuple[LaunchArgument, list[LaunchDescriptionEntity]]],
) -> None:
    for entity in entities:
        entity_conditional = conditional or entity.is_conditional
        argument = entity.launch_argument
        if argument is not None:
            # As in ROS 2, the first declaration of a name counts.
            if not any(argument.name == known.name for known, _ in found):
                argument.conditionally_included = entity_conditional
                found.append((argument, inclusions))
            continue
        deeper = [*inclusions, entity] if entity.is_inclusion else inclusions
        _collect_arguments(entity.describe_sub_entities(), entity_conditional, deeper, found)
        for _, group in entity.describe_conditional_sub_entities():
            _collect_arguments(group, True, deeper, found)
