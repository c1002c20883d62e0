"""Checks and reports of ``ros2 doctor``, and those of other packages.

A package adds a check by an entry point in the group ``ros2doctor.checks``, and a report by one in
``ros2doctor.report``: `run_checks` and `generate_reports` include them. The command ``ros2 doctor``
prints its own findings only.

========  ====================================
module    what it holds
========  ====================================
`format`  how reports and warnings are printed
========  ====================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2doctor.api.format import doctor_error, doctor_warn

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = [
    "DoctorCheck",
    "DoctorReport",
    "Report",
    "Result",
    "doctor_warn",
    "generate_reports",
    "get_topic_names",
    "run_checks",
]


class DoctorCheck:
    """Base of checks."""

    def category(self) -> str:
        """What is checked, for example ``network``."""
        raise NotImplementedError

    def check(self) -> Result:
        """Check it."""
        raise NotImplementedError


class DoctorReport:
    """Base of reports."""

    def category(self) -> str:
        """What is reported, for example ``network``."""
        raise NotImplementedError

    def report(self) -> Report | list[Report]:
        """Report it."""
        raise NotImplementedError


class Report:
    """A title, and lines of a name and a value each.

    Args:
        name: The title.
    """

    __slots__ = ("items", "name")

    def __init__(self, name: str) -> None:
        self.name = name
        self.items: list[tuple[str, Any]] = []

    def add_to_report(self, item_name: str, item_info: Any) -> None:
        """Add a line."""
        self.items.append((item_name, item_info))


class Result:
    """How many errors and warnings a check has found."""

    __slots__ = ("error", "warning")

    def __init__(self) -> None:
        self.error = 0
        self.warning = 0

    def add_error(self) -> None:
        """Count an error."""
        self.error += 1

    def add_warning(self) -> None:
        """Count a warning."""
        self.warning += 1


def run_checks(
    *,
    include_warnings: bool = False,
    exclude_packages: bool = False,
) -> tuple[set[str], int, int]:
    """Run the checks of ``ros2 doctor`` and those of other packages.

    Each fault and each warning that ``ros2 doctor`` would print is printed to stderr.

    Args:
        include_warnings: Whether a check with warnings has failed.
        exclude_packages: Accepted as in ROS 2.

    Returns:
        The categories that failed, how many checks failed, and how many there are.
    """
    from ros2cli.plugin_system import instantiate_extensions

    checks: list[DoctorCheck] = [_OwnCheck()]
    checks += instantiate_extensions("ros2doctor.checks", unique_instance=True).values()
    failed = []
    for check in checks:
        result = check.check()
        if result.error or (include_warnings and result.warning):
            failed.append(check.category())
    return set(failed), len(failed), len(checks)


def generate_reports(
    *,
    categories: Collection[str] | None = None,
    exclude_packages: bool = False,
) -> list[Report]:
    """What ``ros2 doctor --report`` prints, and the reports of other packages.

    Args:
        categories: Only these: the titles of the own ones, and what the others say; None for all.
        exclude_packages: Accepted as in ROS 2.
    """
    from ros2cli.plugin_system import instantiate_extensions
    from ros2cli.system_report import sections

    found = []
    for title, facts in sections():
        if categories is None or title in categories:
            report = Report(title)
            report.items += facts
            found.append(report)
    for extension in instantiate_extensions("ros2doctor.report", unique_instance=True).values():
        if categories is None or extension.category() in categories:
            made = extension.report()
            found += made if isinstance(made, list) else [made]
    return found


def get_topic_names(skip_topics: Collection[str] = ()) -> list[str]:
    """Names of the topics there are now, but hidden ones and those to skip."""
    from ros2cli.discovery import GraphNode
    from ros2cli.graph import topics

    with GraphNode() as graph:
        return [name for name, _ in topics(graph) if name not in skip_topics]


class _OwnCheck(DoctorCheck):
    """All that ``ros2 doctor`` looks at: the setup, the graph, the transforms."""

    def category(self) -> str:
        return "turtlewire"

    def check(self) -> Result:
        from turtlewire.cli.doctor import examine

        result = Result()
        for finding in examine():
            if finding.is_problem:
                result.add_error()
                doctor_error(f"{finding.text}\n{finding.remedy}")
            else:
                result.add_warning()
                doctor_warn(f"{finding.text}\n{finding.remedy}")
        return result
