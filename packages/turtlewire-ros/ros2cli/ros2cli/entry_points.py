"""Commands and verbs as entry points: this distribution's, and other packages'.

A package adds a verb to ``ros2 topic`` by an entry point in the group ``ros2topic.verb``, and a
command by one in ``ros2cli.command``. The ones of this distribution are tables in
:mod:`ros2cli.commands`, because reading the metadata of all installed packages takes longer than
most commands.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ros2cli.commands import COMMANDS
from ros2cli.installed import EXTENSION_POINT_GROUP_NAME, declared, first_line, load

if TYPE_CHECKING:
    from collections.abc import Iterable
    from importlib.metadata import Distribution, EntryPoint

__all__ = [
    "EXTENSION_POINT_GROUP_NAME",
    "get_all_entry_points",
    "get_entry_points",
    "get_first_line_doc",
    "load_entry_points",
    "others",
]

#: The command of each group; ``ros2 daemon`` is the only one whose package has others beside it.
_DAEMON = "ros2cli.daemon.verb"


def get_all_entry_points() -> dict[str, dict[str, tuple[Distribution, EntryPoint]]]:
    """Distribution and entry point by group and name, for all groups of installed packages.

    Only packages with metadata are listed, not the commands of this distribution.
    """
    from importlib.metadata import distributions

    found: dict[str, dict[str, tuple[Distribution, EntryPoint]]] = {}
    for distribution in distributions():
        for entry in distribution.entry_points:
            found.setdefault(entry.group, {}).setdefault(entry.name, (distribution, entry))
    return found


def get_entry_points(group_name: str) -> dict[str, EntryPoint]:
    """Entry points of a group by name, this distribution's first."""
    return {**_own(group_name), **others(group_name)}


def others(group_name: str) -> dict[str, EntryPoint]:
    """Entry points of a group that other packages declare."""
    found = declared(group_name)
    own = _own(group_name) if found else {}
    return {name: entry for name, entry in found.items() if name not in own}


def load_entry_points(
    group_name: str, *, exclude_names: Iterable[str] | None = None
) -> dict[str, Any]:
    """Classes of a group by name; an extension that cannot be loaded is one line on stderr."""
    excluded = set(exclude_names or ())
    wanted = get_entry_points(group_name).items()
    loaded = {name: load(entry) for name, entry in wanted if name not in excluded}
    return {name: cls for name, cls in loaded.items() if cls is not None}


def get_first_line_doc(any_type: Any) -> str:
    """First line of the documentation of a class or an object, without the period."""
    return first_line(any_type)


def _own(group_name: str) -> dict[str, EntryPoint]:
    from importlib.metadata import EntryPoint

    package, _, kind = group_name.rpartition(".")
    if group_name == "ros2cli.command":
        targets = {name: _command(name) for name in COMMANDS}
    elif kind == "verb" and (group_name == _DAEMON or package.removeprefix("ros2") in COMMANDS):
        command = "daemon" if group_name == _DAEMON else package.removeprefix("ros2")
        verbs = getattr(import_module(f"ros2cli.commands.{command}"), "VERBS", {})
        home = "ros2cli.verb.daemon" if group_name == _DAEMON else f"{package}.verb"
        targets = {name: f"{home}.{name}:{_class_name(name)}Verb" for name in verbs}
    else:
        targets = {}
    return {name: EntryPoint(name, value, group_name) for name, value in targets.items()}


def _command(name: str) -> str:
    package = "ros2cli" if name in ("daemon", "extension_points", "extensions") else f"ros2{name}"
    module = f"{package}.command.{name}" if name != "wtf" else "ros2doctor.command.doctor"
    return f"{module}:{_class_name(name)}Command"


def _class_name(name: str) -> str:
    return name.title().replace("_", "")
