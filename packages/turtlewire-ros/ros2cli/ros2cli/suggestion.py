"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from ros2cli.output import tell
from turtlewire.terminal import suggestion

_MOST_NAMES = 12
#: Packages of the services that every node has.
_OF_EVERY_NODE = ("rcl_interfaces/", "type_description_interfaces/")


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a line with similar names, to append to a message; empty without similar names."""
    line = suggestion.did_you_mean(name, known)
    return f"\n{line}" if line else ""


def field_meant(error: BaseException | None) -> str:
    """`did_you_mean` for a field that a message does not have; empty for other errors."""
    fields = getattr(getattr(error, "obj", None), "get_fields_and_field_types", None)
    return did_you_mean(str(getattr(error, "name", "")), fields()) if fields is not None else ""


def package_meant(name: str) -> str:
    """Return a line that says why there is no such package, or an empty string."""
    from turtlewire_ros.workspace_hints import package_hint

    line = package_hint(name)
    return f"\n{line}" if line else ""


def interface_meant(name: str, kind: str = "") -> str:
    """`did_you_mean` for an interface; ``kind`` limits the names to msg, srv or action.

    A name without a package, as ``Twist`` or misspelt ``Twits``, means all interfaces that are
    called so. If the package is missing and its source is known, the line says what to do; also if
    only the definition of the interface is found.
    """
    import difflib

    from ros2cli.completion import interface_names

    if line := source_meant(name):
        return line
    known = interface_names(kind)
    if name in known:
        package = name.partition("/")[0]
        return (
            f"\n{name} is defined, but Python cannot import its package {package}: source the "
            "setup file of the workspace in which it was built"
        )
    short = {full: full.rpartition("/")[2] for full in known}
    if "/" in name:
        return did_you_mean(name, known)
    near = difflib.get_close_matches(name, set(short.values()), n=1)
    meant = [full for full in known if short[full] in near]
    return f"\nDid you mean: {', '.join(meant)}" if meant else ""


def source_meant(name: str) -> str:
    """Return a line about the source of an interface's package, if that is not installed.

    Args:
        name: Name of the interface, or of the package.
    """
    from turtlewire.msg import interfaces
    from turtlewire_ros.workspace_hints import source_hint

    package = name.partition("/")[0]
    line = "" if package in interfaces() else source_hint(package)
    return f"\n{line}" if line else ""


def say_interface_meant(name: str, kind: str) -> None:
    """Print `interface_meant` to stderr, unless there is an interface of that name."""
    from ros2cli.completion import interface_names

    near = "" if name in interface_names(kind) else interface_meant(name, kind)
    if near:
        tell(near.lstrip("\n"))


def say_what_was_meant(name: str, known: Iterable[str]) -> None:
    """Print similar names to stderr, unless the name is known."""
    names = list(known)
    near = "" if name in names else did_you_mean(name, names)
    if near:
        tell(near.lstrip("\n"))


def warn_of_other_type(
    kind: str, name: str, asked: str, known: Mapping[str, Collection[str]]
) -> None:
    """Print to stderr that a topic, service or action has another type than was asked for.

    Args:
        kind: ``topic``, ``service`` or ``action``.
        name: Its full name.
        asked: The type on the command line.
        known: The types of all that exist, by name.
    """
    types = known.get(name, ())
    if types and asked not in types:
        tell(f"The {kind} '{name}' has the type {' and '.join(sorted(types))}, not {asked}")


def say_why_to_wait(
    kind: str, name: str, interface: type, known: Iterable[tuple[str, list[str]]]
) -> None:
    """Print to stderr why no server is available: another type, or another name.

    Args:
        kind: ``service`` or ``action``.
        name: Its full name.
        interface: The class on the command line.
        known: Names and types of all that exist.
    """
    from turtlewire.msg import type_name

    types = dict(known)
    if name in types:
        warn_of_other_type(kind, name, type_name(interface), types)
    else:
        say_what_there_is(kind, name, types)


def say_what_there_is(kind: str, name: str, types: Mapping[str, list[str]]) -> None:
    """Print similar names to stderr, or all names if no name is similar.

    Args:
        kind: ``topic``, ``service`` or ``action``.
        name: A name that is not known.
        types: The types of all that exist, by name.
    """
    near = did_you_mean(name, types).lstrip("\n")
    tell(near or _all_that_exist(kind, types))


def _all_that_exist(kind: str, types: Mapping[str, list[str]]) -> str:
    names = sorted(name for name in types if not types[name][0].startswith(_OF_EVERY_NODE))
    if not names:
        return f"No node offers any {kind} now"
    rest = len(names) - _MOST_NAMES
    more = f" and {rest} more" if rest > 0 else ""
    return f"Known {kind}s: {', '.join(names[:_MOST_NAMES])}{more}"
