"""``ros2 interface proto``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.completion import interfaces

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    argument(
        "type",
        help="Name of the interface, for example geometry_msgs/msg/Twist",
        completer=interfaces,
    ),
    argument("--no-quotes", action="store_true", help="Without the quotes that a shell needs"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the default values as YAML."""
    from rosidl_runtime_py import message_to_yaml
    from rosidl_runtime_py.utilities import get_interface, is_action, is_service

    try:
        interface = get_interface(args.type)
    except (AttributeError, ModuleNotFoundError, ValueError) as error:
        from ros2cli.suggestion import interface_meant

        return f"{type(error).__name__}: {error}{interface_meant(args.type)}"
    if is_service(interface):
        interface = interface.Request
    elif is_action(interface):
        interface = interface.Goal
    text = message_to_yaml(interface())
    print(text if args.no_quotes else f'"{text}"')
    return None
