# PYTHON_ARGCOMPLETE_OK
"""The ``turtlewire`` command."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from turtlewire.cli.bag_commands import add_bag_commands, what_to_do_with_bag
from turtlewire.cli.mcp_command import add_mcp
from turtlewire.cli.relay_command import add_relay
from turtlewire.package_sources import pip_install
from turtlewire.plugins import declared
from turtlewire.program import program
from turtlewire.terminal.parser import (
    SuggestingParser,
    add_robot_topics,
    add_tf_topics,
    complete_bags,
    full_topic_name,
    reporting_errors,
    seconds,
    tf_topics,
)

if TYPE_CHECKING:
    from turtlewire.tf.tf_topics import TfTopics

#: Entry points of other distributions: functions that add a command to argparse's subparsers.
_COMMANDS = "turtlewire.commands"
#: The distributions that have these commands.
_DISTRIBUTIONS = {
    "class": "turtlewire-class",
    "foxglove": "turtlewire-view",
    "graph": "turtlewire-view",
    "view": "turtlewire-view",
}
#: What to type instead of words that are not commands.
_NOT_HERE = {
    "demo": "To run the demo: python -m turtlewire.demo; in a clone of turtlewire: scripts/demo",
    "lesson": "To build the lesson, in a clone of turtlewire, and show it: scripts/lesson --serve",
}


@program
def main(argv: list[str] | None = None) -> int:
    """Run a command line.

    Args:
        argv: The words after ``turtlewire``; None for this process's.

    Returns:
        The exit status: 1 if ``doctor`` found a problem or ``frames --once`` had no transform to
        print; 2 if the network cannot be joined or a file cannot be read; 130 after Ctrl-C.
    """
    try:
        return _run(argv)
    except KeyboardInterrupt:
        return 130
    except OSError as error:
        print(f"turtlewire: {error}", file=sys.stderr)
        return 2


def _run(argv: list[str] | None) -> int:
    parser = _parser()
    if "_ARGCOMPLETE" in os.environ:
        _complete(parser)
    words = sys.argv[1:] if argv is None else argv
    if words and words[0] in _DISTRIBUTIONS and words[0] not in declared(_COMMANDS):
        print(
            f"turtlewire {words[0]}: the package {_DISTRIBUTIONS[words[0]]} is not installed. In "
            f"the folder of turtlewire's sources, type: {pip_install()} ./packages/* "
            "./examples/learning_tf2_py",
            file=sys.stderr,
        )
        return 2
    args = parser.parse_args(words)
    if args.run is None:
        parser.print_help()
        return 0
    if isinstance(sys.stdout, io.TextIOWrapper):  # it is None if it was closed at the start
        # A character outside the encoding of a pipe or terminal must not end a command.
        sys.stdout.reconfigure(errors="backslashreplace")
    status: int = args.run(args)
    return status


def _parser() -> SuggestingParser:
    parser = SuggestingParser(
        prog="turtlewire",
        description="Examine ROS 2 transforms, networks and bags, without ROS.",
    )
    parser.add_argument("--version", action=_Version, help="Print the version and exit")
    parser.set_defaults(run=None)
    parser.meant = _meant
    commands = parser.add_subparsers(
        title="Commands",
        description="Call `turtlewire COMMAND -h` for more detailed usage.",
        metavar="COMMAND",
    )
    _add_doctor(commands)
    _add_frames(commands)
    add_mcp(commands)
    add_relay(commands)
    add_bag_commands(commands)
    for _, entry in sorted(declared(_COMMANDS).items()):
        entry.load()(commands)
    return parser


def _meant(word: str) -> str:
    return _NOT_HERE.get(word) or what_to_do_with_bag(word)


def _add_doctor(commands: Any) -> None:
    summary = "Find problems in the installation, the graph and the transforms, or in a bag"
    parser = commands.add_parser("doctor", help=summary, description=summary)
    bag = parser.add_argument(
        "bag", nargs="?", metavar="BAG", help="Check this bag instead of the network"
    )
    bag.completer = complete_bags
    add_tf_topics(parser)
    parser.add_argument(
        "--listen",
        type=seconds,
        metavar="S",
        help="Listen to the transforms for S seconds (default: as long as needed, at most 2)",
    )
    parser.add_argument("--json", action="store_true", help="Print one JSON object")
    parser.set_defaults(run=reporting_errors("doctor", _doctor), parser=parser)


def _add_frames(commands: Any) -> None:
    summary = "Show the frame tree: age, rate and publisher of each frame"
    parser = commands.add_parser("frames", help=summary, description=summary)
    frame = parser.add_argument(
        "frame", nargs="?", metavar="FRAME", help="Show only this frame and its descendants"
    )
    frame.completer = _frame_names
    add_robot_topics(parser)
    parser.add_argument(
        "--once", action="store_true", help="Print one tree after the first period, then exit"
    )
    parser.add_argument("--json", action="store_true", help="Print each tree as a line of JSON")
    parser.add_argument(
        "--period",
        type=seconds,
        default=1.0,
        metavar="S",
        help="Time between two trees (default: %(default)s)",
    )
    parser.set_defaults(run=reporting_errors("frames", _frames), parser=parser)


class _Version(argparse.Action):
    """Reads the version only when it is asked for: importlib.metadata takes 20 ms."""

    def __init__(self, option_strings: Sequence[str], dest: str, **options: Any) -> None:
        super().__init__(option_strings, dest, nargs=0, **options)

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        from importlib.metadata import version

        print("turtlewire", version("turtlewire"))
        parser.exit()


def _complete(parser: SuggestingParser) -> None:
    """Print completions for the shell, and exit."""
    import argcomplete
    from argcomplete.completers import SuppressCompleter

    no_files = SuppressCompleter()
    argcomplete.autocomplete(parser, exclude=["-h", "--help"], default_completer=no_files)


def _frame_names(**_: Any) -> list[str]:
    from turtlewire.doctor.tf_traffic import frame_names

    return frame_names()


def _doctor(args: argparse.Namespace) -> int:
    from turtlewire.doctor.examination import as_json, examine, full_report, report

    as_text = full_report if args.bag is None else report
    if args.bag is None:
        findings = examine(args.listen, _robot_topics(args))
    else:
        if args.listen is not None:
            args.parser.error("--listen cannot be combined with a BAG")
        from turtlewire.cli.bag_findings import examine_bag

        findings = examine_bag(args.bag, *tf_topics(args))
    print(as_json(findings) if args.json else as_text(findings))
    return 1 if any(finding.is_problem for finding in findings) else 0


def _robot_topics(args: argparse.Namespace) -> TfTopics:
    from turtlewire.tf.tf_topics import TfTopics

    moving, static = args.topic or ["/tf"], args.static_topic or ["/tf_static"]
    if len(moving) > 1 or len(static) > 1:
        args.parser.error("only for a BAG, --topic and --static-topic may be repeated")
    return TfTopics(full_topic_name(moving[0]), full_topic_name(static[0]))


def _frames(args: argparse.Namespace) -> int:
    from turtlewire.cli.frames import show_frames
    from turtlewire.tf.tf_topics import TfTopics

    if args.frame is not None and (bag := what_to_do_with_bag(args.frame)):
        args.parser.error(bag)
    return show_frames(
        args.frame,
        TfTopics(args.topic, args.static_topic),
        once=args.once,
        as_json=args.json,
        period_s=args.period,
    )
