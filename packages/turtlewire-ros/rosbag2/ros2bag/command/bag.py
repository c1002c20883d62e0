"""``ros2 bag``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "burst": "Publish the first messages of a bag at once",
    "convert": "Write the messages of bags into others",
    "info": "Show what a bag holds",
    "list": "List the storages and compressions that can be used",
    "play": "Publish the messages of a bag at their times",
    "record": "Record topics and service events into a bag",
    "reindex": "Write the metadata of a bag anew, for example of a recording that was killed",
}
