"""Finding installed packages."""

from __future__ import annotations

import os
import pathlib

from ament_index_python.search_paths import get_search_paths


class PackageNotFoundError(KeyError):
    """The package is in no prefix."""

    #: A line that says why: not sourced, not built or misspelt; empty if unknown.
    hint: str = ""


def get_package_prefix(package_name: str) -> str:
    """Return the prefix in which the package is installed, for example ``/opt/ros/jazzy``.

    Raises:
        PackageNotFoundError: The package is in no prefix.
        ValueError: The name cannot be that of a package.
        OSError: No prefix was found.
    """
    from turtlewire_ros.prefix import package_prefix

    _check_name(package_name)
    paths = get_search_paths()
    prefix = package_prefix(package_name)
    if prefix is None:
        from turtlewire_ros.workspace_hints import package_hint

        error = PackageNotFoundError(f"package '{package_name}' not found, searching: {paths}")
        error.hint = package_hint(package_name)
        raise error
    return prefix


def get_packages_with_prefixes() -> dict[str, str]:
    """Return all installed packages, each with its prefix; of equal names the one found first."""
    from turtlewire_ros.prefix import package_names

    return package_names()


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Return the folder with the package's data, for example ``/opt/ros/jazzy/share/turtlesim``.

    Args:
        package_name: The package.
        print_warning: Warn on stderr when the folder does not exist.

    Raises:
        PackageNotFoundError: The package is not installed.
    """
    from turtlewire_ros.prefix import share_directory

    get_package_prefix(package_name)
    path = share_directory(package_name)
    assert path is not None  # the prefix was found above
    if print_warning and not os.path.exists(path):
        import warnings

        warnings.warn(f"Share directory for {package_name} ({path}) does not exist.", stacklevel=2)
    return path


def get_package_share_path(package_name: str, print_warning: bool = True) -> pathlib.Path:
    """Return the same as :func:`get_package_share_directory`, as a path object."""
    return pathlib.Path(get_package_share_directory(package_name, print_warning))


def _check_name(package_name: str) -> None:
    if not package_name:
        raise ValueError("package name must not be empty")
    if os.path.basename(package_name) != package_name or package_name in (".", ".."):
        raise ValueError(f"'{package_name}' is not a valid package name")
