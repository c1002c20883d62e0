"""Waiting for the graph in asyncio."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from turtlewire.wake_up import LoopWakeUp

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

__all__ = ["wait_for_graph"]


async def wait_for_graph(context: Context, predicate: Callable[[], bool]) -> None:
    """Wait until ``predicate()`` is true, looking again after each change of the graph.

    It also looks after a shutdown: the predicate raises then.
    """
    changed = LoopWakeUp(asyncio.get_running_loop())
    with context.waking_at_changes(changed):
        while not predicate():
            await changed.wait()
