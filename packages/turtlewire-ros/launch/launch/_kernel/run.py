"""The state of one launch: events, handlers, futures, processes."""

from __future__ import annotations

import asyncio
import collections
import contextlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from turtlewire_ros.process_family import ProcessFamily

if TYPE_CHECKING:
    from launch._kernel.protocols import EventHandling
    from launch.event import Event

C = TypeVar("C")


class Run(Generic[C]):
    """The state that the entities of a launch and its loop share.

    Events travel one way: :meth:`emit` queues them, the loop takes them by :meth:`take_events` and
    hands them to the :meth:`handlers`. All methods are for the loop's thread, except for
    :meth:`emit`.
    """

    def __init__(self) -> None:
        self._events: collections.deque[Event] = collections.deque()
        self._handlers: collections.deque[EventHandling[C]] = collections.deque()
        self._futures: set[asyncio.Future[Any]] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._wake: asyncio.Event | None = None
        self._processes: ProcessFamily | None = None
        #: Whether the launch is ending.
        self.is_shutdown = False

    # the loop

    @property
    def loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop of the launch, or None when it does not run."""
        return self._loop

    def begin(self) -> None:
        """Start on the running event loop."""
        self._loop = asyncio.get_running_loop()
        self._wake = asyncio.Event()
        self.is_shutdown = False

    def end(self) -> None:
        """End the launch; later events wait for its next start."""
        self._loop = None

    async def wait(self) -> None:
        """Wait until there is an event, or a future is done."""
        assert self._wake is not None
        while not self._events and not any(future.done() for future in self._futures):
            # No event is missed: `set` runs on this loop, so not before the next line waits.
            self._wake.clear()
            await self._wake.wait()

    def _wake_loop(self) -> None:
        loop, wake = self._loop, self._wake
        if loop is None or wake is None:
            return  # not running: the loop reads the queue when it starts
        with contextlib.suppress(RuntimeError):  # the loop may have been closed by now
            loop.call_soon_threadsafe(wake.set)

    # events

    def emit(self, event: Event) -> None:
        """Queue an event. Safe from any thread."""
        self._events.append(event)
        self._wake_loop()

    def take_events(self) -> list[Event]:
        """Remove and return the queued events; events that their handlers emit come later."""
        # One `popleft` each, because other threads may append at the same time.
        return [self._events.popleft() for _ in range(len(self._events))]

    def register(self, handler: EventHandling[C], *, last: bool) -> None:
        """Add a handler, after all others or before them."""
        if last:
            self._handlers.append(handler)
        else:
            self._handlers.appendleft(handler)

    def unregister(self, handler: EventHandling[C]) -> None:
        """Remove a handler.

        Raises:
            ValueError: The handler is not registered.
        """
        self._handlers.remove(handler)

    def handlers(self) -> tuple[EventHandling[C], ...]:
        """Return the registered handlers, in the order in which they get an event."""
        # A copy, because handlers register and unregister handlers.
        return tuple(self._handlers)

    # work that keeps the launch running

    @property
    def is_busy(self) -> bool:
        """True if an event is queued or a future is not done."""
        return bool(self._events or self._futures)

    def keep_running_for(self, future: asyncio.Future[Any]) -> None:
        """Keep the launch running until the future is done."""
        if future not in self._futures:
            self._futures.add(future)
            future.add_done_callback(lambda _: self._wake_loop())

    def take_errors(self) -> list[BaseException]:
        """Forget the futures that are done; returns what they raised."""
        done = [future for future in self._futures if future.done()]
        self._futures.difference_update(done)
        # A cancellation is not an error, and `exception` would raise it.
        errors = [future.exception() for future in done if not future.cancelled()]
        return [error for error in errors if error is not None]

    async def cancel_rest(self) -> None:
        """Cancel the futures that are not done and drop the queued events."""
        futures, self._futures = self._futures, set()
        for future in futures:
            future.cancel()
        try:
            await _ended(futures)
        finally:
            self._events.clear()

    # processes

    def marked(self, environment: Mapping[str, str]) -> dict[str, str]:
        """Return the environment for a child process, with a mark for it and its descendants."""
        if self._processes is None:
            self._processes = ProcessFamily()
            self._processes.start()
        return self._processes.marked(environment)

    async def stop_processes(self) -> None:
        """Stop the remaining descendants of child processes; returns when they have ended."""
        processes, self._processes = self._processes, None
        if processes is not None:
            # In a thread: it blocks for up to five seconds, and output must still be read.
            stop = asyncio.get_running_loop().run_in_executor(None, processes.stop)
            await _ended({stop})
            stop.result()


async def _ended(futures: set[asyncio.Future[Any]]) -> None:
    """Wait until the futures are done; only then raise a cancellation that came meanwhile."""
    cancellation = None
    while not all(future.done() for future in futures):
        try:
            # Unlike `gather`, this does not pass a cancellation on to the futures.
            await asyncio.wait(futures)
        except asyncio.CancelledError as error:  # noqa: PERF203  the wait goes on
            cancellation = error
    if cancellation is not None:
        raise cancellation
