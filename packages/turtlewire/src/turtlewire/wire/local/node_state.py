"""The state that a node shares with its endpoints."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.wire.base import NodeInfo
    from turtlewire.wire.reader_thread import Reader

    from .bus import Bus
    from .endpoint import LocalEndpoint

__all__ = ["LocalNodeState"]


class LocalNodeState:
    """The bus that a node's endpoints are on and the thread that calls their callbacks.

    Attributes:
        endpoints: The node's open endpoints, guarded by the bus's lock.
    """

    def __init__(self, info: NodeInfo, bus: Bus, reader: Reader) -> None:
        self.info = info
        self.bus = bus
        self.reader = reader
        self.endpoints: set[LocalEndpoint] = set()
