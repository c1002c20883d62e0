"""Puts the nodes that follow into a namespace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("push_ros_namespace")
@expose_action("push-ros-namespace")
class PushROSNamespace(Action):
    """Puts the nodes that follow into a namespace, relative to that of the scope.

    A ``GroupAction`` limits it to its own actions.

    Args:
        namespace: The namespace.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._namespace = normalize_to_list_of_substitutions(namespace)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[PushROSNamespace], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["namespace"] = parser.parse_substitution(entity.get_attr("namespace"))
        return cls, kwargs

    @property
    def namespace(self) -> list[Substitution]:
        """The namespace."""
        return self._namespace

    def execute(self, context: LaunchContext) -> None:
        joined = prefix_namespace(
            context.launch_configurations.get("ros_namespace"),
            perform_substitutions(context, self._namespace),
        )
        if joined is not None:
            context.launch_configurations["ros_namespace"] = make_namespace_absolute(joined)


PushRosNamespace = PushROSNamespace
