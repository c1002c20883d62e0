"""The actions of the domain."""

from __future__ import annotations

from ros2doctor.api.graph_snapshot import list_report, snapshot
from ros2doctor.api.reporting import DoctorReport, Report


class ActionReport(DoctorReport):
    """Reports how many servers and clients each action has."""

    def category(self) -> str:
        return "action"

    def report(self) -> Report:
        labels = ("action", "action server count", "action client count")
        return list_report("ACTION LIST", labels, snapshot().actions)
