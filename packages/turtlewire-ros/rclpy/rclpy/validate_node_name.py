"""The rules for node names."""

from __future__ import annotations

from turtlewire.wire import names

from .exceptions import InvalidNodeNameException


def validate_node_name(node_name: str) -> bool:
    """Check the base name of a node.

    Returns:
        True.

    Raises:
        InvalidNodeNameException: The name is invalid.
    """
    fault = names.validate_node_name(node_name)
    if fault is not None:
        raise InvalidNodeNameException(node_name, fault.message, fault.invalid_index)
    return True
