"""Imports compiled modules."""

from __future__ import annotations

import importlib
import os
from types import ModuleType

from rpyutils.add_dll_directories import add_dll_directories_from_env

_HELP = "https://docs.ros.org/en/jazzy/How-To-Guides/Installation-Troubleshooting.html"


def import_c_library(name: str, package: str | None = None) -> ModuleType:
    """Import a compiled module.

    Args:
        name: Its name; relative to ``package`` if it begins with a period.
        package: The package.

    Raises:
        ImportError: The library cannot be imported; the message names the page with the remedy.
    """
    try:
        with add_dll_directories_from_env("PATH"):
            return importlib.import_module(name, package=package)
    except ImportError as error:
        # The module exists but cannot be loaded, usually because one of its libraries is missing.
        if error.path is not None and os.path.isfile(error.path):
            error.msg += f"\nThe C extension '{error.path}' failed to be imported while being"
            error.msg += f" present on the system. Please refer to '{_HELP}' for possible solutions"
        raise
