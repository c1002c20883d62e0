"""What all executors have in common: they wait for what the entities of their nodes have to do, and run it.

One wait serves everything. The middleware's wait set holds the subscriptions, clients and services,
and is told once when one comes or goes; the earliest timer gives the wait's limit; a guard
condition, a finished future or another thread ends the wait. Nothing is collected anew for a pass,
and nothing polls: an idle executor does not run at all.

Within one cycle the order is that of ROS 2: unfinished tasks (the newest first), the waitables of
all nodes, then node by node its timers, subscriptions, guard conditions, clients and services.
"""

from __future__ import annotations

import threading
import time
import weakref
from collections import deque
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from turtlewire.errors import WireError

from .executor_exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from .executor_wait import ExecutorWait
from .hints import described
from .running_callbacks import RunningCallbacks
from .self_waits import SelfWaits
from .task import Future, Task

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

    from typing_extensions import Self

    from .context import Context
    from .entity import Entity, Work
    from .node import Node

__all__ = ["Executor", "await_or_execute"]

#: A spin within a callback that finds nothing to do for so long is warned of.
_PATIENCE_NS = 1_000_000_000


class Executor:
    """Base of the executors. All methods are thread-safe; one thread spins at a time.

    Args:
        context: None takes the default context.

    Raises:
        NotInitializedException: The context is not initialized.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        from .utilities import get_default_context

        self._context = get_default_context() if context is None else context
        self._wait = ExecutorWait(self._context.wire.create_wait_set())
        self._nodes: dict[Node, int] = {}
        self._nodes_made = 0
        self._entities_made = 0
        self._lock = threading.RLock()
        self._tasks: list[Task] = []
        self._ready: deque[Entity | Task] = deque()
        self._paused: set[Entity] = set()
        self._holders: dict[Task, Entity] = {}
        self._running = RunningCallbacks()
        self._self_waits = SelfWaits()
        self._spinning_thread: int | None = None
        self._response_awaited: Future | None = None
        self._blocked_waits: set[threading.Event] = set()
        self._is_shutdown = False
        self._in_spin = False
        self._context.on_shutdown(self.wake)
        self._context.note_executor(self)

    @property
    def context(self) -> Context:
        """Its context."""
        return self._context

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.shutdown()

    # Nodes

    def add_node(self, node: Node) -> bool:
        """Serve ``node`` from now on; it leaves the executor that served it before.

        Returns:
            False when this executor serves it already.

        Raises:
            TypeError: It is no node.
        """
        from .node import Node

        if not isinstance(node, Node):
            raise TypeError(
                f"An executor serves nodes, such as Node('name'), not {described(node)}"
            )
        with self._lock:
            if node in self._nodes:
                return False
            index = self._nodes[node] = self._nodes_made
            self._nodes_made += 1
        node.executor = self
        node._rclpy_endpoints.attach(self, index)
        return True

    def remove_node(self, node: Node) -> None:
        """Serve ``node`` no longer; nothing happens when it does not."""
        with self._lock:
            if self._nodes.pop(node, None) is None:
                return
        node._rclpy_endpoints.detach(self)
        node.executor = None

    def get_nodes(self) -> list[Node]:
        """The nodes that it serves."""
        with self._lock:
            return list(self._nodes)

    def _adopt(self, entity: Entity, node_index: int = -1) -> None:
        """Serve an entity of the node with this number; those of no node come before all others."""
        with self._lock:
            if entity._executor is not None or entity._destroyed:
                return
            self._entities_made += 1
            entity._rank = (node_index, entity._ORDER, self._entities_made)
            entity._executor = weakref.ref(self)
            self._listen_to(entity, entity._attach)

    def _detach(self, entity: Entity) -> None:
        """Serve an entity no longer."""
        with self._lock:
            entity._executor = None
            self._paused.discard(entity)
            self._self_waits.goes_on(entity)
            entity._detach(self)

    # Tasks

    def create_task(
        self, callback: Callable[..., Any] | CoroutineType[Any, Any, Any], *args: Any, **kwargs: Any
    ) -> Task:
        """Run a function or a coroutine on this executor.

        Returns:
            The task, a future of its result.
        """
        task = Task(callback, args, kwargs, executor=self)
        self._schedule(task)
        return task

    def _schedule(self, task: Task) -> None:
        with self._lock:
            self._tasks.append(task)
        self.wake()

    # Spinning

    def spin(self) -> None:
        """Run callbacks until the executor or its context is shut down.

        Raises:
            ExternalShutdownException: The context was shut down by a signal, or by another thread
                while it waited.
            KeyboardInterrupt: Ctrl-C, in the main thread.
            Exception: What a callback raised.
        """
        outer, self._in_spin = self._in_spin, True
        try:
            while self._context.ok() and not self._is_shutdown:
                self.spin_once()
        finally:
            self._in_spin = outer
        self._after_spin()

    def _after_spin(self) -> None:
        """A signal between two waits leaves ``spin`` as one during a wait does."""
        if self._context.ended_by_signal:
            raise ExternalShutdownException

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for one callback and run it.

        A message for a TransformListener counts, although another thread has stored it already.

        Args:
            timeout_sec: How long to wait; None or negative: without limit, 0: not at all.

        Raises:
            ExternalShutdownException: The context was shut down.
            Exception: What a callback raised.
        """
        self._spin_once(timeout_sec)

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Run callbacks until ``future`` is done, the time is over, or the executor or its context is shut down."""
        self._wake_when_done(future)
        deadline = (
            None if timeout_sec is None or timeout_sec < 0 else time.monotonic() + timeout_sec
        )
        remaining = timeout_sec
        while self._context.ok() and not future.done() and not self._is_shutdown:
            self._spin_once(remaining, future.done)
            if deadline is not None:
                remaining = deadline - time.monotonic()
                if remaining <= 0:
                    return

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | None = None
    ) -> None:
        """Wait for one callback and run it, unless ``future`` is done before."""
        self._wake_when_done(future)
        self._spin_once(timeout_sec, future.done)

    def _wake_when_done(self, future: Future) -> None:
        if isinstance(future, Future):
            future._add_waiter(self.wake)
        elif hasattr(future, "add_done_callback"):  # of concurrent.futures, for example
            future.add_done_callback(lambda _: self.wake())
        else:
            raise TypeError(
                f"Expected a Future, such as call_async() returns, not {described(future)}"
            )

    def _spin_once(
        self, timeout_sec: float | None, condition: Callable[[], bool] | None = None
    ) -> None:
        timeout_ns = (
            None if timeout_sec is None or timeout_sec < 0 else int(timeout_sec * 1_000_000_000)
        )
        outer, me = self._spinning_thread, threading.get_ident()
        if outer is not None and outer != me:
            raise RuntimeError("Executor is already spinning")
        self._spinning_thread = me
        try:
            self._run(*self._next(timeout_ns, condition))
        except (ShutdownException, TimeoutException, ConditionReachedException):
            return
        finally:
            self._spinning_thread = outer

    def wait_for_ready_callbacks(
        self, timeout_sec: float | None = None
    ) -> tuple[Task, Entity | None, Node | None]:
        """For executors of your own, whose ``spin_once`` decides where callbacks run: wait for the next one, its group claimed.

        Returns:
            What to call exactly once, in any thread (a task: it keeps what the callback raises);
            whose callback it is, and the node of that (both None for what :meth:`create_task` was
            given).

        Raises:
            TimeoutException: Nothing was ready in time.
            ShutdownException, ExternalShutdownException: The executor or the context was shut down.
        """
        source, work = self._next(
            None if timeout_sec is None or timeout_sec < 0 else int(timeout_sec * 1_000_000_000),
            None,
        )
        handler = Task(self._execute, (source, work))
        if isinstance(source, Task):
            return handler, None, None
        return (
            handler,
            source,
            next((node for node, index in self._nodes.items() if index == source._rank[0]), None),
        )

    def _run(self, source: Entity | Task, work: Work | None) -> None:
        """Run what :meth:`_next` found; here or in another thread."""
        raise NotImplementedError

    def _next(
        self, timeout_ns: int | None, condition: Callable[[], bool] | None
    ) -> tuple[Entity | Task, Work | None]:
        """The next thing to run, its callback group claimed."""
        deadline = None if timeout_ns is None else time.monotonic_ns() + timeout_ns
        expired = False
        patience = self._patience()
        while True:
            if condition is not None and condition():
                raise ConditionReachedException
            self._check_alive()
            if self._ready:
                source = self._ready.popleft()
                work = None if isinstance(source, Task) else self._claim(source)
                if work is not None or isinstance(source, Task):
                    return source, work
                continue
            if expired:
                raise TimeoutException
            remaining = None if deadline is None else max(0, deadline - time.monotonic_ns())
            expired = remaining == 0
            if patience is None or remaining is not None or not self._paused:
                self._collect(remaining)
                continue
            self._collect(max(0, patience - time.monotonic_ns()))
            if not self._ready and time.monotonic_ns() >= patience:
                patience = None
                self._warn_of_nested_spin()

    def _patience(self) -> int | None:
        """Until when a spin may find nothing to run before that is warned of; None: for ever."""
        is_nested = bool(self._running.of_this_thread()) and self._response_awaited is None
        return time.monotonic_ns() + _PATIENCE_NS if is_nested else None

    def _warn_of_nested_spin(self) -> None:
        from .logging import get_logger

        kinds = ", ".join(sorted({type(entity).__name__ for entity in self._paused}))
        get_logger("rclpy").warning(
            f"A callback spins the executor that runs it, and nothing happens: what is ready ({kinds}) belongs to the callback's "
            "own group. Use an async callback with await, or put them into different callback groups"
        )

    def _check_alive(self) -> None:
        if self._is_shutdown:
            raise ShutdownException
        if not self._context.ok():
            raise ExternalShutdownException

    def _collect(self, timeout_ns: int | None) -> None:
        """Wait until something is ready, and line it up in ROS 2's order."""
        tasks: list[Task] = []
        if self._response_awaited is None:
            with self._lock:
                tasks, self._tasks = self._tasks, []
            if not self._in_spin or self._running.of_this_thread():
                self._wait.expect_background()
        entities = self._wait.wait(0 if tasks else self._self_waits.bounded(timeout_ns))
        self._self_waits.warn()
        self._ready.extend(reversed(tasks))
        self._ready.extend(entities)

    def wake(self) -> None:
        """End the current wait, or the next one at once."""
        self._wait.wake()

    # Callback groups

    def can_execute(self, entity: Entity) -> bool:
        """Whether the callback group of an entity lets it run at this moment."""
        return entity.callback_group.can_execute(entity)

    def _claim(self, entity: Entity) -> Work | None:
        """Claim the entity's group and take its work; None when there is none, or the group is busy."""
        if entity._executor is None:
            return None  # destroyed, or moved to another executor meanwhile
        if not entity._GATED:
            return entity._work()
        group = entity.callback_group
        if not self._may_run(entity) or not group.beginning_execution(entity):
            self._pause(entity)
            return None
        work = None
        try:
            work = entity._work()
        finally:
            if work is None:
                self._release(entity)
        return work

    def _pause(self, entity: Entity) -> None:
        with (
            self._lock
        ):  # a thread that ends its callback may resume it at any moment: not in the middle of this
            self._paused.add(entity)
            entity._pause(self)
            self._self_waits.held_up(entity, list(self._holders.values()), self._nodes)
        if self._may_run(entity):  # it became free before we were in the list
            self._resume(entity)

    def _release(self, entity: Entity) -> None:
        """Give the group back, and let those go on that waited for it."""
        if not entity._GATED:
            return
        entity.callback_group.ending_execution(entity)
        self._resume_paused()

    def _resume_paused(self) -> None:
        if not self._paused:
            return
        with self._lock:
            free = [entity for entity in self._paused if self._may_run(entity)]
        for entity in free:
            self._resume(entity)

    def _may_run(self, entity: Entity) -> bool:
        return self._response_awaited is None and entity.callback_group.can_execute(entity)

    def _resume(self, entity: Entity) -> None:
        with self._lock:
            if entity not in self._paused:
                return
            self._paused.discard(entity)
            self._self_waits.goes_on(entity)
            self._listen_to(entity, entity._resume)
        self.wake()

    def _listen_to(self, entity: Entity, attach: Callable[[Executor], None]) -> None:
        """Attach an entity, which another thread or a shutdown may destroy at this moment."""
        try:
            attach(self)
        except WireError:
            if self._context.ok() and not entity._destroyed:
                raise

    # Running

    def _execute(self, source: Entity | Task, work: Work | None) -> None:
        """Run a callback to its end or to its first ``await``, or a task to its next one."""
        with self._running:
            if work is None:
                self._advance(source)  # type: ignore[arg-type]
                return
            callback, arguments = work
            coroutine = None
            try:
                coroutine = callback(*arguments)
            finally:
                if not isinstance(coroutine, CoroutineType):
                    self._release(source)  # type: ignore[arg-type]
            if isinstance(coroutine, CoroutineType):
                task = Task(coroutine, executor=self)
                self._holders[task] = source  # type: ignore[assignment]
                self._advance(task)

    def _advance(self, task: Task) -> None:
        """Run one step of a task; have it run again when what it awaits is done."""
        task()
        if not task.done():
            task._when_runnable(lambda: self._schedule(task))
            return
        holder = self._holders.pop(task, None)
        if holder is not None:
            self._release(holder)
        error = task.exception()
        if error is not None:
            raise error

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Run no further callbacks, and wait for those that run in other threads.

        Returns:
            False when they did not end within ``timeout_sec`` (None or negative: no limit).
        """
        self._is_shutdown = True
        self._wait.end()
        for blocked in list(self._blocked_waits):
            blocked.set()
        if not self._running.wait_for_others(
            None if timeout_sec is None or timeout_sec < 0 else timeout_sec
        ):
            return False
        for node in self.get_nodes():
            self.remove_node(node)
        self._wait.close()
        return True


async def await_or_execute(
    callback: Callable[..., Any] | CoroutineType[Any, Any, Any], *args: Any
) -> Any:
    """The result of a function or of a coroutine (function)."""
    outcome = callback if isinstance(callback, CoroutineType) else callback(*args)
    return await outcome if isinstance(outcome, CoroutineType) else outcome
