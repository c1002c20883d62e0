"""The version of a URDF: 1.0, and in Lyrical also 1.1 and 1.2, which add attributes and shapes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from turtlewire.distro import LYRICAL, since
from turtlewire.urdf.faults import UrdfWarning

if TYPE_CHECKING:
    from turtlewire.urdf.elements import Element

__all__ = ["check_version", "is_of_version", "minor_version"]

_NEWEST_MINOR = 2


def check_version(root: Element) -> None:
    """Check the version of a ``robot`` element.

    Raises:
        UrdfError: This distribution does not read the version.
    """
    text = root.get("version")
    if text is None:
        return
    parts = text.split(".")
    if len(parts) != 2 or not all(part.isdecimal() for part in parts):
        raise root.error("The version attribute should be in the form 'x.y'")
    newest = _NEWEST_MINOR if since(LYRICAL) else 0
    if any(len(part) > 9 for part in parts) or not (int(parts[0]) == 1 and int(parts[1]) <= newest):
        known = (
            f"versions from 1.0 upto 1.{newest} are" if since(LYRICAL) else "only version 1.0 is"
        )
        raise root.error(f"Invalid 'version' specified; {known} currently supported")


def minor_version(element: Element) -> int:
    """Return the ``y`` of version ``1.y`` of the description that an element belongs to."""
    while element.parent is not None:
        element = element.parent
    found = re.fullmatch(r"1\.(\d+)", element.get("version") or "")
    return int(found[1]) if found else 0


def is_of_version(element: Element, minor: int, text: str, warnings: list[UrdfWarning]) -> bool:
    """Return whether a description has at least the version in which something came.

    Args:
        element: An element of the description.
        minor: The ``y`` of that version, ``1.y``.
        text: urdfdom's text in front of the version, for the warning in Lyrical.
        warnings: Gets the warning if the version is older.
    """
    if minor_version(element) >= minor:
        return True
    if since(LYRICAL):
        text = (
            f"Ignoring {text} URDF version 1.{minor} since specified version is"
            f" 1.{minor_version(element)}."
        )
        warnings.append(UrdfWarning(text, element.line, element.described()))
    return False
