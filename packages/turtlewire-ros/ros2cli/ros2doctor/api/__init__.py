"""Checks and reports of ``ros2 doctor``, and of other packages.

A package adds a check by an entry point in the group ``ros2doctor.checks``, and a report by one in
``ros2doctor.report``: `run_checks`, `generate_reports` and ``ros2 doctor`` include them. A check
that fails prints one line on stderr.

===================  =============================================
module               contents
===================  =============================================
`action`             the actions of the domain
`environment`        environment variables
`format`             how reports and warnings are printed
`graph_snapshot`     the endpoints of the domain, discovered once
`network`            network interfaces
`package`            versions of packages, compared with releases
`platform`           this computer, and the distribution
`qos_compatibility`  publishers and subscriptions that do not match
`reporting`          the base classes of checks and reports
`rmw`                the middleware
`service`            the services of the domain
`topic`              the topics of the domain
===================  =============================================

`run_checks` examines more than the checks of these modules, transforms included.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from typing import Any, TypeVar

from ros2doctor.api.environment import (
    ALL_ENVIRONMENT_VARIABLES,
    RCUTILS_ENVIRONMENT_VARIABLES,
    RMW_CONNEXTDDS_ENVIRONMENT_VARIABLES,
    RMW_CYCLONEDDS_ENVIRONMENT_VARIABLES,
    RMW_ENVIRONMENT_VARIABLES,
    RMW_FASTRTPS_ENVIRONMENT_VARIABLES,
    RMW_ZENOH_CPP_ENVIRONMENT_VARIABLES,
    ROS_ENVIRONMENT_VARIABLES,
)
from ros2doctor.api.format import doctor_warn
from ros2doctor.api.reporting import DoctorCheck, DoctorReport, Report, Result, result_of

__all__ = [
    "ALL_ENVIRONMENT_VARIABLES",
    "RCUTILS_ENVIRONMENT_VARIABLES",
    "RMW_CONNEXTDDS_ENVIRONMENT_VARIABLES",
    "RMW_CYCLONEDDS_ENVIRONMENT_VARIABLES",
    "RMW_ENVIRONMENT_VARIABLES",
    "RMW_FASTRTPS_ENVIRONMENT_VARIABLES",
    "RMW_ZENOH_CPP_ENVIRONMENT_VARIABLES",
    "ROS_ENVIRONMENT_VARIABLES",
    "DoctorCheck",
    "DoctorReport",
    "Report",
    "Result",
    "doctor_warn",
    "generate_reports",
    "get_service_names",
    "get_topic_names",
    "own_reports",
    "print_warning_notice",
    "reports_of_others",
    "run_checks",
    "run_checks_of_others",
]


_T = TypeVar("_T")
_WARNING = f"""
{"=" * 80}
!!! WARNING !!!
The report includes all ROS 2 endpoint information and system platform information.
Please review the report before sharing, as it may contain sensitive or private data.
{"=" * 80}"""


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
        categories: Only these, for example ``network``; None for all.
        exclude_packages: Accepted as in ROS 2.
    """
    return own_reports(categories) + reports_of_others(categories)


def own_reports(categories: Collection[str] | None = None) -> list[Report]:
    """Return the reports of this package; of these categories, or all."""
    from ros2doctor.api import (
        action,
        environment,
        network,
        platform,
        qos_compatibility,
        rmw,
        service,
        topic,
    )
    from ros2doctor.api.graph_snapshot import one_snapshot

    reports: list[DoctorReport] = [
        platform.PlatformReport(),
        network.NetworkReport(),
        rmw.RMWReport(),
        platform.RosdistroReport(),
        environment.EnvironmentReport(),
        topic.TopicReport(),
        service.ServiceReport(),
        action.ActionReport(),
        qos_compatibility.QoSCompatibilityReport(),
    ]
    with one_snapshot():
        return [
            report
            for each in reports
            if categories is None or each.category() in categories
            for report in _as_list(each.report())
        ]


def reports_of_others(categories: Collection[str] | None = None) -> list[Report]:
    """Return the reports of other packages; of these categories, or all."""

    def reports(extension: DoctorReport) -> list[Report]:
        if categories is not None and extension.category() not in categories:
            return []
        return _as_list(extension.report())

    return [report for made in _called("ros2doctor.report", reports) for report in made]


def _as_list(made: Report | list[Report]) -> list[Report]:
    return made if isinstance(made, list) else [made]


def get_topic_names(skip_topics: Collection[str] = ()) -> list[str]:
    """Return the names of the topics there are now, except hidden ones and ``skip_topics``."""
    from ros2cli.discovery import discovered_graph
    from ros2cli.graph import topics

    with discovered_graph() as graph:
        return [name for name, _ in topics(graph) if name not in skip_topics]


def get_service_names(skip_services: Collection[str] = []) -> list[str]:
    """Return the names of the services there are now, except hidden ones and ``skip_services``."""
    from ros2cli.discovery import discovered_graph
    from ros2cli.graph import services

    with discovered_graph() as graph:
        return [name for name, _ in services(graph) if name not in skip_services]


def print_warning_notice() -> None:
    """Print what to consider before a report is shared."""
    print(_WARNING)


def _outcomes_of_others() -> list[tuple[str, Result]]:
    """Return category and result of each check of other packages."""

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
        # Code of other packages may raise any error; the other extensions still work.
        except Exception as error:  # noqa: BLE001, PERF203
            tell(f"Failed to call '{group}' extension '{name}': {type(error).__name__}: {error}")
        else:
            yield returned


class _OwnCheck(DoctorCheck):
    """The checks of ``ros2 doctor``: the setup, the graph and the transforms."""

    def category(self) -> str:
        return "turtlewire"

    def check(self) -> Result:
        from turtlewire.doctor.examination import examine

        return result_of(examine())
