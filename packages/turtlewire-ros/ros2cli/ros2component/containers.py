"""Containers of nodes (components): the options of verbs, and calls to containers."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, assignment
from ros2cli.completion import packages

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode
    from turtlewire.wire.base import Graph

_LEVELS = ("unknown", "debug", "info", "warn", "error", "fatal")
_SERVICE = "/_container/load_node"
_TYPE = "composition_interfaces/srv/LoadNode"
_DISCOVERY_S = 30.0

#: Seconds to wait for the list of a container's nodes.
LIST_TIMEOUT_S = 5.0

COMPONENT_ARGUMENTS = (
    argument("package_name", help="Name of the package", completer=packages),
    argument(
        "plugin_name",
        help="Name of the component: package.module.Class of a Python node,"
        " package::Class in a C++ container",
    ),
    argument("-n", "--node-name", default="", help="Name of the node"),
    argument("--node-namespace", default="", help="Namespace of the node"),
    argument("--log-level", choices=_LEVELS, help="Lowest severity to log"),
    argument("-r", "--remap-rules", nargs="+", default=[], help="Remappings of names, as from:=to"),
    argument(
        "-p",
        "--parameter",
        dest="parameters",
        action="append",
        type=assignment,
        default=[],
        help="A parameter, as name:=value",
    ),
    argument(
        "-e",
        "--extra-argument",
        dest="extra_arguments",
        action="append",
        type=assignment,
        default=[],
        help="An argument for the container, as name:=value",
    ),
)


def container_node_names(**_: Any) -> list[str]:
    """Return the full names of the containers there are now."""
    from ros2cli.discovery import discovered_graph

    with discovered_graph() as known:
        return container_names(known)


def load_request(args: argparse.Namespace) -> Any:
    """Return the ``composition_interfaces/srv/LoadNode`` request that the options describe."""
    from composition_interfaces.srv import LoadNode
    from rcl_interfaces.msg import Parameter
    from rclpy.parameter import get_parameter_value

    def messages(pairs: list[tuple[str, str]]) -> list[Any]:
        return [Parameter(name=name, value=get_parameter_value(text)) for name, text in pairs]

    return LoadNode.Request(
        package_name=args.package_name,
        plugin_name=args.plugin_name,
        node_name=args.node_name,
        node_namespace=args.node_namespace,
        # rclpy's severities are multiples of ten.
        log_level=_LEVELS.index(args.log_level or "unknown") * 10,
        remap_rules=args.remap_rules,
        parameters=messages(args.parameters),
        extra_arguments=messages(args.extra_arguments),
    )


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
