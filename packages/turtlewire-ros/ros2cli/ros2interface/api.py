"""Interfaces as YAML, completions."""

from __future__ import annotations

from typing import Any

from ros2cli import completion


def interface_to_yaml(identifier: str) -> str:
    """Default values of a message, of a service's request or of an action's goal, as YAML.

    Args:
        identifier: Name of the interface, for example ``geometry_msgs/msg/Twist``.

    Raises:
        ValueError: ``identifier`` is not the name of an interface.
        ModuleNotFoundError: The package is unknown.
        AttributeError: The package has no such interface.
    """
    from rosidl_runtime_py import message_to_yaml
    from rosidl_runtime_py.utilities import get_interface, is_action, is_service

    interface = get_interface(identifier)
    if is_service(interface):
        interface = interface.Request
    elif is_action(interface):
        interface = interface.Goal
    return message_to_yaml(interface())


def get_all_interface_names() -> list[str]:
    """Return the full names of all interfaces."""
    return completion.interface_names()


def package_name_completer(**kwargs: Any) -> list[str]:
    """Return the names of the packages that have interfaces."""
    return completion.interface_packages(**kwargs)


def type_completer(**kwargs: Any) -> list[str]:
    """Return the full names of all interfaces."""
    return completion.interfaces(**kwargs)
