"""What the shell is offered to complete a word."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

__all__ = ["executables", "interface_packages", "interfaces", "packages"]


def packages(**_: Any) -> list[str]:
    """Names of installed packages."""
    from turtlewire_ros.prefix import package_names

    return sorted(package_names())


def executables(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Names of the executables of the package on the command line."""
    from turtlewire_ros.executables import executable_paths

    return [os.path.basename(path) for path in executable_paths(parsed_args.package_name) or ()]


def interface_packages(**_: Any) -> list[str]:
    """Names of the packages that have interfaces."""
    from turtlewire import msg

    return sorted(msg.interface_names())


def interfaces(**_: Any) -> list[str]:
    """Full names of all interfaces."""
    from turtlewire import msg

    return sorted(
        f"{package}/{kind}/{name}" for package, kinds in msg.interface_names().items() for kind, names in kinds.items() for name in names
    )
