"""``ros2 node``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "info": "Show what a node publishes, subscribes to and offers",
    "list": "List the nodes",
}
