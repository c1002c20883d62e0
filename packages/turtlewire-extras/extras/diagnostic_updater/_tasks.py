"""Diagnostic tasks: each fills a status."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from diagnostic_updater._status_wrapper import DiagnosticStatusWrapper

__all__ = [
    "CompositeDiagnosticTask",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FunctionDiagnosticTask",
]


class DiagnosticTask:
    """Base of all tasks.

    Args:
        name: Its name, which the status has after that of the node.
    """

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:  # noqa: N802  ROS 2's name
        """Return the name."""
        return self.name

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Fill the status, and return it."""
        raise NotImplementedError


class FunctionDiagnosticTask(DiagnosticTask):
    """A task that calls a function.

    Args:
        name: Its name.
        fn: Fills the status, and returns it.
    """

    def __init__(
        self, name: str, fn: Callable[[DiagnosticStatusWrapper], DiagnosticStatusWrapper]
    ) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        return self.fn(stat) or stat


class CompositeDiagnosticTask(DiagnosticTask):
    """Several tasks with one status: their summaries are merged, and their values listed."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[DiagnosticTask] = []

    def addTask(self, task: DiagnosticTask) -> None:  # noqa: N802  ROS 2's name
        """Add a task."""
        self.tasks.append(task)

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        before, merged = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        before.summary(stat)
        for task in self.tasks:
            stat.summary(before)
            stat = task.run(stat)
            merged.mergeSummary(stat)
        stat.summary(merged)
        return stat


class DiagnosticTaskVector:
    """A list of tasks. Thread-safe."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.tasks: list[DiagnosticTask] = []

    def add(self, *task_or_name_and_function: Any) -> None:
        """Add a task: ``add(task)``, or ``add(name, function)``.

        Raises:
            TypeError: The arguments are something else.
        """
        task, *rest = task_or_name_and_function
        if rest:
            task = FunctionDiagnosticTask(task, *rest)
        elif not isinstance(task, DiagnosticTask):
            raise TypeError(f"expected a task, or a name and a function, got {task!r}")
        with self.lock:
            self.tasks.append(task)
        self._added(task)

    def removeByName(self, name: str) -> bool:  # noqa: N802  ROS 2's name
        """Remove the tasks with a name; return False if no task has it."""
        with self.lock:
            rest = [task for task in self.tasks if task.name != name]
            found = len(rest) < len(self.tasks)
            self.tasks = rest
            return found

    def _added(self, task: DiagnosticTask) -> None:
        """Publish that there is a new task; of `Updater`."""
