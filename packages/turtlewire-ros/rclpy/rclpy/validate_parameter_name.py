"""The rule for parameter names: ROS 2 asks for a non-empty one."""

from __future__ import annotations

from .exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> bool:
    """Check a parameter name.

    Returns:
        True.

    Raises:
        InvalidParameterException: The name is empty.
    """
    if not name:
        raise InvalidParameterException(name)
    return True
