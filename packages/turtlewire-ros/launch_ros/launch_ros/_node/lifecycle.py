"""Changes the states of managed nodes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch import logging
from launch.conditions import evaluate_condition_expression
from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.ros_adapters import call_service

if TYPE_CHECKING:
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
