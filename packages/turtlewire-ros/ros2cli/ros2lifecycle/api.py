"""States and transitions of managed nodes.

The calls take names of several nodes and return a dictionary by these names. The value of a node
that failed to answer is the exception.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

from ros2cli.node.direct import DirectNode
from ros2lifecycle import managed_nodes
from ros2node.api import parse_node_name

if TYPE_CHECKING:
    from ros2node.api import NodeName


def get_node_names(*, node: Any, include_hidden_nodes: bool = False) -> list[NodeName]:
    """Return the names of the managed nodes that a node sees, sorted."""
    graph = DirectNode.around(node).graph
    names = managed_nodes.managed_nodes(graph, hidden=include_hidden_nodes)
    return [parse_node_name(name) for name in names]


def call_get_states(
    *, node: Any, node_names: Collection[str], timeout: float | None = None
) -> dict[str, Any]:
    """Return the states by node: ``lifecycle_msgs/msg/State`` messages.

    Args:
        node: The node that asks.
        node_names: Full names of the nodes that are asked.
        timeout: Seconds to wait for each answer; None waits while the node exists.
    """
    from lifecycle_msgs.srv import GetState

    requests = {name: GetState.Request() for name in node_names}
    answers = _ask_all(node, GetState, "get_state", requests, timeout)
    return {name: getattr(answer, "current_state", answer) for name, answer in answers.items()}


def call_change_states(
    *, node: Any, transitions: Mapping[str, Any], timeout: float | None = None
) -> dict[str, Any]:
    """Trigger transitions.

    Args:
        node: The node that asks.
        transitions: ``lifecycle_msgs/msg/Transition`` messages by node.
        timeout: Seconds to wait for each answer; None waits while the node exists.

    Returns:
        Whether each of them succeeded, by node.
    """
    from lifecycle_msgs.srv import ChangeState

    requests = {name: ChangeState.Request(transition=each) for name, each in transitions.items()}
    answers = _ask_all(node, ChangeState, "change_state", requests, timeout)
    return {name: getattr(answer, "success", answer) for name, answer in answers.items()}


def call_get_available_transitions(
    *, node: Any, states: Mapping[str, Any], timeout: float | None = None
) -> dict[str, Any]:
    """Return the possible transitions by node: lists of ``TransitionDescription`` messages.

    Args:
        node: The node that asks.
        states: The keys are the names of the nodes.
        timeout: Seconds to wait for each answer; None waits while the node exists.
    """
    return _transitions(node, states, "get_available_transitions", timeout)


def call_get_transition_graph(
    *, node: Any, states: Mapping[str, Any], timeout: float | None = None
) -> dict[str, Any]:
    """Return all transitions by node, as `call_get_available_transitions`."""
    return _transitions(node, states, "get_transition_graph", timeout)


def _transitions(
    node: Any, states: Mapping[str, Any], service: str, timeout: float | None
) -> dict[str, Any]:
    from lifecycle_msgs.srv import GetAvailableTransitions

    requests = {name: GetAvailableTransitions.Request() for name in states}
    answers = _ask_all(node, GetAvailableTransitions, service, requests, timeout)
    return {
        name: getattr(answer, "available_transitions", answer) for name, answer in answers.items()
    }


def _ask_all(
    node: Any,
    service_class: Any,
    service: str,
    requests: Mapping[str, Any],
    timeout: float | None,
) -> dict[str, Any]:
    direct = DirectNode.around(node)
    answers: dict[str, Any] = {}
    for name, request in requests.items():
        full_name = f"{name}/{service}"
        try:
            answers[name] = managed_nodes.ask(direct, service_class, full_name, request, timeout)
        except RuntimeError as error:
            answers[name] = error
    return answers
