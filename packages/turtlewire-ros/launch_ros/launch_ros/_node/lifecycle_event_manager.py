"""Events of a managed node's transitions, and transitions from events."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handler import EventHandler
from launch.utilities import perform_substitutions
from launch_ros._node.lifecycle import change_states
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext


class LifecycleEventManager:
    """Makes events of a managed node's transitions, and transitions of ``ChangeState`` events.

    Args:
        lifecycle_node: The action or description of the node.
    """

    def __init__(self, lifecycle_node: Any) -> None:
        self._lifecycle_node = lifecycle_node
        self._node_name: str | None = None

    @property
    def node_name(self) -> str | None:
        """Full name of the node; None before :meth:`setup_lifecycle_manager`."""
        return self._node_name

    def setup_lifecycle_manager(self, context: LaunchContext) -> None:
        """Begin to watch the node, which may not run yet."""
        from lifecycle_msgs.msg import TransitionEvent

        self._node_name = self._full_name(context)
        context.register_event_handler(
            EventHandler(matcher=self._is_mine, entities=self._on_change_state)
        )
        node, action = get_ros_node(context), self._lifecycle_node
        node.create_subscription(
            TransitionEvent,
            f"{self._node_name}/transition_event",
            lambda message: context.emit_event_sync(StateTransition(action=action, msg=message)),
            10,
        )

    @property
    def _is_action(self) -> bool:
        return isinstance(self._lifecycle_node.node_name, str)

    def _full_name(self, context: LaunchContext) -> str:
        node = self._lifecycle_node
        if self._is_action:
            return str(node.node_name)
        namespace = prefix_namespace(
            context.launch_configurations.get("ros_namespace"),
            perform_substitutions(context, node.node_namespace or []),
        )
        name = perform_substitutions(context, node.node_name)
        return f"{make_namespace_absolute(namespace or '').rstrip('/')}/{name}"

    def _is_mine(self, event: Event) -> bool:
        # A description has no full name to match; this manager has.
        matched: Any = self._lifecycle_node if self._is_action else self
        return isinstance(event, ChangeState) and event.lifecycle_node_matcher(matched)

    def _on_change_state(self, event: Event, context: LaunchContext) -> None:
        assert isinstance(event, ChangeState)
        assert context.asyncio_loop is not None
        assert self._node_name is not None
        change = change_states(context, self._node_name, [event.transition_id])
        context.add_completion_future(context.asyncio_loop.create_task(change))
