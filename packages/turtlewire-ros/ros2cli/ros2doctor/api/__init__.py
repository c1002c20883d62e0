"""Checks and reports of ``ros2 doctor``, and of other packages.

A package adds a check by an entry point in the group ``ros2doctor.checks``, and a report by one in
``ros2doctor.report``: `run_checks`, `generate_reports` and ``ros2 doctor`` include them. One that
fails is one line on stderr.

========  ====================================
module    what it holds
========  ====================================
`format`  how reports and warnings are printed
========  ====================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from ros2doctor.api.format import doctor_error, doctor_warn

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

__all__ = [
    "DoctorCheck",
    "DoctorReport",
    "Report",
    "Result",
    "doctor_warn",
    "generate_reports",
    "get_topic_names",
    "reports_of_others",
    "run_checks",
    "run_checks_of_others",
]


_T = TypeVar("_T")


class DoctorCheck:
    """Base of checks."""

    def category(self) -> str:
        """Return the checked category, for example ``network``."""
        raise NotImplementedError

    def check(self) -> Result:
        """Check it."""
        raise NotImplementedError


class DoctorReport:
    """Base of reports."""

    def category(self) -> str:
        """Return the reported category, for example ``network``."""
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
    """Run the checks of ``ros2 doctor`` and of other packages.

    Each fault and each warning that ``ros2 doctor`` would print is printed to stderr.

    Args:
        include_warnings: Whether a check with warnings has failed.
        exclude_packages: Accepted as in ROS 2.

    Returns:
        The categories that failed, how many checks failed, and how many were run to the end.
    """
    own = _OwnCheck()
    outcomes = [(own.category(), own.check()), *_outcomes_of_others()]
    return _failed(outcomes, include_warnings=include_warnings)


def run_checks_of_others(*, include_warnings: bool = False) -> tuple[set[str], int, int]:
    """As `run_checks`, with the checks of other packages alone."""
    return _failed(_outcomes_of_others(), include_warnings=include_warnings)


def generate_reports(
    *,
    categories: Collection[str] | None = None,
    exclude_packages: bool = False,
) -> list[Report]:
    """Return the reports of ``ros2 doctor --report``, with other packages'.

    Args:
        categories: Only these: the titles of the own ones, and what the others say; None for all.
        exclude_packages: Accepted as in ROS 2.
    """
    from ros2doctor.system_report import sections

    found = []
    for title, facts in sections():
        if categories is None or title in categories:
            report = Report(title)
            report.items += facts
            found.append(report)
    return found + reports_of_others(categories)


def reports_of_others(categories: Collection[str] | None = None) -> list[Report]:
    """Return the reports of other packages; of these categories, or all."""

    def reports(extension: DoctorReport) -> list[Report]:
        if categories is not None and extension.category() not in categories:
            return []
        made = extension.report()
        return made if isinstance(made, list) else [made]

    return [report for made in _called("ros2doctor.report", reports) for report in made]


def get_topic_names(skip_topics: Collection[str] = ()) -> list[str]:
    """Names of the topics there are now, but hidden ones and those to skip."""
    from ros2cli.discovery import discovered_graph
    from ros2cli.graph import topics

    with discovered_graph() as graph:
        return [name for name, _ in topics(graph) if name not in skip_topics]


def _outcomes_of_others() -> list[tuple[str, Result]]:
    """Category and result of each check of other packages."""

    def outcome(check: DoctorCheck) -> tuple[str, Result]:
        result = check.check()
        if not isinstance(result, Result):
            raise TypeError(f"check() returned {result!r}, expected a Result")
        return check.category(), result

    return list(_called("ros2doctor.checks", outcome))


def _failed(
    outcomes: list[tuple[str, Result]], *, include_warnings: bool
) -> tuple[set[str], int, int]:
    failed = [
        category
        for category, result in outcomes
        if result.error or (include_warnings and result.warning)
    ]
    return set(failed), len(failed), len(outcomes)


def _called(group: str, function: Callable[[Any], _T]) -> Iterator[_T]:
    """Call a function for each extension of a group; print a failure as one line on stderr."""
    from ros2cli.output import tell
    from ros2cli.plugin_system import instantiate_extensions

    for name, extension in instantiate_extensions(group, unique_instance=True).items():
        try:
            returned = function(extension)
        # Another's code may fail in any way; the other extensions still work.
        except Exception as error:  # noqa: BLE001, PERF203
            tell(f"Failed to call '{group}' extension '{name}': {type(error).__name__}: {error}")
        else:
            yield returned


class _OwnCheck(DoctorCheck):
    """All that ``ros2 doctor`` looks at: the setup, the graph, the transforms."""

    def category(self) -> str:
        return "turtlewire"

    def check(self) -> Result:
        from turtlewire.doctor.examination import examine

        result = Result()
        for finding in examine():
            if finding.is_problem:
                result.add_error()
                doctor_error(f"{finding.text}\n{finding.remedy}")
            else:
                result.add_warning()
                doctor_warn(f"{finding.text}\n{finding.remedy}")
        return result
