"""Installed packages and their executables, completions."""

from __future__ import annotations

from typing import Any

from ros2cli import completion

__all__ = [
    "PackageNotFound",
    "get_executable_paths",
    "get_package_names",
    "get_prefix_path",
    "package_name_completer",
]


class PackageNotFound(Exception):
    """There is no package of the name.

    Args:
        package_name: The name.
    """

    def __init__(self, package_name: str) -> None:
        super().__init__(package_name)
        self.package_name = package_name


def get_package_names() -> Any:
    """Return the names of all installed packages."""
    from turtlewire_ros.prefix import package_names

    return package_names().keys()


def get_prefix_path(package_name: str) -> str | None:
    """Return the prefix in which a package is installed; None if there is no such package."""
    from turtlewire_ros.prefix import package_prefix

    return package_prefix(package_name)


def get_executable_paths(*, package_name: str) -> list[str]:
    """Return the paths of the executables of a package, sorted.

    Raises:
        PackageNotFound: There is no such package.
    """
    from turtlewire_ros.executables import executable_paths

    paths = executable_paths(package_name)
    if paths is None:
        raise PackageNotFound(package_name)
    return paths


def package_name_completer(**kwargs: Any) -> list[str]:
    """Return the names of all installed packages."""
    return completion.packages(**kwargs)
