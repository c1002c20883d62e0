"""The ``turtlewire`` command."""

from __future__ import annotations

import argparse
import sys

__all__ = ["main"]


def main(argv: list[str] | None = None) -> int:
    """Run a command line.

    Args:
        argv: The words after ``turtlewire``; None takes those of this process.

    Returns:
        The exit status: of ``doctor``, 1 when it found a problem.
    """
    parser = argparse.ArgumentParser(prog="turtlewire", description="Transforms on the wire of ROS 2, without ROS.")
    commands = parser.add_subparsers(dest="command", required=True)
    doctor = commands.add_parser("doctor", help="Look for what is wrong with the setup and with the TF traffic")
    doctor.add_argument("--listen", type=float, default=2.0, metavar="S", help="Listen to the transforms for S seconds")
    args = parser.parse_args(sys.argv[1:] if argv is None else argv)

    from turtlewire.cli.doctor import examine, report

    try:
        findings = examine(args.listen)
    except KeyboardInterrupt:
        return 130
    print(report(findings))
    return 1 if any(finding.is_problem for finding in findings) else 0
