"""The executors, with one thread or a thread pool, and the exceptions that end their waits."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from contextlib import nullcontext
from functools import cache
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from ._execution.exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from ._execution.pool import PoolScheduler
from ._execution.scheduler import Scheduler
from .impl.hints import described, with_hint
from .impl.reexports import reexports
from .signals import rearm, rearm_after_loops
from .task import Future, Task

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from typing_extensions import Self

    from ._execution.entity import Entity
    from .context import Context
    from .node import Node

__all__ = [
    "ConditionReachedException",
    "Executor",
    "ExternalShutdownException",
    "MultiThreadedExecutor",
    "ShutdownException",
    "SingleThreadedExecutor",
    "TimeoutException",
    "TimeoutObject",
    "await_or_execute",
]

__getattr__ = reexports(
    __name__,
    {
        "rclpy.client": ("Client",),
        "rclpy.clock": ("Clock", "ClockType"),
        "rclpy.context": ("Context",),
        "rclpy.exceptions": ("InvalidHandle", "TimerCancelledError"),
        "rclpy.guard_condition": ("GuardCondition", "SignalHandlerGuardCondition"),
        "rclpy.node": ("Node",),
        "rclpy.service": ("Service",),
        "rclpy.subscription": ("Subscription",),
        "rclpy.timer": ("Timer",),
        "rclpy.utilities": ("get_default_context", "timeout_sec_to_nsec"),
        "rclpy.waitable": ("NumberOfEntities", "Waitable"),
    },
)


class TimeoutObject:
    """A timeout that several waits share, and that may change between them.

    Args:
        timeout: Seconds to wait; negative: without limit.
    """

    def __init__(self, timeout: float) -> None:
        self._timeout = timeout

    @property
    def timeout(self) -> float:
        """Seconds to wait."""
        return self._timeout

    @timeout.setter
    def timeout(self, timeout: float) -> None:
        self._timeout = timeout


class Executor:
    """Base of the executors. All methods are thread-safe; one thread spins at a time.

    Args:
        context: None uses the default context.

    Raises:
        NotInitializedException: The context is not initialized.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        from .utilities import get_default_context

        self._context = get_default_context() if context is None else context
        self._nodes: dict[Node, int] = {}
        self._nodes_made = 0
        #: One entry for each loop that runs callbacks; between two callbacks nothing else tells.
        self._spins: list[None] = []
        self._rclpy_scheduler = self._make_scheduler(self._context)

    def _make_scheduler(self, context: Context) -> Scheduler:
        return Scheduler(context)

    @property
    def context(self) -> Context:
        """The context of the executor."""
        return self._context

    def __enter__(self) -> Self:
        return self

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        self.shutdown()

    # Nodes

    def add_node(self, node: Node) -> bool:
        """Serve ``node``; it leaves the executor that served it before.

        Returns:
            False when this executor serves it already.

        Raises:
            TypeError: The argument is not a node.
        """
        node = _node_of(node)
        with self._rclpy_scheduler.lock:
            if node in self._nodes:
                return False
            index = self._nodes[node] = self._nodes_made
            self._nodes_made += 1
        former = node.executor
        if former is not None and former is not self:
            former.remove_node(node)
        node._rclpy_served_by(self)
        node._rclpy_endpoints.attach(self._rclpy_scheduler, index)
        return True

    def remove_node(self, node: Node) -> None:
        """Serve ``node`` no longer; nothing happens when it does not.

        As in ROS 2, ``node.executor`` stays, so that threads can give it tasks between two calls
        of :func:`rclpy.spin_once`.
        """
        node = _node_of(node)
        with self._rclpy_scheduler.lock:
            index = self._nodes.pop(node, None)
            if index is None:
                return
            if index == self._nodes_made - 1:  # the same index if it comes back at once
                self._nodes_made = index
        node._rclpy_endpoints.detach(self._rclpy_scheduler)

    def get_nodes(self) -> list[Node]:
        """Return the nodes that it serves."""
        with self._rclpy_scheduler.lock:
            return list(self._nodes)

    # Tasks

    def create_task(
        self, callback: Callable[..., Any] | CoroutineType[Any, Any, Any], *args: Any, **kwargs: Any
    ) -> Task[Any]:
        """Run a function or a coroutine on this executor.

        Returns:
            The task, a future of its result.
        """
        return self._rclpy_scheduler.create_task(callback, *args, **kwargs)

    def create_future(self) -> Future[Any]:
        """Return a future whose done-callbacks run as tasks of this executor."""
        return Future(executor=self)

    # Spinning

    @property
    def is_spinning(self) -> bool:
        """True while a thread spins."""
        return bool(self._spins) or self._rclpy_scheduler.is_spun()

    def spin(self) -> None:
        """Run callbacks until the executor or its context is shut down.

        Raises:
            ExternalShutdownException: The context was shut down by a signal, or by another thread
                while it waited.
            KeyboardInterrupt: Ctrl-C, in the main thread.
            Exception: A callback raised it.
        """
        rearm()
        scheduler = self._rclpy_scheduler
        outer, scheduler.serves_endlessly = scheduler.serves_endlessly, True
        self._spins.append(None)
        try:
            while self._context.ok() and not scheduler.is_shutdown:
                self.spin_once()
        except ExternalShutdownException:
            if not self._context.ended_at_exit:  # in a daemon thread at exit, no wait is left
                raise
        finally:
            self._spins.pop()
            scheduler.serves_endlessly = outer
        self._after_spin()

    def _after_spin(self) -> None:
        """Raise for a signal between two waits, as for a signal during a wait."""
        if self._context.ended_by_signal:
            raise ExternalShutdownException

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for one callback and run it.

        A message for a TransformListener counts, although another thread has stored it already.

        Args:
            timeout_sec: How long to wait; None or negative: without limit, 0: not at all.

        Raises:
            ExternalShutdownException: The context was shut down.
            Exception: A callback raised it.
        """
        if not self._rclpy_scheduler.serves_endlessly:  # `spin` has done it once
            rearm_after_loops()
        self._spin_once(timeout_sec)

    def spin_until_future_complete(
        self, future: Future[Any], timeout_sec: float | None = None
    ) -> None:
        """Run callbacks until ``future`` is done, or the timeout has passed.

        It also ends when the executor or its context is shut down.
        """
        rearm()
        deadline = (
            None if timeout_sec is None or timeout_sec < 0 else time.monotonic() + timeout_sec
        )
        remaining = timeout_sec
        scheduler = self._rclpy_scheduler
        self._spins.append(None)
        try:
            # Before the first look: another thread may finish the future at any moment.
            with self._waking_when_done(future):
                while self._context.ok() and not future.done() and not scheduler.is_shutdown:
                    self._spin_once(remaining, future.done)
                    if deadline is not None:
                        remaining = deadline - time.monotonic()
                        if remaining <= 0:
                            return
        finally:
            self._spins.pop()

    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: float | None = None
    ) -> None:
        """Wait for one callback and run it, unless ``future`` is done before."""
        rearm_after_loops()
        with self._waking_when_done(future):
            self._spin_once(timeout_sec, future.done)

    def _waking_when_done(self, future: Future[Any]) -> AbstractContextManager[None]:
        if isinstance(future, Future):
            return future._waking(self.wake)
        if hasattr(future, "add_done_callback"):  # of concurrent.futures, which keeps it
            future.add_done_callback(lambda _: self.wake())
            return nullcontext()
        raise TypeError(f"Expected a Future, such as call_async() returns, not {described(future)}")

    def _spin_once(
        self, timeout_sec: float | None, condition: Callable[[], bool] | None = None
    ) -> None:
        try:
            limit_ns = None if timeout_sec is None else _nanoseconds(timeout_sec)
            self._rclpy_scheduler.spin_once(limit_ns, condition)
        # As in ROS 2, these end a single spin without an error.
        except (ShutdownException, TimeoutException, ConditionReachedException):
            return

    def wait_for_ready_callbacks(
        self, timeout_sec: float | TimeoutObject | None = None
    ) -> tuple[Task[Any], Entity | None, Node | None]:
        """Wait for the next callback, its group claimed.

        For executors of your own, whose ``spin_once`` decides where callbacks run.

        Args:
            timeout_sec: How long to wait; None or negative: without limit, 0: not at all.

        Returns:
            What to call exactly once, in any thread (a task: it keeps what the callback raises);
            whose callback it is, and the node of that (both None for what :meth:`create_task` was
            given).

        Raises:
            TimeoutException: Nothing was ready in time.
            ShutdownException, ExternalShutdownException: The executor or the context was shut down.
        """
        if isinstance(timeout_sec, TimeoutObject):
            timeout_sec = timeout_sec.timeout
        source, work = self._rclpy_scheduler.next(_nanoseconds(timeout_sec))
        handler: Task[Any] = Task(self._rclpy_scheduler.execute, (source, work))
        if isinstance(source, Task):
            return handler, None, None
        membership = source._membership  # None if another thread has just destroyed the entity
        with self._rclpy_scheduler.lock:
            nodes = {index: node for node, index in self._nodes.items()}
        node = None if membership is None else nodes.get(membership.node_index)
        entity = source if source._waitable is None else source._waitable
        return handler, entity, node

    def wake(self) -> None:
        """End the current wait, or the next one at once."""
        self._rclpy_scheduler.wake()

    def can_execute(self, entity: Entity) -> bool:
        """Return True if the callback group of an entity lets it run at this moment."""
        return entity.callback_group.can_execute(entity)

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Run no further callbacks, and wait for callbacks that run in other threads.

        Returns:
            False when they did not end within ``timeout_sec`` (None or negative: no limit).
        """
        unlimited = timeout_sec is None or timeout_sec < 0
        if not self._rclpy_scheduler.shutdown(None if unlimited else timeout_sec):
            return False
        for node in self.get_nodes():
            self.remove_node(node)
        self._rclpy_scheduler.close()
        return True


