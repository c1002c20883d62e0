"""Marks the nodes of relays.

All nodes of a relay are in a separate enclave. Relays carry no data from such nodes,
so no message loops. The enclave is announced with the participant, before any endpoint.
"""

from __future__ import annotations

import secrets
import time
import zlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.wire.base import NodeInfo

__all__ = ["Mark", "is_relayed"]

_ENCLAVES = "/turtlewire_relay/"


def is_relayed(node: NodeInfo) -> bool:
    """Return True if the node belongs to a relay."""
    return node.enclave.startswith(_ENCLAVES)


class Mark:
    """The mark of one relay.

    The enclaves of relays that carry the same names differ only in the time of their start and a
    random part.

    Args:
        names: The options that determine which names are carried.
    """

    def __init__(self, names: Iterable[str]) -> None:
        digest = zlib.crc32("\n".join(names).encode())
        self._alike = f"{_ENCLAVES}r{digest:08x}_"
        self.enclave = f"{self._alike}{time.time_ns():016x}_{secrets.token_hex(4)}"

    def elder(self, near: Iterable[NodeInfo], far: Iterable[NodeInfo]) -> bool:
        """Return True if an older relay carries the same names between the same networks.

        Args:
            near: The nodes at one end.
            far: The nodes at the other end.
        """
        there = {node.enclave for node in far}
        return any(
            node.enclave.startswith(self._alike)
            and node.enclave < self.enclave
            and node.enclave in there
            for node in near
        )
