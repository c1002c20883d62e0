"""ROS 2's functions for the entry points of commands and verbs.

A package adds a verb to ``ros2 topic`` by an entry point in the group ``ros2topic.verb``, and a
command by one in ``ros2cli.command``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ros2cli.installed import EXTENSION_POINT_GROUP_NAME, declared, first_line, load

if TYPE_CHECKING:
    from importlib.metadata import Distribution, EntryPoint

__all__ = [
    "EXTENSION_POINT_GROUP_NAME",
    "get_all_entry_points",
    "get_entry_points",
    "get_first_line_doc",
    "load_entry_points",
]


def get_all_entry_points() -> dict[str, dict[str, tuple[Distribution, EntryPoint]]]:
    """Distribution and entry point by group and name, for all groups of installed packages."""
    from importlib.metadata import distributions

    found: dict[str, dict[str, tuple[Distribution, EntryPoint]]] = {}
    for distribution in distributions():
        for entry in distribution.entry_points:
            found.setdefault(entry.group, {}).setdefault(entry.name, (distribution, entry))
    return found


def get_entry_points(group_name: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group by name, this distribution's first."""
    from importlib.metadata import EntryPoint

    found = declared(group_name)
    return {name: EntryPoint(name, entry.value, group_name) for name, entry in found.items()}


def load_entry_points(
    group_name: str, *, exclude_names: Iterable[str] | None = None
) -> dict[str, Any]:
    """Classes of a group by name; an extension that cannot be loaded is one line on stderr."""
    excluded = set(exclude_names or ())
    wanted = declared(group_name).items()
    loaded = {name: load(entry) for name, entry in wanted if name not in excluded}
    return {name: cls for name, cls in loaded.items() if cls is not None}


def get_first_line_doc(any_type: Any) -> str:
    """Return the first line of the documentation of a class or an object, without the period."""
    return first_line(any_type)
