"""What the view draws for each type of message.

=========  =================================================================
module     what it holds
=========  =================================================================
`content`  `Display` and what it makes of messages
`options`  what the user chose for a display
=========  =================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.view.displays.content import Display

__all__ = ["display_types"]


def display_types() -> dict[str, type[Display]]:
    """The display of each message type."""
    return {}
