"""This computer, and the distribution of ROS 2."""

from __future__ import annotations

import os
import platform
import sys

from ros2doctor.api.reporting import DoctorCheck, DoctorReport, Report, Result, result_of


class PlatformCheck(DoctorCheck):
    """Checks the installation and the environment variables."""

    def category(self) -> str:
        return "platform"

    def check(self) -> Result:
        from turtlewire.doctor.setup_findings import setup_findings

        return result_of(setup_findings(os.environ, sys.path))


class PlatformReport(DoctorReport):
    """Reports the operating system and Python."""

    def category(self) -> str:
        return "platform"

    def report(self) -> Report:
        report = Report("PLATFORM INFORMATION")
        report.add_to_report("system", platform.system())
        report.add_to_report("platform info", platform.platform())
        report.add_to_report("release", platform.release())
        report.add_to_report("processor", platform.machine())
        report.add_to_report("python", f"{platform.python_version()} ({sys.executable})")
        return report


class RosdistroReport(DoctorReport):
    """Reports the distribution, and the settings of discovery."""

    def category(self) -> str:
        return "platform"

    def report(self) -> Report:
        from importlib.metadata import version

        from turtlewire.distro import current_distro
        from turtlewire.tf.buffer import CORE
        from turtlewire.wire.environment import discovery, domain_id

        chosen = discovery()
        report = Report("ROS 2 INFORMATION")
        report.add_to_report("distribution name", current_distro())
        report.add_to_report("turtlewire", f"{version('turtlewire')} ({CORE} core)")
        report.add_to_report("domain", domain_id())
        report.add_to_report("discovery range", chosen.range.value)
        report.add_to_report("static peers", ";".join(chosen.static_peers) or "none")
        report.add_to_report("AMENT_PREFIX_PATH", os.environ.get("AMENT_PREFIX_PATH", ""))
        return report
