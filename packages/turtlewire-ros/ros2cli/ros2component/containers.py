"""Calls to containers of nodes (components)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode
    from turtlewire.wire.base import Graph

_SERVICE = "/_container/load_node"
_TYPE = "composition_interfaces/srv/LoadNode"
_DISCOVERY_S = 30.0

#: Seconds to wait for the list of a container's nodes.
LIST_TIMEOUT_S = 5.0


def container_names(graph: Graph) -> list[str]:
    """Return the full names of the nodes that load components, sorted."""
    from ros2cli.graph import services

    return [
        name.removesuffix(_SERVICE)
        for name, types in services(graph, hidden=True)
        if name.endswith(_SERVICE) and _TYPE in types
    ]


def require_container(graph: Graph, name: str) -> str:
    """Return the full name of a container.

    Raises:
        RuntimeError: The name is unknown.
    """
    from ros2cli.graph import full_node_name
    from ros2cli.suggestion import did_you_mean

    full_name, known = full_node_name(name), container_names(graph)
    if full_name not in known:
        raise RuntimeError(f"Unable to find container node '{name}'{did_you_mean(name, known)}")
    return full_name


def ask(
    direct: DirectNode,
    container: str,
    verb: str,
    service_class: Any,
    request: Any,
    timeout: float | None = None,
) -> Any:
    """Call one of a container's services.

    Args:
        direct: The node that asks.
        container: Full name of the container.
        verb: ``load_node``, ``unload_node`` or ``list_nodes``.
        service_class: Class of the service.
        request: The request.
        timeout: Seconds to wait for the answer; None waits while the container exists.

    Raises:
        RuntimeError: The container does not answer, or would misread the request.
    """
    client = direct.node.create_client(service_class, f"{container}/_container/{verb}")
    if not direct.wait_for_server(client.service_name, client.service_is_ready, _DISCOVERY_S):
        raise RuntimeError(f"The service {client.srv_name} is not available")
    server = f"service '{client.srv_name}'"
    try:
        future = client.call_async(request)
        return direct.answer(future, server, client.service_is_ready, timeout)
    except TimeoutError as error:
        raise RuntimeError(
            f"Timed out waiting for {verb} response from '{container}' container"
            f" (timeout: {timeout}s)"
        ) from error
