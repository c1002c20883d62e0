"""``ros2 param``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "delete": "Delete a parameter",
    "describe": "Show what a parameter is for, and its limits",
    "dump": "Show all parameters of a node as a parameter file",
    "get": "Show the value of a parameter",
    "list": "List the parameters",
    "load": "Set the parameters of a node from a file",
    "set": "Set a parameter",
}
