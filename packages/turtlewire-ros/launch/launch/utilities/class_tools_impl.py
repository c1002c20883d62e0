"""Checks of objects and their classes."""

from __future__ import annotations

import inspect
from typing import Any, TypeGuard, TypeVar

_T = TypeVar("_T")


def isclassinstance(obj: object) -> bool:
    """Return True if ``obj`` is an instance of a class, and no class, function or module itself."""
    is_other = inspect.isclass(obj) or inspect.ismodule(obj) or inspect.isroutine(obj)
    return hasattr(obj, "__class__") and not is_other


def is_a(obj: Any, entity_type: type[_T]) -> TypeGuard[_T]:
    """Return True if ``obj`` is an instance of the type."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: Any, entity_type: type) -> bool:
    """Return True if ``obj`` is an instance or a subclass of the type."""
    return isinstance(obj, entity_type) or (inspect.isclass(obj) and issubclass(obj, entity_type))
