"""``ros2 doctor``."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from ros2cli.arguments import argument, exclusive
from turtlewire.terminal.parser import seconds

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "VERBS", "main"]

VERBS = {"hello": "Find out which hosts can hear each other"}


ARGUMENTS = (
    exclusive(
        argument(
            "-r",
            "--report",
            action="store_true",
            help="Print facts for a bug report instead: computer, environment, topics",
        ),
        argument(
            "-rf",
            "--report-failed",
            action="store_true",
            help="Accepted for compatibility: only what fails is printed",
        ),
    ),
    argument(
        "-iw",
        "--include-warnings",
        action="store_true",
        help="Count warnings as failures, too",
    ),
    argument(
        "-ep",
        "--exclude-packages",
        action="store_true",
        help="Accepted for compatibility: versions of packages are not compared",
    ),
    argument(
        "--listen",
        type=seconds,
        metavar="S",
        help="Listen to the transforms for S seconds (default: as long as needed, at most 2)",
    ),
)


def main(args: argparse.Namespace) -> int:
    """Print the findings and what other packages find; status 1 when there is a problem."""
    # By name: ros2doctor stands above, and brings the classes that other packages derive from.
    api, printing = import_module("ros2doctor.api"), import_module("ros2doctor.api.format")
    if args.report:
        from ros2doctor.system_report import system_report

        print(system_report())
        for other in api.reports_of_others():
            printing.format_print(other)
        return 0
    from turtlewire.doctor.examination import examine, full_report

    findings = examine(args.listen)
    failed = [finding for finding in findings if finding.is_problem or args.include_warnings]
    print(full_report(findings), flush=True)
    categories, count, total = api.run_checks_of_others(include_warnings=args.include_warnings)
    if count:
        print(f"\n{count}/{total} check(s) of other packages failed\n")
        print("Failed modules:", *sorted(categories))
    elif total:
        print(f"\nAll {total} checks of other packages passed")
    return 1 if failed or count else 0
