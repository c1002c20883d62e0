"""Checks which web pages may connect.

A browser lets every page open a WebSocket to this machine and says in ``Origin`` which page it is.
Without a check any page that the user visits could read the robot's topics, and drive it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["FOXGLOVE", "refusal"]

#: The pages of the Foxglove app.
FOXGLOVE = ("https://app.foxglove.dev", "https://studio.foxglove.dev")
_LOOPBACK = re.compile(r"https?://(?:localhost|127\.0\.0\.1|\[::1\])(?::\d+)?")


def refusal(origins: list[str], allowed: Iterable[str]) -> str | None:
    """Return why a connection is refused, as one sentence, or None if it is allowed.

    Args:
        origins: All ``Origin`` headers. Programs other than browsers send none.
        allowed: Origins that may connect, besides Foxglove's and this machine's. ``*``
            stands for all.
    """
    known = {*FOXGLOVE, *(origin.lower().rstrip("/") for origin in allowed)}
    if not origins or "*" in known:
        return None
    if len(origins) == 1:
        origin = origins[0].lower()
        if origin.rstrip("/") in known or _LOOPBACK.fullmatch(origin):
            return None
    shown = ", ".join(repr(origin) for origin in origins)
    return f"pages of {shown} may not connect"
