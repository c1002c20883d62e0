"""`turtlewire class`: a class of students, on one page and in reports.

The modules that do the work, which need rclpy and turtlesim, are imported when a verb runs.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turtle_class import ClassError
from turtlewire.terminal.parser import reporting_errors, seconds
from turtlewire.web.desktop import add_page_options

if TYPE_CHECKING:
    import argparse

__all__ = ["add_class_command"]

_EXPECTED = (ClassError, OSError)


def add_class_command(commands: Any) -> None:
    """Add ``class`` to the command's words."""
    summary = "Show the turtles of many students on one page; grade their exercises"
    parser = commands.add_parser("class", help=summary, description=summary)
    parser.set_defaults(run=reporting_errors("class", _show, _EXPECTED), parser=parser)
    who = parser.add_mutually_exclusive_group()
    who.add_argument(
        "--domains",
        default="1-30",
        metavar="N-M",
        help="Show the students of these domains (default: %(default)s)",
    )
    who.add_argument(
        "--roster",
        type=Path,
        metavar="FILE",
        help="Show the students of a file with lines `name,domain`, or YAML with `name: domain`",
    )
    add_page_options(parser)
    verbs = parser.add_subparsers(title="Verbs", metavar="VERB")
    _add_check(verbs)
    _add_grade(verbs)
    _add_start(verbs)
    _add_list(verbs)


def _verb(verbs: Any, name: str, summary: str, run: Callable[..., int | None]) -> Any:
    parser = verbs.add_parser(name, help=summary, description=summary)
    parser.set_defaults(run=reporting_errors("class", run, _EXPECTED), parser=parser)
    return parser


def _add_grade(verbs: Any) -> None:
    summary = "Grade the submissions in a folder; write pages and JUnit XML"
    parser = _verb(verbs, "grade", summary, _grade)
    parser.add_argument(
        "folder", type=Path, metavar="FOLDER", help="Folder with one subfolder per student"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        default=Path("reports"),
        metavar="REPORTS",
        help="Folder for the reports (default: reports)",
    )
    _add_common(parser)


def _add_check(verbs: Any) -> None:
    summary = "Check the exercises of one student, and give hints"
    parser = _verb(verbs, "check", summary, _check)
    parser.add_argument(
        "folder",
        nargs="?",
        type=Path,
        default=Path(),
        metavar="FOLDER",
        help="Folder with one subfolder per exercise (default: current folder)",
    )
    parser.add_argument("--junit", type=Path, metavar="FILE", help="Also write JUnit XML")
    _add_common(parser)


def _add_start(verbs: Any) -> None:
    summary = "Create the exercises in a folder: tasks and files to start with"
    parser = _verb(verbs, "start", summary, _start)
    parser.add_argument(
        "folder", type=Path, metavar="FOLDER", help="Folder to create the exercises in"
    )
    _add_exercises(parser)


def _add_list(verbs: Any) -> None:
    parser = _verb(verbs, "list", "List the exercises", _list)
    parser.add_argument("--json", action="store_true", help="Print one JSON object")


def _add_common(parser: argparse.ArgumentParser) -> None:
    _add_exercises(parser)
    parser.add_argument(
        "--limit",
        type=seconds,
        default=120.0,
        metavar="S",
        help="Stop an exercise after S seconds (default: %(default)g)",
    )


def _add_exercises(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-e",
        "--exercise",
        action="append",
        default=[],
        metavar="NAME",
        help="Use only this exercise; may be given several times (default: all)",
    )


def _show(args: argparse.Namespace) -> None:
    from turtle_class import commands

    commands.show(args.domains, args.roster, args.port, lan=args.lan)


def _grade(args: argparse.Namespace) -> None:
    from turtle_class import commands

    commands.grade(args.folder, args.exercise, args.limit, args.output)


def _check(args: argparse.Namespace) -> int:
    from turtle_class import commands

    status: int = commands.check(args.folder, args.exercise, args.limit, args.junit)
    return status


def _start(args: argparse.Namespace) -> None:
    from turtle_class import commands

    commands.start(args.folder, args.exercise)


def _list(args: argparse.Namespace) -> None:
    from turtle_class import commands

    commands.list_exercises(as_json=args.json)
