"""The scheduler of an executor with a pool of threads."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from .entity import Entity
from .exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from .scheduler import Scheduler

if TYPE_CHECKING:
    from concurrent.futures import ThreadPoolExecutor

    from rclpy.context import Context
    from rclpy.task import Task

    from .entity import Work

#: What a callback may raise without ending the spin.
_QUIET = (ExternalShutdownException, ShutdownException, TimeoutException, ConditionReachedException)


class PoolScheduler(Scheduler):
    """Runs callbacks in a pool of threads; what they raise is raised in the spinning thread.

    Args:
        context: Its context.
        pool: The threads.
        num_threads: How many there are.
    """

    def __init__(self, context: Context, pool: ThreadPoolExecutor, num_threads: int) -> None:
        super().__init__(context)
        self._pool = pool
        self._free_threads = num_threads
        self._failures: deque[BaseException] = deque()
        self.waits_for_threads = True

    def check_alive(self) -> None:
        """Raise also what a callback has raised."""
        while self._failures:
            failure = self._failures.popleft()
            if not isinstance(failure, _QUIET):
                raise failure
        super().check_alive()

    def may_run(self, entity: Entity) -> bool:
        """Return True if the scheduler allows it and a thread is free."""
        return self._free_threads > 0 and super().may_run(entity)

    def run(self, source: Entity | Task[Any], work: Work | None) -> None:
        if isinstance(source, Entity) and not source._GATED:
            # Handing a response to its future takes no thread: all may be waiting for it.
            self.execute(source, work)
            return
        with self.lock:  # so that the pool is not shut down between this check and the submission
            if not self.is_shutdown:
                self._free_threads -= 1
                self._pool.submit(self._run_in_pool, source, work)
                return
        # `next` had claimed the group.
        if isinstance(source, Entity):
            self._release_group(source)
        raise ShutdownException

    def _run_in_pool(self, source: Entity | Task[Any], work: Work | None) -> None:
        try:
            self.execute(source, work)
        except BaseException as failure:  # noqa: BLE001 - it is raised where spin was called
            self._failures.append(failure)
            # The spinning thread may be in a wait without a limit; it raises the failure.
            self.wake()
        with self.lock:
            self._free_threads += 1
        # Without a free thread, `may_run` was False for every entity.
        self.resume_paused()

    def shutdown(self, timeout_sec: float | None) -> bool:
        ended = super().shutdown(timeout_sec)
        with self.lock:
            # Without waiting again, because the time limit is used up.
            self._pool.shutdown(wait=False)
        return ended

    def close(self) -> None:
        """Close the scheduler and end the threads."""
        super().close()
        in_callback = self._running.of_this_thread() > 0  # perhaps a thread of the pool
        self._pool.shutdown(wait=self.waits_for_threads and not in_callback)
