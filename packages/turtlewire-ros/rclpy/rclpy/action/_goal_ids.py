"""Ids of goals as bytes, which are keys of dictionaries, and as messages."""

from __future__ import annotations

import os
from typing import Any

from turtlewire.msg import get_message
from turtlewire.msg.values import array_content


def goal_key(goal_id: Any) -> bytes:
    """Return the 16 bytes of a ``unique_identifier_msgs/msg/UUID``, without NumPy."""
    return array_content(goal_id, "uuid")


def random_goal_id() -> Any:
    """Return a random UUID, version 4."""
    value = bytearray(os.urandom(16))
    # The bits of version and variant, as in RFC 4122.
    value[6] = value[6] & 0x0F | 0x40
    value[8] = value[8] & 0x3F | 0x80
    return get_message("unique_identifier_msgs/msg/UUID")(uuid=bytes(value))
