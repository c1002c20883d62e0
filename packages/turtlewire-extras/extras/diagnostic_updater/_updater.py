"""Runs the diagnostic tasks of a node and publishes their statuses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from diagnostic_updater._status_wrapper import DiagnosticStatusWrapper
from diagnostic_updater._tasks import DiagnosticTaskVector

if TYPE_CHECKING:
    from diagnostic_updater._tasks import DiagnosticTask
    from rclpy.node import Node

__all__ = ["Updater"]

_PERIOD, _FULL_NAME = "diagnostic_updater.period", "diagnostic_updater.use_fqn"


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
