"""`turtlewire bag info`: a summary of a bag."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING

from turtlewire.bag import describe_bag
from turtlewire.bag.times import date_text, size_text
from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from turtlewire.bag import BagOverview, TopicOverview

__all__ = ["show_info"]


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
    files = f"{len(bag.files)} file{'s' * (len(bag.files) != 1)}"
    facts = [kind, files, size_text(bag.file_bytes), f"{bag.count:,} messages"]
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
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(
            (row[0].ljust(widths[0]), *map(str.rjust, row[1:5], widths[1:5]), row[5])
        ).rstrip()
        for row in rows
    ]


def _row(topic: TopicOverview, total: int) -> tuple[str, str, str, str, str, str]:
    rate = "latched" if topic.latched else f"{topic.rate_hz:.1f} Hz" if topic.rate_hz else ""
    kind = topic.type if topic.encoding == "cdr" else f"{topic.type} ({topic.encoding})"
    share = f"{topic.data_bytes / total:.1%}"
    name = printable(topic.name)
    return name, f"{topic.count:,}", rate, size_text(topic.data_bytes), share, printable(kind)
