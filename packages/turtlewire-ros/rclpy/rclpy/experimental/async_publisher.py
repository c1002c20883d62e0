"""Publishers of asynchronous nodes."""

from __future__ import annotations

from rclpy._typing import MsgT
from rclpy.publisher import BasePublisher

__all__ = ["AsyncPublisher"]


class AsyncPublisher(BasePublisher[MsgT]):
    """Sends messages to a topic; :meth:`publish` does not block, so nothing has to be awaited.

    Made by :meth:`AsyncNode.create_publisher`.
    """
