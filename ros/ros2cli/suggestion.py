"""Names that may have been meant."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from turtlewire_ros import suggestion

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["did_you_mean", "field_meant", "interface_meant", "package_meant", "say_what_was_meant"]


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """A line with the nearest known names, to be put behind a message; empty when none is near."""
    line = suggestion.did_you_mean(name, known)
    return f"\n{line}" if line else ""


def field_meant(error: BaseException | None) -> str:
    """As `did_you_mean`, for a field that a message does not have; empty for other errors."""
    fields = getattr(getattr(error, "obj", None), "get_fields_and_field_types", None)
    return did_you_mean(str(getattr(error, "name", "")), fields()) if fields is not None else ""


def package_meant(name: str) -> str:
    """As `did_you_mean`, for the name of a package."""
    from turtlewire_ros.prefix import package_names

    return did_you_mean(name, package_names())


def interface_meant(name: str, kind: str = "") -> str:
    """As `did_you_mean`, for the name of an interface; ``kind`` is msg, srv or action when only those will do."""
    from ros2cli.completion import interfaces

    return did_you_mean(name, (known for known in interfaces() if f"/{kind}/" in known or not kind))


def say_what_was_meant(name: str, known: Iterable[str]) -> None:
    """Print the nearest names to stderr, unless the name is one of them or none is near."""
    names = list(known)
    line = "" if name in names else did_you_mean(name, names)
    if line:
        print(line.lstrip("\n"), file=sys.stderr)
