"""The middleware."""

from __future__ import annotations

from ros2doctor.api.reporting import DoctorReport, Report


class RMWReport(DoctorReport):
    """Reports the middleware and its library."""

    def category(self) -> str:
        return "middleware"

    def report(self) -> Report:
        from turtlewire.wire.environment import middleware_library, middleware_name

        name = middleware_name()
        report = Report("RMW MIDDLEWARE")
        report.add_to_report("middleware name", name)
        report.add_to_report("middleware library", middleware_library(name))
        return report
