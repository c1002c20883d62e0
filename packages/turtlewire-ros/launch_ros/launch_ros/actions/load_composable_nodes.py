"""Loads nodes into the process of a container."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.action import Action
from launch.event_handlers import OnProcessExit
from launch.frontend import Entity, expose_action
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch_ros._node.lifecycle import TO_ACTIVE, change_states
from launch_ros.actions.node import Node
from launch_ros.descriptions.composable_lifecycle_node import ComposableLifecycleNode
from launch_ros.descriptions.composable_node import ComposableNode
from launch_ros.ros_adapters import call_service, get_ros_node
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace
from launch_ros.utilities.track_node_names import add_node_name

if TYPE_CHECKING:
    import asyncio

    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = [
    "LoadComposableNodes",
    "SomeSubstitutionsType_types_tuple",
    "get_composable_node_load_request",
    "parse_composable_nodes",
]


def get_composable_node_load_request(
    composable_node_description: ComposableNode, context: LaunchContext
) -> Any:
    """Return the request that loads a node, a ``composition_interfaces/srv/LoadNode.Request``.

    Args:
        composable_node_description: The node.
        context: The launch; its scope adds namespace, parameters and remappings.

    Returns:
        The request, or None if the node's condition is false.
    """
    if not composable_node_description.is_wanted(context):
        return None
    return composable_node_description.load_request(context)


def parse_composable_nodes(entity: Entity, parser: Parser) -> list[ComposableNode]:
    """Return the ``composable_node`` elements in an element, then the managed ones."""
    classes = {
        "composable_node": ComposableNode,
        "composable_lifecycle_node": ComposableLifecycleNode,
    }
    return [
        description.parse(parser, node)
        for name, description in classes.items()
        for node in entity.get_attr(name, data_type=list[Entity], optional=True) or ()
    ]


@expose_action("load_composable_node")
class LoadComposableNodes(Action):
    """Loads nodes into the process of a container, one after the other, once it is ready.

    Then it activates those whose description has ``autostart``.

    Args:
        composable_node_descriptions: The nodes.
        target_container: The container: the action that starts it, or its full name.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(
        self,
        *,
        composable_node_descriptions: Iterable[ComposableNode],
        target_container: SomeSubstitutionsType | Node,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        kinds = (*SomeSubstitutionsType_types_tuple, Node)
        ensure_argument_type(target_container, kinds, "target_container", "LoadComposableNodes")
        self._descriptions = list(composable_node_descriptions)
        self._container = target_container
        self._logger = logging.get_logger(__name__)
        self._task: asyncio.Task[None] | None = None

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[LoadComposableNodes], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["target_container"] = parser.parse_substitution(entity.get_attr("target"))
        kwargs["composable_node_descriptions"] = parse_composable_nodes(entity, parser)
        if not kwargs["composable_node_descriptions"]:
            raise ValueError(
                "Must provide at least one composable_node or composable_lifecycle_node"
            )
        return cls, kwargs

    def get_asyncio_future(self) -> asyncio.Task[None] | None:
        """Done when all are loaded and active."""
        return self._task

    def execute(self, context: LaunchContext) -> None:
        """Begin to load them."""
        if context.is_shutdown:
            return
        assert context.asyncio_loop is not None
        # Made now: the scope of the launch file may have ended when the container is ready.
        requests = []
        get_ros_node(context)
        for each in self._descriptions:
            request = get_composable_node_load_request(each, context)
            if request is not None:
                requests.append((each, request))
                if isinstance(each, ComposableLifecycleNode):
                    each.init_lifecycle_event_manager(context)
        self._task = context.asyncio_loop.create_task(
            self._load(context, self._container_name(context), requests)
        )
        if isinstance(self._container, Node):
            context.register_event_handler(
                OnProcessExit(target_action=self._container, on_exit=self._abandon)
            )

    def _abandon(self, *_: Any) -> None:
        """Stop waiting; the container has ended and will not answer."""
        assert self._task is not None
        self._task.cancel()

    def _container_name(self, context: LaunchContext) -> str:
        if isinstance(self._container, Node):
            return self._container.node_name
        name = perform_substitutions(context, normalize_to_list_of_substitutions(self._container))
        return make_namespace_absolute(
            prefix_namespace(context.launch_configurations.get("ros_namespace"), name) or name
        )

    async def _load(
        self, context: LaunchContext, container: str, requests: list[tuple[ComposableNode, Any]]
    ) -> None:
        from composition_interfaces.srv import LoadNode

        starting: list[str] = []
        for description, request in requests:
            response = await call_service(
                context, LoadNode, f"{container}/_container/load_node", request
            )
            if response is None:
                self._logger.warning(
                    "Abandoning wait for the '%s' service, due to shutdown.",
                    f"{container}/_container/load_node",
                )
                return
            if response.success:
                self._logger.info(
                    "Loaded node '%s' in container '%s'", response.full_node_name, container
                )
                self._warn_of_equal_names(context, response.full_node_name)
                if isinstance(description, ComposableLifecycleNode) and description.starts_itself(
                    context
                ):
                    starting.append(response.full_node_name)
            else:
                self._logger.error(
                    "Failed to load node '%s' of type '%s' in container '%s': %s",
                    *(request.node_name, request.plugin_name, container, response.error_message),
                )
        for name in starting:
            await change_states(context, name, TO_ACTIVE)

    def _warn_of_equal_names(self, context: LaunchContext, name: str) -> None:
        count = add_node_name(context, name)
        if count > 1:
            self._logger.warning(
                "there are now at least %s nodes with the name %s "
                "created within this launch context",
                count,
                name,
            )
