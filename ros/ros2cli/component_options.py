"""The options that describe a component: its name, parameters and remappings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.values import assignment

if TYPE_CHECKING:
    import argparse

__all__ = ["add_component_arguments", "load_request"]


def add_component_arguments(parser: argparse.ArgumentParser) -> None:
    """Define package, plugin and the options of the node."""
    from ros2cli.completion import packages

    package = parser.add_argument("package_name", help="Name of the package")
    package.completer = packages  # type: ignore[attr-defined]
    parser.add_argument(
        "plugin_name",
        help="Name of the component: package.module.Class of a node of Python,"
        " package::Class in a container of C++",
    )
    parser.add_argument("-n", "--node-name", default="", help="Name of the node")
    parser.add_argument("--node-namespace", default="", help="Namespace of the node")
    parser.add_argument("--log-level", choices=_LEVELS, help="Least severity that is logged")
    parser.add_argument(
        "-r", "--remap", dest="remap_rules", action="append", default=[], help="from:=to"
    )
    for option, target in (("-p", "parameters"), ("-e", "extra_arguments")):
        parser.add_argument(
            option,
            "--parameter" if option == "-p" else "--extra-argument",
            dest=target,
            action="append",
            type=assignment,
            default=[],
            help="name:=value, as YAML",
        )


_LEVELS = ("unknown", "debug", "info", "warn", "error", "fatal")


def load_request(args: argparse.Namespace) -> Any:
    """The ``composition_interfaces/srv/LoadNode`` request that the options describe."""
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
        log_level=max(0, (_LEVELS.index(args.log_level) if args.log_level else 0) * 10),
        remap_rules=args.remap_rules,
        parameters=messages(args.parameters),
        extra_arguments=messages(args.extra_arguments),
    )
