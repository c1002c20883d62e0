"""``ros2 bag``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "info": "Show what a bag holds",
    "list": "List the storages and compressions that can be used",
    "record": "Record topics and service events into a bag",
    "reindex": "Write the metadata of a bag anew, for example of a recording that was killed",
}
