"""Resources of the index: a file for each, in a folder for each type of resource."""

from __future__ import annotations

import os

from ament_index_python.constants import RESOURCE_INDEX_SUBFOLDER
from ament_index_python.search_paths import get_search_paths

__all__ = [
    "RESOURCE_INDEX_SUBFOLDER",
    "InvalidResourceNameError",
    "InvalidResourceTypeNameError",
    "get_resource",
    "get_resource_types",
    "get_resources",
    "has_resource",
    "name_is_invalid",
]


class InvalidResourceTypeNameError(Exception):
    """A type of resource cannot be the name of a folder."""


class InvalidResourceNameError(Exception):
    """A resource cannot be the name of a file."""


def name_is_invalid(resource_name: str) -> bool:
    """Return True if the name contains a separator of path components."""
    return any(separator in resource_name for separator in ("/", "\\"))


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Return the content of a resource, and the prefix that has it.

    Raises:
        LookupError: No prefix has it.
        InvalidResourceTypeNameError: The type is not valid.
        InvalidResourceNameError: The name is not valid.
    """
    prefix = has_resource(resource_type, resource_name)
    if not prefix:
        raise LookupError(
            f"Could not find the resource '{resource_name}' of type '{resource_type}'"
        )
    with open(
        os.path.join(str(prefix), RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name),
        encoding="utf-8",
    ) as file:
        return file.read(), str(prefix)


def has_resource(resource_type: str, resource_name: str) -> str | bool:
    """Return the prefix that has the resource, or False."""
    _check_type(resource_type)
    if not resource_name or name_is_invalid(resource_name):
        raise InvalidResourceNameError(f"Resource name '{resource_name}' is invalid")
    for prefix in get_search_paths():
        if os.path.isfile(
            os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name)
        ):
            return prefix
    return False


def get_resources(resource_type: str) -> dict[str, str]:
    """Return all resources of a type, each with its prefix."""
    _check_type(resource_type)
    resources: dict[str, str] = {}
    for prefix in get_search_paths():
        folder = os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type)
        if os.path.isdir(folder):
            for name in os.listdir(folder):
                if not name.startswith(".") and os.path.isfile(os.path.join(folder, name)):
                    # The first prefix wins, because an overlay comes before its underlay.
                    resources.setdefault(name, prefix)
    return resources


def get_resource_types() -> set[str]:
    """Return all types of resources that any prefix has."""
    types: set[str] = set()
    for prefix in get_search_paths():
        folder = os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER)
        if os.path.isdir(folder):
            types |= {
                name
                for name in os.listdir(folder)
                if not name.startswith(".") and os.path.isdir(os.path.join(folder, name))
            }
    return types


def _check_type(resource_type: str) -> None:
    if not resource_type or name_is_invalid(resource_type):
        raise InvalidResourceTypeNameError(f"Resource type '{resource_type}' is invalid")
