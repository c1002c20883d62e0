"""Names of the interfaces that are installed, and their default values."""

from __future__ import annotations


def interface_names(kind: str = "") -> list[str]:
    """Full names of all interfaces, sorted; ``kind`` limits them to msg, srv or action."""
    from turtlewire import msg

    return sorted(
        f"{package}/{part}/{name}"
        for package, parts in msg.interfaces().items()
        for part, names in parts.items()
        if part == kind or not kind
        for name in names
    )


def prototype(name: str) -> str:
    """Default values of a message, of a service's request or of an action's goal, as YAML.

    Args:
        name: Full name of the interface, for example ``geometry_msgs/msg/Twist``.

    Raises:
        ValueError: ``name`` is not the name of an interface.
        ModuleNotFoundError: The package is unknown.
        AttributeError: The package has no such interface.
    """
    from rosidl_runtime_py import message_to_yaml
    from rosidl_runtime_py.utilities import get_interface, is_action, is_service

    interface = get_interface(name)
    if is_service(interface):
        interface = interface.Request
    elif is_action(interface):
        interface = interface.Goal
    return message_to_yaml(interface())
