"""Changes of the graph, for asyncio."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.web.loop_calls import LoopCalls
    from turtlewire.wire.base import Graph

__all__ = ["GraphWatch"]

#: Changes come in groups; time to wait for further changes after the first one [s].
_REST = 0.05


class GraphWatch:
    """Calls back on the loop's thread after changes of the graph. For that thread.

    Args:
        graph: The graph.
        calls: Of the loop.
        on_change: Called once after a group of changes.
    """

    def __init__(self, graph: Graph, calls: LoopCalls, on_change: Callable[[], None]) -> None:
        self._calls = calls
        self._on_change = on_change
        self._is_told = False
        self._timer: asyncio.TimerHandle | None = None
        self._waiting: set[asyncio.Event] = set()
        self._stop_listening = graph.add_listener(self._tell)

    def _tell(self) -> None:
        """Notify the loop of a change; runs on a thread of the middleware."""
        if not self._is_told:
            self._is_told = True
            self._calls.soon(self._changed)

    def _changed(self) -> None:
        self._is_told = False
        for event in self._waiting:
            event.set()
        if self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(_REST, self._call)

    def _call(self) -> None:
        self._timer = None
        self._on_change()

    async def wait_until(self, predicate: Callable[[], bool], limit_s: float) -> bool:
        """Wait until ``predicate()`` is true, and test it after every change; its last value."""
        loop = asyncio.get_running_loop()
        end = loop.time() + limit_s
        event = asyncio.Event()
        self._waiting.add(event)
        try:
            while not predicate():
                if loop.time() >= end:
                    return False
                try:
                    await asyncio.wait_for(event.wait(), end - loop.time())
                except asyncio.TimeoutError:
                    continue  # the predicate decides
                event.clear()
        finally:
            self._waiting.discard(event)
        return True

    def close(self) -> None:
        """Stop all further calls."""
        self._stop_listening()
        if self._timer is not None:
            self._timer.cancel()
