"""Something that happened."""

from __future__ import annotations


class Event:
    """Base of all events."""

    name = "launch.Event"
