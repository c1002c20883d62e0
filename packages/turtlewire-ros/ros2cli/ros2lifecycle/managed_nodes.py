"""Calls to the lifecycle services of nodes."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.listing import HIDDEN_NODES

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode
    from turtlewire.wire.base import Graph

_SERVICE = "/get_state"
_TYPE = "lifecycle_msgs/srv/GetState"

DEFAULT_TIMEOUT_S = 5.0


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
