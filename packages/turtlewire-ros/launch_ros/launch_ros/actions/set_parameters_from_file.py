"""Sets parameters of all nodes that follow from a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.scope import add_global_parameter

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("set_parameters_from_file")
class SetParametersFromFile(Action):
    """Gives a parameter file to all nodes that follow.

    A ``GroupAction`` limits it to its own actions.

    Args:
        filename: Path of the file.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(self, filename: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._filename = normalize_to_list_of_substitutions(filename)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[SetParametersFromFile], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["filename"] = parser.parse_substitution(entity.get_attr("filename"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        add_global_parameter(context, perform_substitutions(context, self._filename))
