"""The time of a simulation, from ``/clock``."""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING

from turtlewire.msg import type_hash
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS, Reliability

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import MessageInfo, Node

__all__ = ["SimulatedTime"]

_TYPE = "rosgraph_msgs/msg/Clock"
_CLOCK = Struct("<4xiI")  # encapsulation, seconds, nanoseconds


class SimulatedTime:
    """Follows ``/clock``.

    Args:
        node: Whose subscription it is.
        on_time: Called with each new time [ns] on a thread of the wire.

    Attributes:
        now_ns: The newest time; 0 until one has come.
    """

    def __init__(self, node: Node, on_time: Callable[[int], None]) -> None:
        self.now_ns = 0
        self._on_time = on_time
        self._subscription = node.create_subscription(
            "/clock",
            TypeId(_TYPE, type_hash(_TYPE)),
            QoS(depth=1, reliability=Reliability.BEST_EFFORT),
            self._receive,
        )

    def close(self) -> None:
        """Stop following the clock."""
        self._subscription.close()

    def _receive(self, cdr: bytes, _info: MessageInfo) -> None:
        if len(cdr) >= _CLOCK.size:
            seconds, nanoseconds = _CLOCK.unpack_from(cdr)
            self.now_ns = max(0, seconds * 1_000_000_000 + nanoseconds)
            self._on_time(self.now_ns)
