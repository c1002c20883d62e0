"""Imports the class of a message by its type."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turtlewire.msg.types import NamespacedType


def import_message_from_namespaced_type(message_type: NamespacedType) -> Any:
    """Return the class of an interface.

    Raises:
        ModuleNotFoundError: The package is unknown.
        AttributeError: The package has no such interface.
    """
    from importlib import import_module

    return getattr(import_module(".".join(message_type.namespaces)), message_type.name)
