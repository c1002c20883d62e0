"""Something that happened."""

from __future__ import annotations

__all__ = ["Event"]


class Event:
    """Base of all events."""

    name = "launch.Event"
