"""Readers and writers of the values of RViz's options."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.web.commands import is_finite_number

if TYPE_CHECKING:
    from turtlewire_view.displays.options import Option

__all__ = [
    "RvizOption",
    "choice",
    "color",
    "flag",
    "number",
    "read_absolute",
    "read_joints",
    "read_links",
    "read_namespaces",
    "read_text",
    "text",
    "whole",
    "write_joints",
    "write_links",
    "write_namespaces",
]

_COLOR = re.compile(r"\s*(\d{1,3})\s*;\s*(\d{1,3})\s*;\s*(\d{1,3})\s*")
_OUR_COLOR = re.compile("#[0-9a-fA-F]{6}")


class RvizOption(NamedTuple):
    """An option: its name here, its path in RViz (names joined by ``/``), and how values map."""

    ours: str
    theirs: str
    read: Callable[[object], object]
    write: Callable[[object], object]
    names: tuple[str, ...] = ()

    def wanted(self, entry: Option) -> str:
        """Describe the values that the page supports of RViz's option."""
        if entry.type == "color":
            return "a colour as '255; 255; 255'"
        return f"one of {', '.join(self.names)}" if self.names else entry.wanted()


def number(ours: str, theirs: str) -> RvizOption:
    """Return an option that is a number."""
    return RvizOption(ours, theirs, _read_number, _read_number)


def whole(ours: str, theirs: str) -> RvizOption:
    """Return an option that is a whole number."""
    return RvizOption(ours, theirs, _read_number, _write_whole)


def flag(ours: str, theirs: str) -> RvizOption:
    """Return an option that is true or false."""
    return RvizOption(ours, theirs, _read_flag, _read_flag)


def text(ours: str, theirs: str) -> RvizOption:
    """Return an option that is a string."""
    return RvizOption(ours, theirs, read_text, read_text)


def color(ours: str, theirs: str) -> RvizOption:
    """Return an option that is a colour."""
    return RvizOption(ours, theirs, _read_color, _write_color)


def choice(ours: str, theirs: str, names: dict[str, str]) -> RvizOption:
    """Return an option with names: RViz's to ours; the first of several is written."""
    back = {mine: name for name, mine in reversed(names.items())}
    return RvizOption(
        ours,
        theirs,
        lambda value: _among(names, value),
        lambda value: _among(back, value),
        tuple(names),
    )


def _among(names: dict[str, str], value: object) -> object:
    return names.get(value) if isinstance(value, str) else None


def _read_number(value: object) -> object:
    return value if is_finite_number(value) and abs(value) < 1e12 else None


def _read_color(value: object) -> str | None:
    match = _COLOR.fullmatch(value) if isinstance(value, str) else None
    if match is None:
        return None
    return "#" + "".join(f"{min(255, int(part)):02x}" for part in match.groups())


def _read_flag(value: object) -> object:
    return value if isinstance(value, bool) else None


def read_text(value: object) -> object:
    """Read a string."""
    return value if isinstance(value, str) else None


def _write_whole(value: object) -> object:
    number = _read_number(value)
    return round(number) if isinstance(number, (int, float)) else None


def _write_color(value: object) -> str | None:
    if not isinstance(value, str) or not _OUR_COLOR.fullmatch(value):
        return None
    return "; ".join(str(int(value[at : at + 2], 16)) for at in (1, 3, 5))


def read_namespaces(value: object) -> object:
    """Read each namespace's visibility."""
    if not isinstance(value, dict):
        return None
    return {str(name): {"shown": on} for name, on in value.items() if isinstance(on, bool)}


def write_namespaces(value: object) -> object:
    """Write each namespace's visibility."""
    items = _items(value)
    return {name: item.get("shown", True) for name, item in items.items()} or None


def read_links(value: object) -> object:
    """Read each link's visibility and alpha."""
    if not isinstance(value, dict):
        return None
    links = {str(name): each for name, each in value.items() if isinstance(each, dict)}
    return {
        name: {"shown": each.get("Value") is not False, "alpha": alpha}
        for name, each in links.items()
        if (alpha := _read_number(each.get("Alpha", 1))) is not None
    }


def write_links(value: object) -> object:
    """Write each link's visibility and alpha."""
    items = _items(value)
    return {
        name: {"Alpha": item.get("alpha", 1), "Value": item.get("shown", True)}
        for name, item in items.items()
    } or None


def read_joints(value: object) -> object:
    """Read each joint's visibility and greatest effort."""
    if not isinstance(value, dict):
        return None
    joints: dict[str, dict[str, object]] = {}
    for name, each in value.items():
        if name == "All Enabled":
            continue
        known = each if isinstance(each, dict) else {"Value": each}
        joints[str(name)] = {"shown": known.get("Value") is not False}
        greatest = _read_number(known.get("Max Effort"))
        if greatest:
            joints[str(name)]["max"] = greatest
    return joints


def write_joints(value: object) -> object:
    """Write each joint's visibility and greatest effort."""
    return {
        name: {"Value": item.get("shown", True)}
        | ({"Max Effort": item["max"]} if "max" in item else {})
        for name, item in _items(value).items()
    } or None


def read_absolute(value: object) -> object:
    """Read a topic, which may be relative or have a QoS."""
    name = value.get("Value") if isinstance(value, dict) else value
    return "/" + name.lstrip("/") if isinstance(name, str) and name else None


def _items(value: object) -> dict[str, dict[str, Any]]:
    if not isinstance(value, dict):
        return {}
    return {str(name): item for name, item in value.items() if isinstance(item, dict)}
