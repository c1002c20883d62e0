"""The display of bags in a notebook."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from turtlewire.bag.times import date_text
from turtlewire.tf.html_table import MOST_ROWS, counted, html_table, html_text

if TYPE_CHECKING:
    from turtlewire.bag.reader import Bag

__all__ = ["bag_html"]

_MOST_PROBLEMS = 10


def bag_html(bag: Bag) -> str:
    """Return the topics, types and counts of a bag as a table, with its times and problems.

    It reads nothing but the bag's metadata, which opening the bag has read.
    """
    topics = sorted(bag.metadata.topics, key=lambda topic: topic.name)
    caption = f": {counted(len(bag), 'message')} of {counted(len(topics), 'topic')}"
    if len(topics) > MOST_ROWS:
        caption += f", the first {MOST_ROWS} of them shown"
    rows = [(topic.name, topic.type, topic.message_count) for topic in topics[:MOST_ROWS]]
    name = os.path.basename(os.path.abspath(bag.path))
    table = html_table(name, caption, ("topic", "type", "messages"), rows)
    return table + "".join(f"<p>{html_text(line)}</p>" for line in (_times(bag), *_problems(bag)))


def _times(bag: Bag) -> str:
    """Return the format of the bag and, if it has messages, its times."""
    files = f"{bag.metadata.storage}, {counted(len(bag.metadata.paths), 'file')}"
    if not len(bag):
        return files
    seconds = bag.metadata.duration_ns / 1e9
    first, last = date_text(bag.start_ns), date_text(bag.end_ns)
    return f"{seconds:,.3f} s, from {first} to {last}; {files}"


def _problems(bag: Bag) -> list[str]:
    lines = [f"Problem: {problem}" for problem in bag.problems[:_MOST_PROBLEMS]]
    if len(bag.problems) > _MOST_PROBLEMS:
        lines.append(f"bag.problems lists all {len(bag.problems):,} problems")
    return lines
