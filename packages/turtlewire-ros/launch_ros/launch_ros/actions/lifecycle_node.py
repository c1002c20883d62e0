"""Runs a managed node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch import logging
from launch.event_handler import EventHandler
from launch_ros.actions.node import Node
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import call_service, get_ros_node

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LifecycleNode", "change_state"]


class LifecycleNode(Node):
    """Runs a managed node.

    Changes of its state become events, and :class:`ChangeState` events change its state.

    Args:
        name: Name of the node.
        namespace: Namespace of the node.
        **kwargs: See :class:`Node`.
    """

    def __init__(
        self, *, name: SomeSubstitutionsType, namespace: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Run the process, and watch the node's state."""
        from lifecycle_msgs.msg import TransitionEvent

        node = get_ros_node(context)
        entities = super().execute(context)
        context.register_event_handler(
            EventHandler(matcher=self._is_mine, entities=self._on_change_state)
        )
        node.create_subscription(
            TransitionEvent,
            f"{self.node_name}/transition_event",
            lambda message: context.emit_event_sync(StateTransition(action=self, msg=message)),
            10,
        )
        return entities

    def _is_mine(self, event: Event) -> bool:
        return isinstance(event, ChangeState) and event.lifecycle_node_matcher(self)

    def _on_change_state(self, event: Event, context: LaunchContext) -> None:
        assert isinstance(event, ChangeState)
        assert context.asyncio_loop is not None
        change = change_state(context, self.node_name, event.transition_id)
        context.add_completion_future(context.asyncio_loop.create_task(change))


async def change_state(context: LaunchContext, node_name: str, transition_id: int) -> bool:
    """Ask a managed node for a transition; whether it succeeded."""
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState as ChangeStateService

    logger = logging.get_logger("launch_ros.actions.lifecycle_node")
    request = ChangeStateService.Request(transition=Transition(id=transition_id))
    response = await call_service(context, ChangeStateService, f"{node_name}/change_state", request)
    if response is None:
        logger.warning(
            "Abandoning wait for the '%s/change_state' service response, due to shutdown.",
            node_name,
        )
        return False
    if not response.success:
        logger.error(
            "Failed to make transition '%s' for LifecycleNode '%s'",
            _transition_name(transition_id),
            node_name,
        )
    return bool(response.success)


def _transition_name(transition_id: int) -> str:
    from lifecycle_msgs.msg import Transition

    names = [
        name
        for name in dir(Transition)
        if name.startswith("TRANSITION_") and getattr(Transition, name) == transition_id
    ]
    return names[0] if names else str(transition_id)
