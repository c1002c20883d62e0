"""Changes the state of managed nodes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, ClassVar

from launch.action import Action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros._node.lifecycle import change_states
from launch_ros.events.lifecycle import StateTransition
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities.namespace_utils import make_namespace_absolute

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


def match_node_name_goal(node_name: str, goal_state: str) -> Callable[[Event], bool]:
    """Return a matcher of the events with which a managed node reaches a state.

    Args:
        node_name: Full name of the node.
        goal_state: Name of the state after the transition.
    """
    return lambda event: (
        isinstance(event, StateTransition)
        and event.action.node_name == node_name
        and event.goal_state == goal_state
    )


def match_node_name_start_goal(
    node_name: str, start_state: str, goal_state: str
) -> Callable[[Event], bool]:
    """Return a matcher of the events with which a managed node goes from a state to another.

    Args:
        node_name: Full name of the node.
        start_state: Name of the state before the transition.
        goal_state: Name of the state after the transition.
    """
    reaches_goal = match_node_name_goal(node_name, goal_state)
    return lambda event: reaches_goal(event) and getattr(event, "start_state", "") == start_state


class LifecycleTransition(Action):
    """Takes managed nodes through transitions, one after the other for each node.

    If a transition fails, the later ones of that node are left out.

    Args:
        lifecycle_node_names: Full names of the nodes.
        transition_ids: The transitions, for example ``Transition.TRANSITION_CONFIGURE``.
        **kwargs: See :class:`launch.Action`.

    Raises:
        RuntimeError: No nodes or no transitions are given.
    """

    #: The state after each transition that succeeds, by the transition's number.
    transition_targets: ClassVar[dict[int, str]] = {
        1: "inactive",  # configure
        2: "unconfigured",  # clean up
        3: "active",  # activate
        4: "inactive",  # deactivate
        5: "finalized",  # shut down when unconfigured
        6: "finalized",  # when inactive
        7: "finalized",  # when active
    }

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[SomeSubstitutionsType],
        transition_ids: Iterable[int],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._names = [normalize_to_list_of_substitutions(name) for name in lifecycle_node_names]
        self._transitions = [int(transition) for transition in transition_ids]
        if not self._names:
            raise RuntimeError("No lifecycle_node_names provided.")
        if not self._transitions:
            raise RuntimeError("No transition_ids provided.")
        self._done: asyncio.Future[Any] | None = None

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Done when all nodes have gone through their transitions."""
        return self._done

    def execute(self, context: LaunchContext) -> None:
        if context.is_shutdown:
            return
        get_ros_node(context)
        names = [
            make_namespace_absolute(perform_substitutions(context, name)) for name in self._names
        ]
        self._done = asyncio.gather(
            *(change_states(context, name, self._transitions) for name in names)
        )
