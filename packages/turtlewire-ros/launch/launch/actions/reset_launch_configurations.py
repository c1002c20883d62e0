"""Forgets launch configurations."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = [
    "ResetLaunchConfigurations",
    "SomeSubstitutionsType_types_tuple",
    "kept_configurations",
]


@expose_action("reset")
class ResetLaunchConfigurations(Action):
    """Forgets all launch configurations except the given ones.

    Args:
        launch_configurations: Names and values that are set afterwards; their substitutions still
            see the forgotten ones.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        launch_configurations: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._launch_configurations = dict(launch_configurations or {})

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[ResetLaunchConfigurations], dict[str, Any]]:
        """Read a ``reset`` element with ``keep`` children."""
        _, kwargs = super().parse(entity, parser)
        if (kept := kept_configurations(entity, parser)) is not None:
            kwargs["launch_configurations"] = kept
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        kept = {
            perform_substitutions(
                context, normalize_to_list_of_substitutions(name)
            ): perform_substitutions(context, normalize_to_list_of_substitutions(value))
            for name, value in self._launch_configurations.items()
        }
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)


def kept_configurations(entity: Entity, parser: Parser) -> dict[Any, list[Substitution]] | None:
    """Return the configurations in ``keep`` children (XML) or in the list ``keep`` (YAML)."""
    kept = entity.get_attr("keep", data_type=list[Entity], optional=True)
    if kept is None:
        # A list in YAML has them among its elements; an empty mapping has no elements.
        with contextlib.suppress(ValueError):
            kept = [child for child in entity.children if child.type_name == "keep"]
    if not kept:
        return None
    configurations: dict[Any, list[Substitution]] = {}
    for child in kept:
        name = tuple(parser.parse_substitution(child.get_attr("name")))
        configurations[name] = parser.parse_substitution(child.get_attr("value"))
        child.assert_entity_completely_parsed()
    return configurations
