"""The rules for topic and service names, for a fully qualified name."""

from __future__ import annotations

from turtlewire.wire import names

from .exceptions import InvalidServiceNameException, InvalidTopicNameException


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Check a fully qualified name.

    Args:
        name: The name.
        is_service: Whether it is a service's.

    Returns:
        True.

    Raises:
        InvalidTopicNameException, InvalidServiceNameException: It breaks a rule.
    """
    fault = names.validate_full_topic_name(name)
    if fault is not None:
        error = InvalidServiceNameException if is_service else InvalidTopicNameException
        raise error(name, fault.message, fault.invalid_index)
    return True
