"""``ros2 action``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "info": "Show who offers and may start an action",
    "list": "List the actions",
    "send_goal": "Start an action and wait for its end",
    "type": "Show the type of an action",
}
