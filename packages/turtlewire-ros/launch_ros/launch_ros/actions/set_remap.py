"""Remaps a name of all nodes that follow."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.scope import add_remap

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("set_remap")
class SetRemap(Action):
    """Remaps a name of all nodes that follow.

    A ``GroupAction`` limits it to its own actions.

    Args:
        src: The name.
        dst: What it becomes.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(
        self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self._src = normalize_to_list_of_substitutions(src)
        self._dst = normalize_to_list_of_substitutions(dst)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetRemap], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["src"] = parser.parse_substitution(entity.get_attr("from"))
        kwargs["dst"] = parser.parse_substitution(entity.get_attr("to"))
        return cls, kwargs

    @property
    def src(self) -> list[Substitution]:
        """The name."""
        return self._src

    @property
    def dst(self) -> list[Substitution]:
        """New name."""
        return self._dst

    def execute(self, context: LaunchContext) -> None:
        add_remap(
            context,
            perform_substitutions(context, self._src),
            perform_substitutions(context, self._dst),
        )
