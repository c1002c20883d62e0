"""The display of bags in a notebook."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from turtlewire.bag.times import date_text
from turtlewire.tf.notebook import MOST_ROWS, html_table, html_text
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.bag.metadata import BagMetadata

__all__ = ["bag_html"]

_MOST_PROBLEMS = 10


def bag_html(path: str, metadata: BagMetadata, problems: Sequence[str]) -> str:
    """Return the topics, types and counts of a bag as a table, with its times and problems.

    No messages are read: opening the bag has read its metadata.
    """
    topics = sorted(metadata.topics, key=lambda topic: topic.name)
    caption = f": {counted(metadata.message_count, 'message')} of {counted(len(topics), 'topic')}"
    if len(topics) > MOST_ROWS:
        caption += f", the first {MOST_ROWS} of them shown"
    rows = [(topic.name, topic.type, topic.message_count) for topic in topics[:MOST_ROWS]]
    name = os.path.basename(os.path.abspath(path))
    table = html_table(name, caption, ("topic", "type", "messages"), rows)
    lines = (_times(metadata), *_listed(problems))
    return table + "".join(f"<p>{html_text(line)}</p>" for line in lines)


def _times(metadata: BagMetadata) -> str:
    """Return the format of a bag and, if it has messages, its times."""
    files = f"{metadata.storage}, {counted(len(metadata.paths), 'file')}"
    if not metadata.message_count:
        return files
    first = date_text(metadata.start_ns)
    last = date_text(metadata.start_ns + metadata.duration_ns)
    return f"{metadata.duration_ns / 1e9:,.3f} s, from {first} to {last}; {files}"


def _listed(problems: Sequence[str]) -> list[str]:
    lines = [f"Problem: {problem}" for problem in problems[:_MOST_PROBLEMS]]
    if len(problems) > _MOST_PROBLEMS:
        lines.append(f"bag.problems lists all {len(problems):,} problems")
    return lines
