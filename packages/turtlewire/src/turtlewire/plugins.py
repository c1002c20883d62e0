"""Entry points that installed packages declare, turtlewire's first.

This module reads the files itself, because importing :mod:`importlib.metadata` takes longer than
most commands.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from importlib import import_module
from typing import Any


class Entry:
    """A line of an ``entry_points.txt``: a name, and the place of an object.

    Attributes:
        name: For example ``echo``.
        value: For example ``ros2topic.verb.echo:EchoVerb``.
        is_own: Whether a distribution of turtlewire declares it.
        module: Name of the module, for example ``ros2topic.verb.echo``.
        attribute: Name of the object in the module, for example ``EchoVerb``.
    """

    def __init__(self, name: str, value: str, *, is_own: bool) -> None:
        self.name = name
        self.value = value
        self.is_own = is_own
        target = value.partition("[")[0]  # there may be extras
        self.module, _, self.attribute = (part.strip() for part in target.partition(":"))

    def load(self) -> Any:
        """Import the module; return the object."""
        found: Any = import_module(self.module)
        for name in filter(None, self.attribute.split(".")):
            found = getattr(found, name)
        return found


def declared(group: str, wanted: str | None = None) -> dict[str, Entry]:
    """Return the entry points of a group by name; the first of a name wins.

    Args:
        group: For example ``ros2topic.verb``.
        wanted: A name; if turtlewire declares it, the files of other packages are not read.
    """
    found: dict[str, Entry] = {}
    for path, is_own in _files():
        if not is_own and wanted in found:
            break
        try:
            with open(path, encoding="utf-8") as file:
                text = file.read()
        except OSError:
            continue
        for name, value in _section(text, group):
            found.setdefault(name, Entry(name, value, is_own=is_own))
    return found


def _files() -> Iterator[tuple[str, bool]]:
    """Yield the files that declare entry points, turtlewire's first."""
    others = []
    for folder in sys.path:
        try:
            names = os.listdir(folder or ".")
        except OSError:
            continue
        for name in names:
            if name.endswith((".dist-info", ".egg-info")):
                path = os.path.join(folder, name, "entry_points.txt")
                if name.startswith("turtlewire"):
                    yield path, True
                else:
                    others.append(path)
    for path in others:
        yield path, False


def _section(text: str, group: str) -> Iterator[tuple[str, str]]:
    """Yield names and values of a section."""
    _, found, rest = f"\n{text}".partition(f"\n[{group}]")
    for line in rest.partition("\n[")[0].splitlines() if found else ():
        name, equals, value = line.partition("=")
        if equals and not name.startswith("#"):
            yield name.strip(), value.strip()


class PluginException(Exception):
    """An extension is for another version of the program that it extends."""


def satisfies_version(version: str, caret_range: str) -> None:
    """Check that a version is in a caret range.

    Args:
        version: For example ``0.1``.
        caret_range: For example ``^0.1``: the same until the first number that is not zero.

    Raises:
        PluginException: The version is too old or too new.
    """
    assert caret_range.startswith("^"), "expected a range that begins with ^"
    lower = _numbers(caret_range[1:])
    if _numbers(version) < lower:
        raise PluginException(f"Extension point version {version} is too old for {caret_range}")
    if _numbers(version) >= _numbers(get_upper_bound_caret_version(caret_range[1:])):
        raise PluginException(f"Extension point version {version} is too new for {caret_range}")


def get_upper_bound_caret_version(version: str) -> str:
    """Return the first version that is outside of a caret range: ``0.2`` for ``0.1``."""
    numbers = _numbers(version)
    place = next((index for index, number in enumerate(numbers) if number), len(numbers) - 1)
    upper = [*numbers[:place], numbers[place] + 1, *[0] * (len(numbers) - place - 1)]
    return ".".join(map(str, upper))


def _numbers(version: str) -> list[int]:
    return [int(part) for part in version.split(".")]
