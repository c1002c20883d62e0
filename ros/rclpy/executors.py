"""The executors: one thread, or a pool of threads; and what their waits end with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .base_executor import Executor, await_or_execute
from .executor_exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from .multi_threaded_executor import MultiThreadedExecutor

if TYPE_CHECKING:
    from .entity import Entity, Work
    from .task import Task

__all__ = [
    "ConditionReachedException",
    "Executor",
    "ExternalShutdownException",
    "MultiThreadedExecutor",
    "ShutdownException",
    "SingleThreadedExecutor",
    "TimeoutException",
    "await_or_execute",
]


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that spins."""

    def _run(self, source: Entity | Task, work: Work | None) -> None:
        self._execute(source, work)
