"""Entry points that installed packages declare, found without loading the metadata of all."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

__all__ = ["EXTENSION_POINT_GROUP_NAME", "declared", "first_line", "load"]

#: The group by which a package declares groups for the extensions of others.
EXTENSION_POINT_GROUP_NAME = "ros2cli.extension_point"


def declared(group: str) -> dict[str, EntryPoint]:
    """Entry points of a group by name.

    The files of the packages on the path are searched for the name of the group before Python's
    own reader is imported, which takes longer than that.
    """
    if not _is_declared(group):
        return {}
    from importlib.metadata import entry_points

    return {entry.name: entry for entry in entry_points(group=group)}


def load(entry: EntryPoint) -> Any:
    """The class of an entry point; None if it cannot be loaded, which is one line on stderr."""
    try:
        return entry.load()
    # Another's module may fail in any way; the other extensions still work.
    except Exception as error:  # noqa: BLE001
        from ros2cli.output import tell

        tell(f"Failed to load entry point '{entry.name}': {type(error).__name__}: {error}")
        return None


def first_line(documented: Any) -> str:
    """First line of the documentation of a class or an object, without the period."""
    lines = (documented.__doc__ or "").strip().splitlines()
    return lines[0].strip().removesuffix(".") if lines else ""


def _is_declared(group: str) -> bool:
    section = f"[{group}]".encode()
    for folder in sys.path:
        try:
            names = os.listdir(folder or ".")
        except OSError:
            continue
        for name in names:
            if name.endswith((".dist-info", ".egg-info")):
                path = os.path.join(folder, name, "entry_points.txt")
                try:
                    with open(path, "rb") as file:
                        if section in file.read():
                            return True
                except OSError:
                    continue
    return False
