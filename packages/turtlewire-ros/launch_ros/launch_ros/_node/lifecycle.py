"""Changes the states of managed nodes, and makes events of their transitions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.conditions import evaluate_condition_expression
from launch.event_handler import EventHandler
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import call_service, get_ros_node
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

#: Configure and activate, by the numbers of `lifecycle_msgs`, whose import would slow each launch.
TO_ACTIVE = (1, 3)


class Autostart:
    """The argument ``autostart``: true, false, or text that evaluates to one of these words.

    Args:
        given: The argument of an action or description.
    """

    def __init__(self, given: bool | SomeSubstitutionsType) -> None:
        self.given: bool | list[Substitution] = (
            given if isinstance(given, bool) else normalize_to_list_of_substitutions(given)
        )

    def evaluate(self, context: LaunchContext) -> bool:
        """Return True if the node is to be configured and activated.

        Raises:
            InvalidConditionExpressionError: The text is something else.
        """
        if isinstance(self.given, bool):
            return self.given
        return evaluate_condition_expression(context, self.given)


async def change_states(
    context: LaunchContext, node_name: str, transition_ids: Iterable[int]
) -> None:
    """Ask a managed node for transitions, one after the other, until one fails."""
    for transition_id in transition_ids:
        if not await _change_state(context, node_name, transition_id):
            return


async def _change_state(context: LaunchContext, node_name: str, transition_id: int) -> bool:
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState as ChangeStateService

    # ROS 2's name of the logger.
    logger = logging.get_logger("launch_ros.actions.lifecycle_node")
    request = ChangeStateService.Request(transition=Transition(id=transition_id))
    # Waits for the service: the node's process may have just been started.
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
