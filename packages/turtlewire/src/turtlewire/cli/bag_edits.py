"""`turtlewire bag info`, `cut`, `filter`, `merge` and `split`: describe bags, write new ones."""

from __future__ import annotations

import errno
import json
import os
import sys
from collections.abc import Callable
from dataclasses import asdict
from typing import TYPE_CHECKING

from turtlewire.bag import copy_bag, describe_bag, merge_bags, open_bag, split_bag
from turtlewire.bag.times import date_text, size_text
from turtlewire.terminal.printable import printable, table_lines
from turtlewire.wording import counted

if TYPE_CHECKING:
    import argparse

    from turtlewire.bag import BagOptions, BagOverview, TopicOverview, WrittenBags


def show_info(path: str, *, as_json: bool) -> str:
    """Return what a bag holds, as text or as one JSON object.

    Raises:
        BagError: ``path`` is not a bag.
        OSError: The bag cannot be read.
    """
    found = describe_bag(path)
    return json.dumps(asdict(found)) if as_json else "\n".join(_lines(found))


def _lines(bag: BagOverview) -> list[str]:
    kind = " ".join(filter(None, (bag.storage, bag.compression)))
    files = counted(len(bag.files), "file")
    facts = [kind, files, size_text(bag.file_bytes), counted(bag.count, "message")]
    if bag.ros_distro:
        facts.append(printable(bag.ros_distro))
    lines = [f"{printable(bag.path)}: {', '.join(facts)}"]
    if bag.count:
        end_ns = bag.start_ns + bag.duration_ns
        seconds = f"{bag.duration_ns / 1e9:.3f} s"
        lines.append(f"{seconds}, from {date_text(bag.start_ns)} to {date_text(end_ns)}")
    lines += _table(bag)
    missing = sorted({each.type or "(no type)" for each in bag.topics if not each.has_definition})
    if missing:
        lines.append(f"without definitions in the bag: {printable(', '.join(missing))}")
    lines += [f"damaged: {printable(problem)}" for problem in bag.problems]
    return lines


def _table(bag: BagOverview) -> list[str]:
    total = sum(topic.data_bytes for topic in bag.topics) or 1
    rows = [("topic", "messages", "rate", "size", "share", "type")]
    rows += [_row(topic, total) for topic in bag.topics]
    return table_lines(rows, left=(0, 5))


def _row(topic: TopicOverview, total: int) -> tuple[str, str, str, str, str, str]:
    rate = "latched" if topic.latched else f"{topic.rate_hz:.1f} Hz" if topic.rate_hz else ""
    kind = topic.type if topic.encoding == "cdr" else f"{topic.type} ({topic.encoding})"
    share = f"{topic.data_bytes / total:.1%}"
    name = printable(topic.name)
    return name, f"{topic.count:,}", rate, size_text(topic.data_bytes), share, printable(kind)


#: Errors of a disk that cannot take more, as opposed to names that are wrong.
_DISK_ERRORS = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO}


def run_copy(args: argparse.Namespace) -> int:
    """Write a part of a bag; see `_report` for errors and the exit status."""
    return _report(args, lambda: copy_bag(args.bag, args.output, **_options(args)))


def run_merge(args: argparse.Namespace) -> int:
    """Write several bags into one."""
    return _report(args, lambda: merge_bags(args.bags, args.output, **_options(args)))


def run_split(args: argparse.Namespace) -> int:
    """Write a bag into several."""
    return _report(
        args,
        lambda: split_bag(
            args.bag,
            args.output,
            every=args.every,
            size=args.size,
            at=args.at,
            **_options(args),
        ),
    )


def _options(args: argparse.Namespace) -> BagOptions:
    return {
        "start": args.start,
        "end": args.end,
        "topics": args.topic,
        "exclude": args.exclude,
        "types": args.type,
        "rename_topics": dict(args.rename),
        "rename_frames": dict(args.rename_frame),
        "tf_at_start": args.tf_at_start,
        "storage": args.storage,
        "compression": args.compression,
    }


def _report(args: argparse.Namespace, write: Callable[[], WrittenBags]) -> int:
    """Write bags and print a line for each; return 1 if something was damaged or the disk full.

    Raises:
        BagError: The bags or the options do not fit.
        OSError: A file cannot be read, or the output exists.
        KeyboardInterrupt: The user pressed Ctrl-C; nothing is left of the output.
    """
    command = args.parser.prog
    try:
        done = write()
    except KeyboardInterrupt:
        print(f"{command}: interrupted; {args.output} was not written", file=sys.stderr)
        raise
    except OSError as error:
        if error.errno not in _DISK_ERRORS:
            raise
        print(
            f"{command}: {printable(str(error.filename or args.output))}: {error.strerror}; what "
            "was written is removed",
            file=sys.stderr,
        )
        return 1
    for path in done.paths:
        with open_bag(path) as bag:
            seconds = bag.metadata.duration_ns / 1e9
            shown = printable(os.path.relpath(path) if not os.path.isabs(args.output) else path)
            print(f"{shown}: {counted(len(bag), 'message')}, {seconds:.3f} s")
    for problem in done.problems:
        print(f"{command}: {printable(problem)}", file=sys.stderr)
    return 1 if done.problems else 0
