"""Commands and verbs that installed packages declare by entry points."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from turtlewire.plugins import declared

if TYPE_CHECKING:
    from turtlewire.plugins import Entry

__all__ = [
    "EXTENSION_POINT_GROUP_NAME",
    "declared",
    "described",
    "first_line",
    "load",
    "summary",
]

#: The group by which a package declares groups for the extensions of others.
EXTENSION_POINT_GROUP_NAME = "ros2cli.extension_point"


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
