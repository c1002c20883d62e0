"""``ros2 lifecycle``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "get": "Show the state of managed nodes",
    "list": "List the transitions that a managed node offers",
    "nodes": "List the managed nodes",
    "set": "Have a managed node change its state",
}
