"""Folders in which Windows looks for libraries."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import Any


@contextlib.contextmanager
def add_dll_directories_from_env(env_name: str) -> Iterator[None]:
    """Within it, Windows finds libraries in the folders that an environment variable lists.

    Nothing happens on other systems, which have other rules.

    Args:
        env_name: Name of the variable, for example ``PATH``.
    """
    add: Any = getattr(os, "add_dll_directory", None)
    with contextlib.ExitStack() as folders:
        # Since Python 3.8, Windows does not look in `PATH` for the libraries of a module.
        for path in os.environ.get(env_name, "").split(os.pathsep) if add else ():
            if os.path.isdir(path):
                folders.enter_context(add(path))
        yield
