"""The part of an executor that decides what runs next, and runs it.

One wait serves everything. The middleware's wait set holds the subscriptions, clients and services,
and is notified once when one is added or removed; the earliest timer gives the wait's limit; a
guard condition, a finished future or another thread ends the wait. The scheduler neither polls nor
rebuilds its wait set: an idle executor does not run at all.

Within one cycle the order is that of ROS 2: unfinished tasks (the newest first), the waitables of
all nodes, then node by node its timers, subscriptions, guard conditions, clients and services.
"""

from __future__ import annotations

import math
import threading
import time
import weakref
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from rclpy.logging import get_logger
from rclpy.task import Future, Task

from .entity import HANDLED
from .exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from .running_callbacks import RunningCallbacks
from .served_entities import ServedEntities
from .wait import ExecutorWait

if TYPE_CHECKING:
    from rclpy.context import Context
    from turtlewire.wake_up import WakeUp

    from .entity import Entity, Work

#: Idle time after which a spin within a callback logs a warning.
_PATIENCE_NS = 1_000_000_000


class Scheduler(ServedEntities):
    """Finds and runs what is ready. All methods are thread-safe; one thread spins at a time.

    Attributes:
        serves_endlessly: Whether ``spin`` runs: then messages without a callback do not count as
            events.
        blocked: Set when the executor is shut down; for threads that wait for a response.
    """

    def __init__(self, context: Context) -> None:
        wait_set = context.wire.create_wait_set()
        super().__init__(context, ExecutorWait(wait_set))
        # Of an executor that is dropped without a shutdown. On another thread, because the garbage
        # collector runs anywhere, with any lock held.
        self._end = weakref.finalize(self, context.wire.call_soon, wait_set.close)
        self._end.atexit = False  # the context closes all wait sets
        self.serves_endlessly = False
        self.blocked: set[WakeUp] = set()
        self._tasks: list[Task[Any]] = []
        self._ready: deque[Entity | Task[Any]] = deque()
        # An async callback keeps its group claimed until its coroutine ends.
        self._holders: dict[Task[Any], Entity] = {}
        self._running = RunningCallbacks()
        self._spinning_thread: int | None = None
        self._collecting = False
        self._response_awaited: Future[Any] | None = None
        context.on_shutdown(self.wake)
        context._schedulers.add(self)

    # Tasks

    def create_task(
        self, callback: Callable[..., Any] | CoroutineType[Any, Any, Any], *args: Any, **kwargs: Any
    ) -> Task[Any]:
        """Run a function or a coroutine; a future of its result."""
        task: Task[Any] = Task(callback, args, kwargs, executor=self)
        self._schedule(task)
        return task

    def _schedule(self, task: Task[Any]) -> None:
        with self.lock:
            self._tasks.append(task)
        # A callback of the spinning thread needs no wake-up: that thread looks at the tasks before
        # it waits. A signal handler or finalizer may run after it has looked.
        if self._collecting or not self.is_spun_by_this_thread():
            self.wake()

    # Finding the next callback to run

    def spin_once(
        self, timeout_ns: int | None, condition: Callable[[], bool] | None = None
    ) -> None:
        """Wait for the next callback, and run it; raises as :meth:`next`.

        Raises:
            RuntimeError: Another thread spins.
        """
        # A callback may spin its own executor: the outer spin continues afterwards.
        outer, me = self._spinning_thread, threading.get_ident()
        if outer is not None and outer != me:
            raise RuntimeError("Executor is already spinning")
        self._spinning_thread = me
        try:
            self.run(*self.next(timeout_ns, condition))
        finally:
            self._spinning_thread = outer

    def is_spun_by_this_thread(self) -> bool:
        """Return True if this thread spins; waiting here for a callback would deadlock."""
        return self._spinning_thread == threading.get_ident()

    def is_spun(self) -> bool:
        """Return True if any thread spins."""
        return self._spinning_thread is not None

    def next(
        self, timeout_ns: int | None, condition: Callable[[], bool] | None = None
    ) -> tuple[Entity | Task[Any], Work | None]:
        """Wait for the next callback to run, and claim its callback group.

        Raises:
            ConditionReachedException: ``condition()`` is true.
            TimeoutException: Nothing was ready in time (None: no limit).
            ShutdownException, ExternalShutdownException: The executor or the context was shut down.
        """
        remaining = timeout_ns
        deadline = None if timeout_ns is None else time.monotonic_ns() + timeout_ns
        expired = False
        warning_due = 0.0
        while True:
            if condition is not None and condition():
                raise ConditionReachedException
            self.check_alive()
            if self._ready:
                source = self._ready.popleft()
                work = None if isinstance(source, Task) else self._claim(source)
                if work is not None or isinstance(source, Task):
                    return source, work
                continue
            if expired:
                raise TimeoutException
            # At the deadline, and with a timeout of 0, there is one more look at what is ready.
            expired = remaining is not None and remaining <= 0
            # Only a wait without a limit can hang, and only entities in busy groups make it hang.
            if remaining is None and self._paused:
                warning_due = self._collect_with_warning(warning_due)
            else:
                self._collect(remaining)
            if deadline is not None:
                remaining = max(0, deadline - time.monotonic_ns())

    def check_alive(self) -> None:
        """Raise if the executor or its context is shut down."""
        if self.is_shutdown:
            raise ShutdownException
        if not self.context.ok():
            raise ExternalShutdownException

    def _collect_with_warning(self, due_ns: float) -> float:
        """Wait without a limit, and warn once if a callback spins and nothing can run.

        Args:
            due_ns: When to warn, as returned by the wait before; 0 at the first wait.
        """
        if due_ns == 0:
            is_nested = bool(self._running.of_this_thread()) and self._response_awaited is None
            due_ns = time.monotonic_ns() + _PATIENCE_NS if is_nested else math.inf
        if due_ns == math.inf:
            self._collect(None)
            return due_ns
        self._collect(max(0, int(due_ns) - time.monotonic_ns()))
        if self._ready or time.monotonic_ns() < due_ns:
            return due_ns
        self.warn_of_nested_spin()
        return math.inf

    def warn_of_nested_spin(self) -> None:
        """Warn that a callback spins its own executor, where nothing can run."""
        kinds = ", ".join(sorted({type(entity).__name__ for entity in self._paused}))
        get_logger("rclpy").warning(
            "A callback spins its own executor, and nothing can run: the ready entities "
            f"({kinds}) are in the callback's own group. Use an async callback with await, or "
            "put them into different callback groups"
        )

    def _collect(self, timeout_ns: int | None) -> None:
        """Wait until something is ready, and line it up in ROS 2's order."""
        self._collecting = True
        # While a callback blocks for a response, tasks stay in the list.
        takes_tasks = self._response_awaited is None
        # Within an endless spin, only a callback that spins again can wait for such a message.
        if (
            takes_tasks
            and self.wait.background
            and (not self.serves_endlessly or self._running.of_this_thread())
        ):
            self.wait.expect_background()
        if self._self_waits.due:
            timeout_ns = self._self_waits.bounded(timeout_ns)
        # Tasks run at once, but what became ready with them belongs to the same cycle.
        entities = self.wait.wait(0 if takes_tasks and self._tasks else timeout_ns)
        self._collecting = False
        if self._self_waits.due:
            self._self_waits.warn()
        if takes_tasks and self._tasks:
            with self.lock:
                tasks, self._tasks = self._tasks, []
            self._ready.extend(reversed(tasks))
        self._ready.extend(entities)

    def wake(self) -> None:
        """End the current wait, or the next one at once."""
        self.wait.wake()

    # Callback groups

    def _claim(self, entity: Entity) -> Work | None:
        """Claim the entity's group and take its work.

        None if nothing is ready or the group is busy.
        """
        if entity._serving_host() is not self:
            # Destroyed, or its node has left the executor since it became ready. Detached, it is
            # reported again when the node comes back.
            self.wait.detach_parked()
            return None
        if entity._GATED and not (
            self.may_run(entity) and entity.callback_group.beginning_execution(entity)
        ):
            self._pause(entity)
            return None
        work = None
        try:
            work = entity._take() if entity._owner is None else entity._owner._work_of(entity)
        finally:
            # The message was taken elsewhere or cannot be decoded: the group must not stay claimed.
            if work is None:
                self._release_group(entity)
        return work

    def may_run(self, entity: Entity) -> bool:
        """Return True if a callback of this entity may start now."""
        return self._response_awaited is None and entity.callback_group.can_execute(entity)

    def _pause(self, entity: Entity) -> None:
        # With the lock: a thread that ends its callback may resume the entity at any moment.
        with self.lock:
            if entity._serving_host() is not self:  # the group was released after the check above
                return
            self._paused.add(entity)
            entity.callback_group._rclpy_note_wait(self)
            entity._pause(self)
            self._self_waits.held_up(entity, list(self._holders.values()), self.served())
        if self.may_run(entity):  # the group became free before the entity was in the list
            self._resume(entity)

    def _release_group(self, entity: Entity) -> None:
        """Release the group, and resume the entities that waited for it."""
        if not entity._GATED:
            return
        group = entity.callback_group
        group.ending_execution(entity)
        # A callback of this group may have freed another one: programs define their own groups.
        if self._paused:
            self.resume_paused()
        if group._rclpy_schedulers:
            group._rclpy_wake_schedulers()

    def resume_paused(self) -> None:
        """Let all entities report themselves again whose groups have become free."""
        with self.lock:
            free = [entity for entity in self._paused if self.may_run(entity)]
        for entity in free:
            self._resume(entity)

    def _resume(self, entity: Entity) -> None:
        with self.lock:
            if entity not in self._paused:
                return
            self._paused.discard(entity)
            self._self_waits.goes_on(entity)
            self._listen_to(entity, entity._resume)
        self.wake()

    # Running

    def execute(self, source: Entity | Task[Any], work: Work | None) -> None:
        """Run a callback to its end or to its first ``await``, or a task to its next one."""
        if work is HANDLED:
            return
        with self._running:
            if work is None:
                self._advance(source)  # type: ignore[arg-type]
                return
            callback, arguments = work
            coroutine = None
            try:
                coroutine = callback(*arguments)
            finally:
                # A coroutine keeps the group; a callback that raises gives it back.
                if not isinstance(coroutine, CoroutineType):
                    self._release_group(source)  # type: ignore[arg-type]
            if isinstance(coroutine, CoroutineType):
                task: Task[Any] = Task(coroutine, executor=self)
                self._holders[task] = source  # type: ignore[assignment]
                self._advance(task)

    #: Runs what :meth:`next` found; a pool does it in another thread.
    run = execute

    def _advance(self, task: Task[Any]) -> None:
        """Run one step of a task; schedule the next step for when the awaited future is done."""
        is_over = True
        try:
            task()
            is_over = task.done()
        finally:  # also after KeyboardInterrupt, which leaves the task pending
            # Before an error ends the spin: the group must be free again.
            holder = self._holders.pop(task, None) if is_over else None
            if holder is not None:
                self._release_group(holder)
        if not is_over:
            task._when_runnable(lambda: self._schedule(task))
        elif (error := task.exception()) is not None:
            raise error

    # Blocking for a response

    @contextmanager
    def serving_responses(self, future: Future[Any]) -> Iterator[None]:
        """Within the block, only responses are handed out; for a callback that waits for one."""
        outer, self._response_awaited = self._response_awaited, future
        try:
            yield
        finally:
            self._response_awaited = outer
            # During the block, `may_run` returned False for every entity.
            self.resume_paused()

    def holds_up(self, service: str) -> bool:
        """Return True if a request for a service is here that cannot be answered at the moment."""
        # A copy, without the lock: other threads pause and resume entities.
        return any(entity._serves(service) for entity in list(self._paused))

    # The end

    def shutdown(self, timeout_sec: float | None) -> bool:
        """Run no further callbacks, and wait for callbacks that run in other threads.

        Returns:
            False when they did not end within ``timeout_sec`` (None: no limit).
        """
        self.is_shutdown = True
        self.wait.end()
        for blocked in list(self.blocked):
            blocked.set()
        return self._running.wait_for_others(timeout_sec)

    def close(self) -> None:
        """Release the wait set after :meth:`shutdown`."""
        self._end.detach()
        self.wait.close()
