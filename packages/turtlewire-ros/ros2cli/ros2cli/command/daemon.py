"""``ros2 daemon``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "start": "Explain that there is no daemon",
    "status": "Show that no daemon is running",
    "stop": "Show that no daemon is running",
}
