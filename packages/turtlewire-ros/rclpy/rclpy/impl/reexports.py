"""Names that ROS 2's modules have because they import them, and that programs take from there.

They are loaded at their first use, as most programs need none of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from typing import Any


def reexports(module: str, homes: Mapping[str, Iterable[str]]) -> Callable[[str], Any]:
    """Return the ``__getattr__`` of a module that hands on names of other modules.

    Args:
        module: Name of the module that hands them on.
        homes: The names by the module that they come from.
    """
    home_of = {name: home for home, names in homes.items() for name in names}

    def get(name: str) -> Any:
        if name not in home_of:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        return getattr(import_module(home_of[name]), name)

    return get
