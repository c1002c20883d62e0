"""``ros2 pkg``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "create": "Create a package",
    "executables": "List the executables of packages",
    "list": "List the installed packages",
    "prefix": "Show the prefix that a package is installed in",
    "xml": "Show the package.xml of a package",
}
