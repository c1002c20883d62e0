"""The options that describe a component: its name, parameters and remappings."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.completion import packages
from ros2cli.values import assignment

_LEVELS = ("unknown", "debug", "info", "warn", "error", "fatal")

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
    from ros2component.containers import container_names

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
