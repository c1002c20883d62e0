"""``ros2 component``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "list": "List the containers and the nodes in them",
    "load": "Load a node into a container",
    "standalone": "Run a node in a container of its own",
    "types": "List the components that packages have registered",
    "unload": "Unload a node from a container",
}
