"""The parsers of `turtlewire bag info`, `cut`, `filter`, `merge` and `split`."""

from __future__ import annotations

import argparse
from typing import Any

from turtlewire.terminal.parser import complete_bags, complete_files, reporting_errors

_TIMES = (
    "A TIME is an offset from the start of the bag (10s, 1m20s, 500ms), a date "
    "(2024-05-01T12:00:00Z, local time without a zone), or nanoseconds since 1970."
)
_COMPRESSIONS = ("none", "zstd", "lz4", "file")


def add_bag_edits(verbs: Any) -> None:
    """Add the commands that show bags and write new ones to the verbs of `turtlewire bag`."""
    summary = "Show what a bag holds: times, topics, rates, sizes, damage"
    info = _add(verbs, "info", _info, summary, "turtlewire bag info my_bag")
    info.add_argument("--json", action="store_true", help="Print one JSON object")
    for verb, run, summary, example in (
        (
            "cut",
            _cut,
            "Write the messages of a time span into a new bag",
            "turtlewire bag cut my_bag -o part --from 10s --to 1m20s --tf-at-start",
        ),
        (
            "filter",
            _filter,
            "Write some topics of a bag into a new bag",
            "turtlewire bag filter my_bag -o small --exclude '/camera/*'",
        ),
        (
            "merge",
            _merge,
            "Write the messages of several bags into a new bag, in order of time",
            "turtlewire bag merge morning noon -o day",
        ),
    ):
        _add_edit(_add(verbs, verb, run, summary, example))
    summary = "Write a bag into several new bags: OUT/OUT_0, OUT/OUT_1 and so on"
    example = "turtlewire bag split my_bag -o parts --every 60s --tf-at-start"
    split = _add(verbs, "split", _split, summary, example)
    where = split.add_mutually_exclusive_group()
    where.add_argument("--every", metavar="SPAN", help="Length of each bag, such as 60s")
    where.add_argument("--size", help="Begin a bag at this size, such as 1GB or 512MiB")
    where.add_argument(
        "--at", action="append", metavar="TIME", help="Begin a bag at this time; repeatable"
    )
    _add_edit(split)


def _add(verbs: Any, verb: str, run: Any, summary: str, example: str) -> Any:
    epilog = f"Example: {example}" if verb == "info" else f"{_TIMES} Example: {example}"
    parser = verbs.add_parser(verb, help=summary, description=summary, epilog=epilog)
    parser.set_defaults(run=reporting_errors(f"bag {verb}", run), parser=parser)
    name, nargs = ("bags", "+") if verb == "merge" else ("bag", None)
    text = "A folder, or a .mcap, .db3 or .bag file"
    bags = parser.add_argument(name, metavar="BAG", nargs=nargs, help=text)
    bags.completer = complete_bags
    return parser


def _add_edit(parser: argparse.ArgumentParser) -> None:
    """Add the options of `turtlewire.bag.BagOptions`."""
    output: Any = parser.add_argument(
        "-o", "--output", required=True, metavar="OUT", help="The folder to make"
    )
    output.completer = complete_files
    parser.add_argument(
        "--from", dest="start", metavar="TIME", help="Log time of the first message"
    )
    parser.add_argument(
        "--to", dest="end", metavar="TIME", help="Log time at which the new bag ends, not included"
    )
    for option, text in (
        ("--topic", "Take this topic, or topics like '/camera/*'; repeatable (default: all)"),
        ("--exclude", "Leave out this topic, or topics like '/camera/*'; repeatable"),
        ("--type", "Take topics of this type, or types like 'sensor_msgs/*'; repeatable"),
    ):
        parser.add_argument(option, action="append", default=[], metavar="NAME", help=text)
    for option, text in (
        ("--rename", "Rename a topic; repeatable"),
        ("--rename-frame", "Rename a frame in all messages; repeatable"),
    ):
        parser.add_argument(
            option, action="append", default=[], type=_renaming, metavar="OLD:=NEW", help=text
        )
    parser.add_argument(
        "--tf-at-start",
        action="store_true",
        help="Repeat latched messages, such as static transforms, at the start of each bag",
    )
    parser.add_argument(
        "--storage", choices=("mcap", "sqlite3"), help="Storage (default: as the first bag)"
    )
    parser.add_argument(
        "--compression",
        choices=_COMPRESSIONS,
        help="Compression of chunks or messages, or of whole files (default: as the first bag)",
    )


def _renaming(text: str) -> tuple[str, str]:
    old, separator, new = text.partition(":=")
    if not (old and separator and new):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form OLD:=NEW")
    return old, new


def _info(args: argparse.Namespace) -> int:
    from turtlewire.cli.bag_edits import show_info

    print(show_info(args.bag, as_json=args.json))
    return 0


def _cut(args: argparse.Namespace) -> int:
    from turtlewire.cli.bag_edits import run_copy

    if args.start is None and args.end is None:
        args.parser.error("expected --from, --to or both")
    return run_copy(args)


def _filter(args: argparse.Namespace) -> int:
    from turtlewire.cli.bag_edits import run_copy

    return run_copy(args)


def _merge(args: argparse.Namespace) -> int:
    from turtlewire.cli.bag_edits import run_merge

    return run_merge(args)


def _split(args: argparse.Namespace) -> int:
    from turtlewire.cli.bag_edits import run_split

    if args.every is None and args.size is None and args.at is None:
        args.parser.error("expected --every, --size or --at")
    return run_split(args)
