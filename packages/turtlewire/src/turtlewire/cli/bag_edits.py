"""`turtlewire bag cut`, `filter`, `merge` and `split`: write new bags from others."""

from __future__ import annotations

import errno
import os
import sys
from typing import TYPE_CHECKING

from turtlewire.bag import copy_bag, merge_bags, open_bag, split_bag
from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from turtlewire.bag import BagOptions, WrittenBags

__all__ = ["run_copy", "run_merge", "run_split"]

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
            print(f"{shown}: {len(bag):,} messages, {seconds:.3f} s")
    for problem in done.problems:
        print(f"{command}: {printable(problem)}", file=sys.stderr)
    return 1 if done.problems else 0
