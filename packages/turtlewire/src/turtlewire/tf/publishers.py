"""The publishers of transforms: their names, and the frames of those that have left the graph.

A static transform stays when its publisher leaves, as in tf2, and so do samples that did not come
from the network.
"""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from turtlewire.guarded import call_guarded
from turtlewire.tf.links import links

if TYPE_CHECKING:
    from turtlewire.tf.links import HasLinks
    from turtlewire.wire.base import Graph

    class Forgetful(HasLinks, Protocol):
        """A buffer that can forget a frame."""

        def remove_frame(self, child_frame: str) -> bool:
            """Forget how a frame lies in its parent."""
            ...


__all__ = [
    "DepartureWatch",
    "PublisherNames",
    "departed_frames",
]


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


#: What a listener calls a sender: the node's full name, or the gid while no node is known.
_OF_NETWORK = re.compile(r"/|[0-9a-f]{32,48}\Z")


def departed_frames(buffer: HasLinks, graph: Graph, topic: str) -> list[str]:
    """Return the moving frames whose last sender has no publisher of ``topic`` in the graph."""
    present = set[str]()
    for endpoint in graph.endpoints_of(topic, "publisher"):
        present.add(endpoint.gid.hex())
        if endpoint.node is not None:
            present.add(f"{endpoint.node.namespace.rstrip('/')}/{endpoint.node.name}")
    return [
        link.child_frame
        for link in links(buffer)
        if not link.static
        and link.senders
        and _OF_NETWORK.match(link.senders[-1].name)
        and link.senders[-1].name not in present
    ]


class DepartureWatch:
    """Removes moving frames from a buffer some time after their publisher has left the graph.

    A frame that another publisher sends meanwhile stays. Owns a thread, which waits for changes of
    the graph and for the moments of removal.

    Args:
        buffer: What to remove the frames from.
        graph: Where publishers appear and leave.
        topic: Their topic.
        after_ns: Time between the departure and the removal.
    """

    def __init__(self, buffer: Forgetful, graph: Graph, topic: str, after_ns: int) -> None:
        self._buffer = buffer
        self._graph = graph
        self._topic = topic
        self._after_s = after_ns / 1e9
        self._condition = threading.Condition()
        self._due: dict[str, float] = {}  # moments of removal, by frame
        self._changed = True
        self._closed = False
        self._thread = threading.Thread(target=self._run, name="tf-departures", daemon=True)
        self._stop_listening = graph.add_listener(self._note_change)
        self._thread.start()

    def _note_change(self) -> None:
        with self._condition:
            self._changed = True
            self._condition.notify_all()

    def _run(self) -> None:
        while self._wait(min(self._due.values(), default=None)):
            call_guarded(self._remove_departed)

    def _remove_departed(self) -> None:
        former, self._due = self._due, {}
        departed = departed_frames(self._buffer, self._graph, self._topic)
        now = time.monotonic()
        self._due = {frame: former.get(frame, now + self._after_s) for frame in departed}
        for frame in [frame for frame, moment in self._due.items() if moment <= now]:
            del self._due[frame]
            self._buffer.remove_frame(frame)

    def _wait(self, until: float | None) -> bool:
        """Wait for a change of the graph, at most until a moment; False once closed."""
        with self._condition:
            self._condition.wait_for(
                lambda: self._changed or self._closed,
                None if until is None else max(0.0, until - time.monotonic()),
            )
            self._changed = False
            return not self._closed

    def close(self) -> None:
        """Stop watching, and join the thread. Idempotent."""
        self._stop_listening()
        with self._condition:
            self._closed = True
            self._condition.notify_all()
        if threading.current_thread() is not self._thread:
            self._thread.join()
