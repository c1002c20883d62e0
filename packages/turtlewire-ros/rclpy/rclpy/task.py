"""Futures and tasks: results that come later, and the ``async def`` callbacks that wait for them.

A :class:`Future` can be awaited on an rclpy executor and in a running asyncio loop alike: on an
executor the awaiting task sleeps until the future is done (nothing polls), in asyncio it becomes an
asyncio future of that loop.
"""

from __future__ import annotations

import contextlib
import sys
import threading
import weakref
from collections.abc import Callable, Generator, Iterator
from enum import Enum
from types import CoroutineType
from typing import Any, Generic, Protocol

from ._execution.asyncio_loop import running_loop
from ._typing import T


class FutureState(Enum):
    """The states of a future."""

    PENDING = "PENDING"
    CANCELLED = "CANCELLED"
    FINISHED = "FINISHED"


class _TaskRunner(Protocol):
    """The part of an executor that runs done-callbacks."""

    def create_task(self, callback: Callable[..., Any], *args: Any) -> Any: ...


class Future(Generic[T]):
    """The outcome of something that is not finished yet. Thread-safe.

    Args:
        executor: When given, done-callbacks run as tasks of it; else in the thread that finishes
            the future.
    """

    #: Of the class, because `__del__` also runs when a signal has interrupted `__init__`.
    _exception: BaseException | None = None

    def __init__(self, *, executor: _TaskRunner | None = None) -> None:
        self._done = False
        self._cancelled = False
        self._result: T | None = None
        self._exception_fetched = False
        self._callbacks: list[Callable[[Future[T]], Any]] = []
        self._waiters: list[Callable[[], object]] = []
        self._lock = threading.Lock()
        self._executor: weakref.ref[_TaskRunner] | None = None
        self._set_executor(executor)

    def __del__(self) -> None:
        if self._exception is not None and not self._exception_fetched:
            print(  # noqa: T201 - ROS 2's text and place
                f"The following exception was never retrieved: {self._exception}", file=sys.stderr
            )

    def __await__(self) -> Generator[Any, None, T]:
        if self._pending():
            loop = running_loop()
            # A loop that already ran around the executor does not drive this coroutine.
            if loop is None or loop is _steps.loop_outside:
                # A task may be resumed before the future is done.
                while self._pending():
                    yield self
            else:
                yield from self._as_asyncio_future(loop)
        return self.result()

    def _as_asyncio_future(self, loop: Any) -> Generator[Any, None, None]:
        finished = loop.create_future()

        def finish() -> None:
            if not finished.done():
                finished.set_result(None)

        def wake() -> None:
            with contextlib.suppress(RuntimeError):  # the loop was closed: nobody waits any more
                loop.call_soon_threadsafe(finish)

        with self._waking(wake):  # until it is done, or the awaiting task is cancelled
            yield from finished.__await__()

    def _pending(self) -> bool:
        return not self._done and not self._cancelled

    def cancel(self) -> None:
        """Cancel unless it is done; done-callbacks are called."""
        self._finish(cancelled=True)

    def cancelled(self) -> bool:
        """Return True if it was cancelled."""
        return self._cancelled

    def done(self) -> bool:
        """Return True if it has a result or an exception, or was cancelled."""
        return self._done or self._cancelled

    def result(self) -> T:
        """Return the result, or None before it is set.

        Raises:
            BaseException: What :meth:`set_exception` was given.
        """
        if self._exception is not None:
            self._exception_fetched = True
            raise self._exception
        return self._result  # type: ignore[return-value]  # None before it is done, as in ROS 2

    def exception(self) -> BaseException | None:
        """Return the exception, if it ended with one."""
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: T) -> None:
        """Finish it with a result."""
        self._finish(result=result)

    def set_exception(self, exception: BaseException) -> None:
        """Finish it with an exception, which :meth:`result` will raise."""
        self._finish(exception=exception)

    def add_done_callback(self, callback: Callable[[Future[T]], Any]) -> None:
        """Call ``callback(future)`` when it is done; at once when it is done already.

        With an executor the callback runs as a task of that executor (exceptions leave its
        ``spin``), else in the finishing thread.
        """
        with self._lock:
            if self._pending():
                self._callbacks.append(callback)
                return
        executor = self._get_executor()
        if executor is None:
            callback(self)
        else:
            executor.create_task(callback, self)

    def remove_done_callback(self, callback: Callable[[Future[T]], Any]) -> bool:
        """Forget a done-callback that has not been called yet; return True if there was one."""
        with self._lock:
            if callback not in self._callbacks:
                return False
            self._callbacks.remove(callback)
            return True

    def _finish(
        self, *, result: Any = None, exception: BaseException | None = None, cancelled: bool = False
    ) -> None:
        with self._lock:
            # As in ROS 2, a later result replaces an earlier one, but a cancellation does not.
            if cancelled and not self._pending():
                return
            self._result = result
            self._exception = exception
            self._exception_fetched = False
            self._cancelled = cancelled
            self._done = not cancelled
            waiters, self._waiters = self._waiters, []
            callbacks, self._callbacks = self._callbacks, []
        # Without the lock, because both kinds may use the future.
        for waiter in waiters:
            waiter()
        if callbacks:
            self._run_callbacks(callbacks)

    def _run_callbacks(self, callbacks: list[Callable[[Future[T]], Any]]) -> None:
        executor = self._get_executor()
        for callback in callbacks:
            if executor is not None:
                executor.create_task(callback, self)
                continue
            try:
                callback(self)
            # A callback must not break the thread that finishes the future; ROS 2 warns as well.
            except Exception as error:  # noqa: BLE001
                import warnings

                warnings.warn(f"Unhandled exception in done callback: {error}", stacklevel=3)

    def _add_waiter(self, waiter: Callable[[], object]) -> None:
        """Call ``waiter()`` in the finishing thread, at once when done.

        For wake-ups, which must be short and not raise.
        """
        with self._lock:
            if self._pending():
                self._waiters.append(waiter)
                return
        waiter()

    def _remove_waiter(self, waiter: Callable[[], object]) -> None:
        """Undo one :meth:`_add_waiter`; nothing happens when the future is done."""
        with self._lock, contextlib.suppress(ValueError):
            self._waiters.remove(waiter)

    @contextlib.contextmanager
    def _waking(self, waiter: Callable[[], object]) -> Iterator[None]:
        """Within the block, have :meth:`_add_waiter` call ``waiter()``."""
        self._add_waiter(waiter)
        try:
            yield
        finally:
            self._remove_waiter(waiter)

    def _get_executor(self) -> _TaskRunner | None:
        return None if self._executor is None else self._executor()

    def _set_executor(self, executor: _TaskRunner | None) -> None:
        """Run the done-callbacks on an executor; None: in the finishing thread."""
        self._executor = None if executor is None else weakref.ref(executor)


