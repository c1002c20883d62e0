"""Subscriptions, services, clients and timers whose callbacks run in tasks of asyncio."""

from __future__ import annotations

import asyncio
import inspect
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._execution.entity import Entity, Work
from turtlewire.errors import WireError
from turtlewire.wake_up import LoopWakeUp

if sys.version_info >= (3, 11):
    from asyncio import TaskGroup
else:
    from taskgroup import TaskGroup

if TYPE_CHECKING:
    from rclpy._node.state import NodeState

__all__ = ["AsyncEndpoint", "AsyncEntity", "TaskGroup"]


class AsyncEntity(Entity):
    """An entity that a task serves, from the start of its node until it is destroyed.

    Everything happens in the thread of the loop.
    """

    _concurrent = False
    _task: asyncio.Task[None] | None = None
    _wake_up: LoopWakeUp | None = None

    def _start(self, group: TaskGroup | None) -> None:
        """Serve it in a task of a group, if there is a group already."""
        if group is not None:
            self._task = group.create_task(self._serve())

    async def _serve(self) -> None:
        try:
            if self._concurrent:
                async with TaskGroup() as handlers:
                    while True:
                        handlers.create_task(_run(await self._next()))
                        await asyncio.sleep(0)
            while True:
                await _run(await self._next())
                # For other tasks, which callbacks without an `await` would lock out.
                await asyncio.sleep(0)
        finally:
            self._task = None
            self.destroy()

    async def _next(self) -> Work:
        """Return what is to be done next, as soon as there is something."""
        while (work := self._take()) is None:
            await self._until_ready()
        return work

    async def _until_ready(self) -> None:
        """Wait until another look makes sense."""
        raise NotImplementedError

    def _waker(self) -> LoopWakeUp:
        if self._wake_up is None:
            self._wake_up = LoopWakeUp(asyncio.get_running_loop())
        return self._wake_up

    def destroy(self) -> None:
        """End its task, with the callbacks that run, and close it. Idempotent."""
        task, self._task = self._task, None
        if task is not None:
            task.cancel()
        super().destroy()
        if self._wake_up is not None:
            self._wake_up.set()


class AsyncEndpoint(AsyncEntity):
    """An entity with something to take from the middleware.

    The middleware's own thread wakes the loop: it takes neither a thread of the node nor polling.
    """

    _wire: Any
    _core: NodeState
    _stop_waiting: Callable[[], None] | None = None

    async def _until_ready(self) -> None:
        wake_up = self._waker()
        context = self._core.context
        try:
            self._stop_waiting = context.wire.call_when_ready(self._wire, wake_up.set)
        except WireError:
            if context.is_open():
                raise
            # Another thread has shut the context down; the end of the node is on its way.
        try:
            await wake_up.wait()
        finally:
            self._forget_wait()

    def _forget_wait(self) -> None:
        stop, self._stop_waiting = self._stop_waiting, None
        if stop is not None:
            stop()

    def _close(self) -> None:
        self._forget_wait()
        super()._close()


async def _run(work: Work) -> None:
    callback, arguments = work
    outcome = callback(*arguments)
    if inspect.isawaitable(outcome):
        await outcome
