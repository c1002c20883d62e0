"""``ros2 doctor``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, exclusive
from ros2cli.command import ModuleCommand
from turtlewire.terminal.parser import seconds

VERB_GROUP = "ros2doctor.verb"


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
            help="Accepted for compatibility: only failures are printed",
        ),
    ),
    argument(
        "-iw",
        "--include-warnings",
        action="store_true",
        help="Also count warnings as failures",
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
    from ros2doctor import api
    from ros2doctor.api.format import format_print

    if args.report:
        for report in api.generate_reports():
            format_print(report)
        api.print_warning_notice()
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


class DoctorCommand(ModuleCommand, module=__name__):
    """Look for what is wrong with the setup and the traffic."""


class WtfCommand(DoctorCommand):
    """The same as doctor."""
