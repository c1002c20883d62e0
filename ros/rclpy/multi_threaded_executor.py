"""The executor with a pool of threads; ``rclpy.executors`` has it under its public name."""

from __future__ import annotations

import os
import threading
from collections import deque
from typing import TYPE_CHECKING

from .base_executor import Executor
from .entity import Entity
from .executor_exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import ThreadPoolExecutor

    from .context import Context
    from .entity import Work
    from .task import Task

__all__ = ["MultiThreadedExecutor"]


class MultiThreadedExecutor(Executor):
    """Runs callbacks in a pool of threads; the thread that spins waits and hands out.

    What a callback raises leaves ``spin`` in the spinning thread.

    Args:
        num_threads: Size of the pool; None takes the number of processors that this process may
            use.
        context: None takes the default context.
    """

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        from concurrent.futures import ThreadPoolExecutor

        super().__init__(context=context)
        if num_threads is None:
            num_threads = (
                len(os.sched_getaffinity(0))
                if hasattr(os, "sched_getaffinity")
                else os.cpu_count() or 1
            )
        if num_threads == 1:
            import warnings

            warnings.warn(
                "MultiThreadedExecutor is used with a single thread.\nUse the SingleThreadedExecutor instead.",
                stacklevel=2,
            )
        self._executor: ThreadPoolExecutor = ThreadPoolExecutor(num_threads)
        self._free_threads = num_threads
        self._failures: deque[BaseException] = deque()

    def _spin_once(
        self, timeout_sec: float | None, condition: Callable[[], bool] | None = None
    ) -> None:
        try:
            super()._spin_once(timeout_sec, condition)
        except ExternalShutdownException:
            return

    def _after_spin(self) -> None:
        """Nothing: a pool's ``spin`` just returns."""

    def _check_alive(self) -> None:
        while self._failures:
            failure = self._failures.popleft()
            if not isinstance(failure, _QUIET):
                raise failure
        super()._check_alive()

    def _may_run(self, entity: Entity) -> bool:
        return self._free_threads > 0 and super()._may_run(entity)

    def _run(self, source: Entity | Task, work: Work | None) -> None:
        if isinstance(source, Entity) and not source._GATED:
            self._execute(
                source, work
            )  # handing a response to its future takes no thread: all of them may be waiting for it
            return
        with self._lock:
            self._free_threads -= 1
        self._executor.submit(self._run_in_pool, source, work)

    def _run_in_pool(self, source: Entity | Task, work: Work | None) -> None:
        try:
            self._execute(source, work)
        except BaseException as failure:  # noqa: BLE001 - it is raised where spin was called
            self._failures.append(failure)
            self.wake()
        with self._lock:
            self._free_threads += 1
        self._resume_paused()

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Run no further callbacks, wait for those that run, and end the threads; see :meth:`Executor.shutdown`."""
        in_pool = threading.get_ident() in {thread.ident for thread in self._executor._threads}
        ended = super().shutdown(timeout_sec)
        self._executor.shutdown(wait=ended and not in_pool)
        return ended


#: What a callback may raise without ending the spin of a multi-threaded executor.
_QUIET = (ExternalShutdownException, ShutdownException, TimeoutException, ConditionReachedException)