def _node_of(node: Any) -> Node:
    """Return the node, or the one in the attribute ``node``, as the nodes of ros2cli have it.

    Raises:
        TypeError: The argument is not a node.
    """
    node_class = _node_class()
    if isinstance(node, node_class):
        return node
    found = getattr(node, "node", None)
    if not isinstance(found, node_class):
        from .node import BaseNode

        error = TypeError(f"An executor serves nodes, such as Node('name'), not {described(node)}")
        is_asynchronous = isinstance(node, BaseNode)
        raise with_hint(error, "Serve it in asyncio: await node.run()" if is_asynchronous else "")
    return found


@cache
def _node_class() -> type[Node]:
    from .node import Node

    return Node


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that spins."""


class MultiThreadedExecutor(Executor):
    """Runs callbacks in a pool of threads; the thread that spins waits and hands out.

    Exceptions from callbacks propagate out of ``spin``.

    Args:
        num_threads: Size of the pool; None uses the number of processors that this process may
            use.
        context: None uses the default context.
    """

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        from concurrent.futures import ThreadPoolExecutor

        self._num_threads = _processors() if num_threads is None else num_threads
        if num_threads == 1:
            import warnings

            warnings.warn(
                "MultiThreadedExecutor is used with a single thread.\n"
                "Use the SingleThreadedExecutor instead.",
                stacklevel=2,
            )
        # Before the base's constructor, which calls `_make_scheduler`.
        self._executor = ThreadPoolExecutor(self._num_threads)
        super().__init__(context=context)

    def _make_scheduler(self, context: Context) -> Scheduler:
        self._pool_scheduler = PoolScheduler(context, self._executor, self._num_threads)
        return self._pool_scheduler

    def shutdown(self, timeout_sec: float | None = None, *, wait_for_threads: bool = True) -> bool:
        """Run no further callbacks, and wait for callbacks that run in other threads.

        Args:
            timeout_sec: How long to wait for the callbacks; None or negative: no limit.
            wait_for_threads: Whether to wait also until the threads of the pool have ended, once
                the callbacks have.

        Returns:
            False when the callbacks did not end within ``timeout_sec``.
        """
        self._pool_scheduler.waits_for_threads = wait_for_threads
        return super().shutdown(timeout_sec)

    def _spin_once(
        self, timeout_sec: float | None, condition: Callable[[], bool] | None = None
    ) -> None:
        try:
            super()._spin_once(timeout_sec, condition)
        # As in ROS 2, and unlike in the single-threaded executor.
        except ExternalShutdownException:
            return

    def _after_spin(self) -> None:
        """Nothing: a pool's ``spin`` just returns."""


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):
        # A container or `taskset` may allow fewer than `cpu_count` gives.
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _nanoseconds(timeout_sec: float | None) -> int | None:
    """Convert a timeout; None for a wait without limit."""
    if timeout_sec is None or timeout_sec < 0 or timeout_sec >= threading.TIMEOUT_MAX:
        return None
    return int(timeout_sec * 1_000_000_000)


async def await_or_execute(
    callback: Callable[..., Any] | CoroutineType[Any, Any, Any], *args: Any
) -> Any:
    """Return the result of a function or of a coroutine (function)."""
    outcome = callback if isinstance(callback, CoroutineType) else callback(*args)
    return await outcome if isinstance(outcome, CoroutineType) else outcome
