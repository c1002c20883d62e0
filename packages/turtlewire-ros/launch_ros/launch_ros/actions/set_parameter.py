"""Sets a parameter of all nodes that follow."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend import expose_action
from launch_ros._node.elements import parse_value
from launch_ros.parameter_descriptions import Parameter
from launch_ros.utilities.scope import add_global_parameter

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("set_parameter")
class SetParameter(Action):
    """Sets a parameter of all nodes that follow.

    A ``GroupAction`` limits it to its own actions.

    Args:
        name: Its name.
        value: Its value.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._parameter = Parameter(name, value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetParameter], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        kwargs["value"] = parse_value(entity, parser)
        return cls, kwargs

    @property
    def name(self) -> str | list[Substitution]:
        """The name of the parameter; before the visit, the substitutions that produce it."""
        return self._parameter.name

    @property
    def value(self) -> Any:
        """The value of the parameter; before the visit, the unevaluated argument."""
        return self._parameter.value

    def execute(self, context: LaunchContext) -> None:
        add_global_parameter(context, self._parameter.evaluate(context))
