"""The rules for namespaces."""

from __future__ import annotations

from turtlewire.wire import names

from .exceptions import InvalidNamespaceException


def validate_namespace(namespace: str) -> bool:
    """Check a fully qualified namespace.

    Returns:
        True.

    Raises:
        InvalidNamespaceException: The namespace is invalid.
    """
    fault = names.validate_namespace(namespace)
    if fault is not None:
        raise InvalidNamespaceException(namespace, fault.message, fault.invalid_index)
    return True
