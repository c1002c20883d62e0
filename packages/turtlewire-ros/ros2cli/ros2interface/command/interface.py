"""``ros2 interface``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "list": "List all interfaces",
    "package": "List the interfaces of a package",
    "packages": "List the packages that have interfaces",
    "proto": "Show an interface as YAML to fill in",
    "show": "Show the definition of an interface",
}
