"""``ros2 doctor``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument, exclusive
from turtlewire.cli.parser import seconds

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
    """Print the findings; status 1 when there is a problem."""
    if args.report:
        from ros2cli.system_report import system_report

        print(system_report())
        return 0
    from turtlewire.cli.doctor import examine, report

    findings = examine(args.listen)
    failed = [finding for finding in findings if finding.is_problem or args.include_warnings]
    print(report(findings))
    return 1 if failed else 0
