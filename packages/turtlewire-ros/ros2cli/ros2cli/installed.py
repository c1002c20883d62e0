"""Extensions that installed packages declare by entry points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.plugins import declared

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

__all__ = ["EXTENSION_POINT_GROUP_NAME", "declared", "first_line", "load"]

#: The group by which a package declares groups for the extensions of others.
EXTENSION_POINT_GROUP_NAME = "ros2cli.extension_point"


def load(entry: EntryPoint) -> Any:
    """The class of an entry point; None if it cannot be loaded, which is one line on stderr."""
    try:
        return entry.load()
    # Another's module may fail in any way; the other extensions still work.
    except Exception as error:  # noqa: BLE001
        from ros2cli.output import tell

        tell(f"Failed to load entry point '{entry.name}': {type(error).__name__}: {error}")
        return None


def first_line(documented: Any) -> str:
    """First line of the documentation of a class or an object, without the period."""
    lines = (documented.__doc__ or "").strip().splitlines()
    return lines[0].strip().removesuffix(".") if lines else ""
