"""Entry points that installed packages declare, found without loading the metadata of all."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

__all__ = ["declared"]


def declared(group: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group by name.

    The files of the packages on the path are searched for the name of the group before Python's
    own reader is imported, which takes longer than that.
    """
    if not _is_declared(group):
        return {}
    from importlib.metadata import entry_points

    return {entry.name: entry for entry in entry_points(group=group)}


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