class Task(Future[T]):
    """Runs a function or a coroutine; its result or exception becomes the task's.

    Calling the task runs it up to its next ``await`` of something unfinished. A task belongs to an
    executor that calls it; :meth:`Executor.create_task <rclpy.executors.Executor.create_task>`
    makes one.
    """

    def __init__(
        self,
        handler: Callable[..., Any] | CoroutineType[Any, Any, Any],
        args: tuple[Any, ...] | list[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        executor: _TaskRunner | None = None,
    ) -> None:
        super().__init__(executor=executor)
        self._handler: Any = handler
        self._args = tuple(args or ())
        self._kwargs = kwargs or {}
        self._step_lock = threading.Lock()
        self._awaited: Any = None

    def __call__(self) -> None:
        """Run one step; nothing happens when it is done, or another thread is running it."""
        if self.done() or not self._step_lock.acquire(blocking=False):
            return
        try:
            if not self.done():
                self._step()
        finally:
            self._step_lock.release()

    def _step(self) -> None:
        try:
            if not isinstance(self._handler, CoroutineType):
                outcome = self._handler(*self._args, **self._kwargs)
                if not isinstance(outcome, CoroutineType):
                    self._complete(result=outcome)
                    return
                self._handler = outcome
            outer, _steps.loop_outside = _steps.loop_outside, running_loop()
            try:
                self._awaited = self._handler.send(None)
            finally:
                _steps.loop_outside = outer
        except StopIteration as stop:
            self._complete(result=stop.value)
        # It becomes the task's outcome, which the executor raises.
        except Exception as error:  # noqa: BLE001
            self._complete(exception=error)

    def _complete(self, **outcome: Any) -> None:
        # A finished task may be kept for its result; the objects of its callback need not be.
        self._handler = self._awaited = None
        self._args, self._kwargs = (), {}
        self._finish(**outcome)

    def _when_runnable(self, resume: Callable[[], None]) -> None:
        """Call ``resume()`` once, when the task can run its next step."""
        awaited, self._awaited = self._awaited, None
        if isinstance(awaited, Future):
            awaited._add_waiter(resume)
        else:
            # Anything else, such as a bare `yield`, is resumed in the next cycle.
            resume()

    def executing(self) -> bool:
        """Return True if a thread is running a step at this moment."""
        return self._step_lock.locked()

    def cancel(self) -> None:
        """Cancel it; a coroutine that waits is closed (its ``finally`` blocks run)."""
        if self.done():
            return
        handler = self._handler
        if isinstance(handler, CoroutineType) and self._step_lock.acquire(blocking=False):
            try:
                handler.close()
            finally:
                self._step_lock.release()
        super().cancel()


class _Steps(threading.local):
    """Distinguishes an asyncio loop that spins an executor from one that a task runs itself.

    Attributes:
        loop_outside: The loop that was running when this thread's innermost task made a step.
    """

    loop_outside: Any = None


_steps = _Steps()
