"""Signals as calls of an asyncio loop."""

from __future__ import annotations

import signal
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Any

from turtlewire.terminal.signal_watch import watched

if TYPE_CHECKING:
    import asyncio

    from typing_extensions import Self


class AsyncSafeSignalManager:
    """Calls handlers of signals in a loop, where they may do anything; a context manager.

    ::

        with AsyncSafeSignalManager(loop) as manager:
            manager.handle(signal.SIGINT, lambda number: task.cancel())
            loop.run_until_complete(task)

    To be used in the main thread. The former handlers come back at its end.

    Args:
        loop: The loop.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._handlers: dict[int, Callable[[int], object]] = {}
        self._former: dict[int, Any] = {}
        # A loop that sleeps may miss a signal; a call from another thread wakes it.
        self._waking = watched(self._handlers, lambda: loop.call_soon_threadsafe(lambda: None))

    def __enter__(self) -> Self:
        self._waking.__enter__()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        exc_traceback: TracebackType | None,
    ) -> None:
        for number in list(self._former):
            self.handle(number, None)
        self._waking.__exit__(exc_type, exc_value, exc_traceback)

    def handle(
        self, signum: signal.Signals | int, handler: Callable[[int], object] | None
    ) -> Callable[[int], object] | None:
        """Call a function with the signal's number in the loop; None ends that.

        Returns:
            The function before; None if there was none.
        """
        number = int(signum)
        before = self._handlers.pop(number, None)
        if handler is not None:
            self._handlers[number] = handler
            if number not in self._former:
                self._former[number] = signal.signal(number, self._on_signal)
        elif number in self._former:
            former = self._former.pop(number)
            signal.signal(number, signal.SIG_DFL if former is None else former)
        return before

    def _on_signal(self, number: int, _frame: object) -> None:
        self._loop.call_soon_threadsafe(self._call, number)

    def _call(self, number: int) -> None:
        handler = self._handlers.get(number)
        if handler is not None:
            handler(number)
