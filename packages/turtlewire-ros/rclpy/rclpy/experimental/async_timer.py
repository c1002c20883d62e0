"""Timers of asynchronous nodes."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy.timer import BaseTimer

from ._async_entity import AsyncEntity

if TYPE_CHECKING:
    from rclpy._execution.entity import Work
    from rclpy.clock import BaseClock
    from rclpy.context import Context

    from ._async_entity import TaskGroup


class AsyncTimer(AsyncEntity, BaseTimer):
    """Calls ``callback`` once per period; made by :meth:`AsyncNode.create_timer`.

    The next call waits until the callback, ``def`` or ``async def``, has ended. A call that is
    overdue then comes at once; periods that were missed entirely are skipped.

    Args:
        timer_period_ns: Nanoseconds between calls.
        clock: The clock that it follows.
        context: The context of the node.
        callback: Called without arguments, or with a :class:`~rclpy.timer.TimerInfo`.
        autostart: Whether it runs at once, or waits for :meth:`reset`.
        on_destroy: Called with the timer after it has been destroyed.
        tg: Its tasks call the callback; None if the node does not run yet.
    """

    def __init__(
        self,
        timer_period_ns: int,
        clock: BaseClock,
        context: Context,
        callback: Callable[..., Any],
        autostart: bool,
        on_destroy: Callable[[Any], None] | None,
        tg: TaskGroup | None = None,
    ) -> None:
        super().__init__(
            callback,
            timer_period_ns,
            clock,
            on_destroy=on_destroy,
            context=context,
            autostart=autostart,
        )
        self._start(tg)

    @property
    def callback(self) -> Callable[..., Any]:
        """Called without arguments, or with a :class:`~rclpy.timer.TimerInfo` if it takes one.

        Raises:
            RuntimeError: The callback takes more arguments.
        """
        return self._callback

    @callback.setter
    def callback(self, value: Callable[..., Any]) -> None:
        self._wants_info = _wants_info(value)
        self._callback = value

    def _take(self) -> Work | None:
        if not self.is_ready():
            return None
        due_ns = self._next_call_ns
        super()._take()
        if not self._wants_info:
            return self._callback, ()
        return self._callback, (self._info(due_ns),)

    async def _until_ready(self) -> None:
        delay_ns = self._delay_ns(self._clock._now_ns())
        await self._waker().wait(None if delay_ns is None else delay_ns / 1e9)

    def _reschedule(self, now_ns: int) -> None:  # noqa: ARG002 - the loop asks for the delay itself
        if self._wake_up is not None:
            self._wake_up.set()


def _wants_info(callback: Callable[..., Any]) -> bool:
    """Return True if a callback takes one argument, False if it takes none.

    Raises:
        RuntimeError: The callback takes more arguments.
    """
    try:
        signature = inspect.signature(callback)
    except ValueError:  # a built-in function without one
        return False
    for count in (0, 1):
        try:
            signature.bind(*(None,) * count)
        except TypeError:
            continue
        return count == 1
    # ROS 2's text, to the byte.
    raise RuntimeError("Timer callback must accept zero arguments or one argument (TimerInfo)")
