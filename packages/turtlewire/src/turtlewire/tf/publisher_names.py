"""Finds the name of the node that published a message, once for each publisher."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Graph

__all__ = ["PublisherNames"]

_MOST = 1000  # publishers come and go; beyond this many, all are looked up again


class PublisherNames(dict[bytes, str]):
    """Full names of the nodes that own publishers, by gid. Thread-safe.

    The gid in hex stands for the name until the graph knows the node.

    A name that is known costs the lookup in a dict.

    Args:
        graph: Where nodes and publishers are found.
        on_name: Called with the hex text and the name when the graph has learnt whose publisher it
            is, on the graph's thread.
    """

    def __init__(self, graph: Graph, on_name: Callable[[str, str], None]) -> None:
        super().__init__()
        self._graph = graph
        self._on_name = on_name
        self._lock = threading.Lock()
        self._nameless: set[bytes] = set()
        self._stop_listening = graph.add_listener(self._look_again)

    def __missing__(self, gid: bytes) -> str:
        with self._lock:
            if len(self) >= _MOST:
                self.clear()
                self._nameless.clear()
            name = self._find({gid}).get(gid)
            if name is None:
                self._nameless.add(gid)
            self[gid] = name or gid.hex()
            return self[gid]

    def _look_again(self) -> None:
        """After a change of the graph."""
        if not self._nameless:
            return
        with self._lock:
            found = self._find(self._nameless)
            self._nameless -= found.keys()
            self.update(found)
        for gid, name in found.items():
            self._on_name(gid.hex(), name)

    def _find(self, gids: set[bytes]) -> dict[bytes, str]:
        return {
            end.gid: f"{end.node.namespace.rstrip('/')}/{end.node.name}"
            for end in self._graph.endpoints()
            if end.gid in gids and end.node is not None
        }

    def close(self) -> None:
        """Stop listening to the graph."""
        self._stop_listening()
