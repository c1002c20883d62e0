"""Names of the interfaces that are installed."""

from __future__ import annotations

__all__ = ["interface_names"]


def interface_names(kind: str = "") -> list[str]:
    """Full names of all interfaces, sorted; ``kind`` limits them to msg, srv or action."""
    from turtlewire import msg

    return sorted(
        f"{package}/{part}/{name}"
        for package, parts in msg.interface_names().items()
        for part, names in parts.items()
        if part == kind or not kind
        for name in names
    )
