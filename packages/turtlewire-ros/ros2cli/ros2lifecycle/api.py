"""Managed nodes: their states and transitions, and what the verbs of ``ros2 lifecycle`` share.

The calls take names of several nodes and return a dictionary by these names. The value of a node
that failed to answer is the exception.
"""

from __future__ import annotations

import argparse
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.listing import HIDDEN_NODES
from ros2cli.node.direct import DirectNode
from ros2node.api import parse_node_name

if TYPE_CHECKING:
    from ros2node.api import NodeName
    from turtlewire.wire.base import Graph

_SERVICE = "/get_state"
_TYPE = "lifecycle_msgs/srv/GetState"

DEFAULT_TIMEOUT_S = 5.0


def get_node_names(*, node: Any, include_hidden_nodes: bool = False) -> list[NodeName]:
    """Return the names of the managed nodes that a node sees, sorted."""
    graph = DirectNode.around(node).graph
    names = managed_nodes(graph, hidden=include_hidden_nodes)
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
            answers[name] = ask(direct, service_class, full_name, request, timeout)
        except RuntimeError as error:
            answers[name] = error
    return answers


def managed_nodes(graph: Graph, *, hidden: bool = False) -> list[str]:
    """Return the full names of the nodes that have lifecycle services, sorted."""
    from ros2cli.graph import is_hidden_node, services

    names = [
        name.removesuffix(_SERVICE)
        for name, types in services(graph, hidden=True)
        if name.endswith(_SERVICE) and _TYPE in types
    ]
    return sorted(name for name in names if hidden or not is_hidden_node(name))


def managed_node_names(**_: Any) -> list[str]:
    """Return the full names of the managed nodes there are now."""
    from ros2cli.discovery import discovered_graph

    with discovered_graph() as known:
        return managed_nodes(known)


HIDDEN_ARGUMENT = argument(
    "--include-hidden-nodes",
    action="store_true",
    help=HIDDEN_NODES,
)


def require_managed_node(graph: Graph, args: argparse.Namespace) -> str:
    """Return the full name of the managed node on the command line.

    Raises:
        RuntimeError: The name is unknown.
    """
    from ros2cli.graph import full_node_name
    from ros2cli.suggestion import did_you_mean

    full_name = full_node_name(args.node_name)
    known = managed_nodes(graph, hidden=args.include_hidden_nodes)
    if full_name not in known:
        raise RuntimeError(f"Node not found{did_you_mean(full_name, known)}")
    return full_name


def ask(
    direct: DirectNode,
    service_class: Any,
    service: str,
    request: Any,
    timeout: float | None = DEFAULT_TIMEOUT_S,
) -> Any:
    """Call a service of a managed node.

    Args:
        direct: The node that asks.
        service_class: Class of the service.
        service: Full name of the service.
        request: The request.
        timeout: Seconds to wait for the answer; None waits while the service exists.

    Raises:
        RuntimeError: The server does not answer, or would misread the request.
    """
    client = direct.node.create_client(service_class, service)
    if not direct.wait_for_server(client.service_name, client.service_is_ready, DEFAULT_TIMEOUT_S):
        raise RuntimeError(f"The service {service} is not available")
    future, server = client.call_async(request), f"service '{client.srv_name}'"
    try:
        return direct.answer(future, server, client.service_is_ready, timeout)
    except TimeoutError as error:
        name = service.rpartition("/")[2]
        raise RuntimeError(
            f"Timed out waiting for {name} response (timeout: {timeout}s)"
        ) from error
