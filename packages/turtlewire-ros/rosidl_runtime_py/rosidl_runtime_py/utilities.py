"""Interface classes by their names."""

from __future__ import annotations

from typing import Any

from rosidl_runtime_py.import_message import import_message_from_namespaced_type
from turtlewire.msg import Action, Message, Service
from turtlewire.msg.types import NamespacedType


def get_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type of a name like ``geometry_msgs/msg/Twist``.

    Raises:
        ValueError: ``identifier`` does not have three parts.
    """
    parts = identifier.split("/")
    if len(parts) != 3 or not all(part.isidentifier() for part in parts):
        raise ValueError(
            f"Expected the full name of an interface (package/msg/Name), got '{identifier}'"
        )
    return NamespacedType.parse(identifier)


def get_message_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type of a message's name, ``geometry_msgs/msg/Twist`` or ``geometry_msgs/Twist``.

    Raises:
        ValueError: ``identifier`` is not the name of a message.
    """
    return _namespaced_type(identifier, "msg", "message")


def get_service_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type of a service's name, ``turtlesim/srv/Spawn`` or ``turtlesim/Spawn``.

    Raises:
        ValueError: ``identifier`` is not the name of a service.
    """
    return _namespaced_type(identifier, "srv", "service")


def get_action_namespaced_type(identifier: str) -> NamespacedType:
    """Return an action's type, ``turtlesim/action/RotateAbsolute`` or without the middle.

    Raises:
        ValueError: ``identifier`` is not the name of an action.
    """
    return _namespaced_type(identifier, "action", "action")


def _namespaced_type(identifier: str, kind: str, word: str) -> NamespacedType:
    found = get_namespaced_type(_full_name(identifier, kind))
    if found.namespaces[-1] != kind:
        raise ValueError(f"Expected the full name of a {word}, got '{identifier}'")
    return found


def get_interface(identifier: str) -> Any:
    """Return the class of a message, service or action.

    Raises:
        ValueError: ``identifier`` is not the name of an interface.
        ModuleNotFoundError: The package is unknown.
        AttributeError: The package has no such interface.
    """
    return import_message_from_namespaced_type(get_namespaced_type(identifier))


def get_message(identifier: str) -> Any:
    """Return the class of a message, ``geometry_msgs/msg/Twist`` or ``geometry_msgs/Twist``.

    Raises as `get_interface` does.
    """
    return _get(identifier, "msg", Message, "a message")


def get_service(identifier: str) -> Any:
    """Return the class of a service, ``turtlesim/srv/Spawn`` or ``turtlesim/Spawn``.

    Raises as `get_interface` does.
    """
    return _get(identifier, "srv", Service, "a service")


def get_action(identifier: str) -> Any:
    """Return the class of an action, ``turtlesim/action/RotateAbsolute`` or without the middle.

    Raises as `get_interface` does.
    """
    return _get(identifier, "action", Action, "an action")


def is_message(interface: Any) -> bool:
    """Return True if it is a message class."""
    return isinstance(interface, type) and issubclass(interface, Message)


def is_service(interface: Any) -> bool:
    """Return True if it is a service class."""
    return isinstance(interface, type) and issubclass(interface, Service)


def is_action(interface: Any) -> bool:
    """Return True if it is an action class."""
    return isinstance(interface, type) and issubclass(interface, Action)


def _get(identifier: str, kind: str, base: type, word: str) -> Any:
    interface = get_interface(_full_name(identifier, kind))
    if not (isinstance(interface, type) and issubclass(interface, base)):
        # ROS 2's class.
        raise ValueError(f"Expected the full name of {word}, got '{identifier}'")  # noqa: TRY004
    return interface


def _full_name(identifier: str, kind: str) -> str:
    return identifier.replace("/", f"/{kind}/") if identifier.count("/") == 1 else identifier
