"""The services of the domain."""

from __future__ import annotations

from ros2doctor.api.graph_snapshot import list_report, snapshot
from ros2doctor.api.reporting import DoctorReport, Report


class ServiceReport(DoctorReport):
    """Reports how many servers and clients each service has."""

    def category(self) -> str:
        return "service"

    def report(self) -> Report:
        labels = ("service", "service count", "client count")
        return list_report("SERVICE LIST", labels, snapshot().services)
