"""The entry points of commands and verbs.

A package adds a verb to ``ros2 topic`` by an entry point in the group ``ros2topic.verb``, and a
command by one in ``ros2cli.command``.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from turtlewire.plugins import declared

if TYPE_CHECKING:
    from importlib.metadata import Distribution, EntryPoint

    from turtlewire.plugins import Entry

__all__ = [
    "EXTENSION_POINT_GROUP_NAME",
    "declared",
    "described",
    "first_line",
    "get_all_entry_points",
    "get_entry_points",
    "get_first_line_doc",
    "load",
    "load_entry_points",
    "summary",
]

#: The group by which a package declares groups for the extensions of others.
EXTENSION_POINT_GROUP_NAME = "ros2cli.extension_point"


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


def load(entry: Entry) -> Any:
    """Return the class of an entry point; None and one line on stderr if it cannot be loaded."""
    try:
        return entry.load()
    # Modules of other packages may raise any error; the other extensions still work.
    except Exception as error:  # noqa: BLE001
        from ros2cli.output import tell

        tell(f"Failed to load entry point '{entry.name}': {type(error).__name__}: {error}")
        return None


def described(group: str) -> dict[str, tuple[str, str]]:
    """Return summary and module of the entry points of a group, sorted by name.

    Classes of other packages are loaded; one that cannot be loaded is one line on stderr.
    """
    found = {}
    for name, entry in sorted(declared(group).items()):
        if entry.is_own:
            found[name] = (summary(entry), entry.module)
        elif (cls := load(entry)) is not None:
            found[name] = (first_line(cls), entry.module)
    return found


def summary(entry: Entry) -> str:
    """Return the first line of the documentation of a class, without the period.

    It is read from the source, because importing all commands takes longer than showing them.
    """
    text = _source(entry).partition(':\n    """')[2]
    line = text.partition("\n")[0].partition('"""')[0].strip()
    return line.removesuffix(".") or first_line(load(entry))


def _source(entry: Entry) -> str:
    """Return the source text from the class on; empty if it is not found."""
    from importlib.machinery import PathFinder

    package, *parts = entry.module.split(".")
    spec = PathFinder.find_spec(package)
    for folder in (spec and spec.submodule_search_locations) or ():
        with suppress(OSError), open(f"{os.path.join(folder, *parts)}.py", "rb") as file:
            return file.read().decode().partition(f"\nclass {entry.attribute}(")[2]
    return ""


def first_line(documented: Any) -> str:
    """Return the first line of the documentation of a class or an object, without the period."""
    lines = (documented.__doc__ or "").strip().splitlines()
    return lines[0].strip().removesuffix(".") if lines else ""
