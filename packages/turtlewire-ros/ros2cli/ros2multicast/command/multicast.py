"""``ros2 multicast``."""

from __future__ import annotations

__all__ = ["VERBS"]

VERBS = {
    "receive": "Wait for one datagram",
    "send": "Send one datagram",
}
