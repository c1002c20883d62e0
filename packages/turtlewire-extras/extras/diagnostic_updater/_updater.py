"""Diagnostic tasks, the status that each of them fills, and `Updater`, which publishes it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    "CompositeDiagnosticTask",
    "DiagnosticStatusWrapper",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FunctionDiagnosticTask",
    "Updater",
]


_OK = DiagnosticStatus.OK
_PERIOD, _FULL_NAME = "diagnostic_updater.period", "diagnostic_updater.use_fqn"


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A ``DiagnosticStatus`` that a task fills."""

    def summary(self, *status_or_level_and_message: Any) -> None:
        """Set level and message: ``summary(level, message)``, or as another status has them."""
        self.level, self.message = _level_and_message(status_or_level_and_message)

    def clearSummary(self) -> None:  # noqa: N802  ROS 2's name
        """Set the level OK, and no message."""
        self.summary(_OK, "")

    def mergeSummary(self, *status_or_level_and_message: Any) -> None:  # noqa: N802
        """Add level and message: the worse level wins, and its message.

        Messages are joined if both say that something is wrong, or both that nothing is.
        """
        level, message = _level_and_message(status_or_level_and_message)
        if (level > _OK) == (self.level > _OK):
            self.message = "; ".join(text for text in (self.message, message) if text)
        elif level > self.level:
            self.message = message
        self.level = max(level, self.level)

    def add(self, key: str, val: Any) -> None:
        """Add a value, as text."""
        self.values.append(KeyValue(key=key, value=str(val)))


def _level_and_message(given: tuple[Any, ...]) -> tuple[bytes, str]:
    level, message = (given[0].level, given[0].message) if len(given) == 1 else given
    return bytes([level]) if isinstance(level, int) else level, message


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
        """Publish a status for a new task; `Updater` overrides it."""


class Updater(DiagnosticTaskVector):
    """Runs the tasks of a node periodically, and publishes their statuses on ``/diagnostics``.

    Args:
        node: The node. Its parameters ``diagnostic_updater.period`` (in seconds) and
            ``diagnostic_updater.use_fqn`` (the full name of the node in the statuses) count.
        period: Seconds between two runs, unless the parameter is set.

    Attributes:
        verbose: True to log each status that is not OK.
        hwid: The hardware id in the statuses.
    """

    def __init__(self, node: Node, period: float = 1.0) -> None:
        super().__init__()
        self.node = node
        self.clock = node.get_clock()
        self.verbose = False
        self.hwid = ""
        self.warn_nohwid_done = False
        self.publisher = node.create_publisher(DiagnosticArray, "/diagnostics", 1)
        self.period = float(self._parameter(_PERIOD, float(period)))
        self.use_fqn = bool(self._parameter(_FULL_NAME, False))
        self.timer = node.create_timer(self.period, self.update)

    def _parameter(self, name: str, default: Any) -> Any:
        if not self.node.has_parameter(name):
            self.node.declare_parameter(name, default)
        return self.node.get_parameter(name).value

    def update(self) -> None:
        """Run the tasks, and publish their statuses."""
        with self.lock:
            tasks = list(self.tasks)
        statuses = []
        for task in tasks:
            status = self._status(task.name)
            status.summary(DiagnosticStatus.ERROR, "No message was set")
            status = task.run(status)
            statuses.append(status)
            if self.verbose and status.level != DiagnosticStatus.OK:
                self.node.get_logger().warning(
                    f"Non-zero diagnostic status. Name: '{status.name}', status "
                    f"{ord(status.level)}: '{status.message}'"
                )
        if not self.hwid and all(status.level == DiagnosticStatus.OK for status in statuses):
            self._warn_of_no_hardware_id()
        self.publish(statuses)

    def force_update(self) -> None:
        """Run the tasks now, in addition to the periodic runs."""
        self.update()

    def setHardwareID(self, hwid: str) -> None:  # noqa: N802  ROS 2's name
        """Set the hardware id in the statuses; ``none`` for a node without hardware."""
        self.hwid = hwid

    def broadcast(self, lvl: bytes, msg: str) -> None:
        """Publish the same level and message for all tasks."""
        with self.lock:
            statuses = [self._status(task.name) for task in self.tasks]
        for status in statuses:
            status.summary(lvl, msg)
        self.publish(statuses)

    def publish(self, msg: DiagnosticStatus | list[Any]) -> None:
        """Publish a status, or several."""
        statuses = msg if isinstance(msg, list) else [msg]
        for status in statuses:
            prefix = f"{self._node_name()}: "
            if not status.name.startswith(prefix):
                status.name = prefix + status.name
        array = DiagnosticArray(status=statuses)
        array.header.stamp = self.clock.now().to_msg()
        self.publisher.publish(array)

    def _node_name(self) -> str:
        node = self.node
        return node.get_fully_qualified_name() if self.use_fqn else node.get_name()

    def _status(self, name: str) -> DiagnosticStatusWrapper:
        status = DiagnosticStatusWrapper()
        status.name, status.hardware_id = name, self.hwid
        return status

    def _added(self, task: DiagnosticTask) -> None:
        status = self._status(task.name)
        status.summary(DiagnosticStatus.OK, "Node starting up")
        self.publish(status)

    def _warn_of_no_hardware_id(self) -> None:
        if self.tasks and not self.warn_nohwid_done:
            self.warn_nohwid_done = True
            self.node.get_logger().warning(
                "diagnostic_updater: No HW_ID was set. This is probably a bug. Please report it. "
                "For devices that do not have a HW_ID, set this value to 'none'. This warning "
                "only occurs once all diagnostics are OK. It is okay to wait until the device is "
                "open before calling setHardwareID."
            )
