"""Runs a process for several nodes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.frontend import expose_action
from launch_ros.actions.load_composable_nodes import LoadComposableNodes, parse_composable_nodes
from launch_ros.actions.node import Node

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.descriptions.composable_node import ComposableNode


@expose_action("node_container")
class ComposableNodeContainer(Node):
    """Runs a process for several nodes, and loads them.

    ::

        ComposableNodeContainer(
            name="demo",
            composable_node_descriptions=[
                ComposableNode(package="turtlesim", plugin="turtlesim.turtlesim_node.TurtlesimNode",
                name="sim"),
            ],
        )

    Args:
        name: Name of the container.
        namespace: Namespace of the container.
        composable_node_descriptions: The nodes.
        package: Package of the container's executable.
        executable: The container's executable; by default the one for nodes in Python.
        **kwargs: See :class:`Node`.
    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType = "",
        composable_node_descriptions: Iterable[ComposableNode] | None = None,
        package: SomeSubstitutionsType = "rclpy_components",
        executable: SomeSubstitutionsType = "component_container",
        **kwargs: Any,
    ) -> None:
        super().__init__(
            package=package, executable=executable, name=name, namespace=namespace, **kwargs
        )
        self._descriptions = list(composable_node_descriptions or ())

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: Iterable[str] | None = None
    ) -> tuple[type[ComposableNodeContainer], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser, ignore)
        kwargs["composable_node_descriptions"] = parse_composable_nodes(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        entities = super().execute(context) or []
        if not self._descriptions:
            return entities
        return [
            *entities,
            LoadComposableNodes(
                composable_node_descriptions=self._descriptions, target_container=self
            ),
        ]
