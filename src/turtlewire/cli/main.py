"""The ``turtlewire`` command."""

from __future__ import annotations

import argparse
import math
import os
import sys

__all__ = ["main"]


def main(argv: list[str] | None = None) -> int:
    """Run a command line.

    Args:
        argv: The words after ``turtlewire``; None takes those of this process.

    Returns:
        The exit status: of ``doctor``, 1 when it found a problem; of ``frames``, 1 when there were
        none to print once, and 2 when the network cannot be joined; 130 after Ctrl-C.
    """
    args = _parser().parse_args(sys.argv[1:] if argv is None else argv)
    try:
        return _doctor(args) if args.command == "doctor" else _frames(args)
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # the reader of our output, `head` for example, has seen enough; Python must not write the rest at its end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="turtlewire", description="Transforms on the wire of ROS 2, without ROS."
    )
    commands = parser.add_subparsers(dest="command", required=True)
    doctor = commands.add_parser(
        "doctor", help="Look for what is wrong with the setup and with the TF traffic"
    )
    doctor.add_argument(
        "--listen",
        type=float,
        default=2.0,
        metavar="S",
        help="Listen to the transforms for S seconds",
    )
    frames = commands.add_parser(
        "frames", help="Show the tree of frames: age, rate and publisher of each"
    )
    frames.add_argument("--once", action="store_true", help="Print it once, after the first period")
    frames.add_argument(
        "--json", action="store_true", help="Each tree as a JSON object in one line"
    )
    frames.add_argument(
        "--period",
        type=_seconds,
        default=1.0,
        metavar="S",
        help="Time between two trees (default: %(default)s)",
    )
    return parser


def _seconds(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value <= 3600.0:
        raise argparse.ArgumentTypeError(f"{text!r} is not between 0 and 3600 seconds")
    return value


def _doctor(args: argparse.Namespace) -> int:
    from turtlewire.cli.doctor import examine, report

    findings = examine(args.listen)
    print(report(findings))
    return 1 if any(finding.is_problem for finding in findings) else 0


def _frames(args: argparse.Namespace) -> int:
    from turtlewire.cli.frames import show_frames
    from turtlewire.errors import WireError

    try:
        return show_frames(once=args.once, as_json=args.json, period_s=args.period)
    except WireError as error:
        print(f"turtlewire frames: {error} {error.hint}".rstrip(), file=sys.stderr)
        return 2
