"""`turtlewire bag tf`: the tree of frames of a bag, with rates and gaps."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from turtlewire.bag.transforms import fill_buffer
from turtlewire.cli.frame_picture import take_picture
from turtlewire.terminal.printable import printable, table_lines
from turtlewire.tf.buffer import Buffer

if TYPE_CHECKING:
    from turtlewire.bag import TransformReport
    from turtlewire.cli.frame_picture import Picture
    from turtlewire.tf.links import Link


def show_transforms(
    path: str, topics: str | list[str], static_topics: str | list[str], *, as_json: bool
) -> str:
    """Return the transforms of a bag, as text or as one JSON object.

    Args:
        path: The bag.
        topics: Where transforms were published.
        static_topics: Where static transforms were published.
        as_json: Whether JSON is wanted.

    Raises:
        BagError: ``path`` is not a bag, or has no transforms.
        OSError: The bag cannot be read.
    """
    buffer = Buffer(cache_time_ns=None)
    report = fill_buffer(buffer, path, topics=topics, static_topics=static_topics)
    now_ns = max((link.newest_ns for link in report.links), default=0)
    picture = take_picture(buffer, now_ns)
    fixed = {static_topics} if isinstance(static_topics, str) else set(static_topics)
    return _json(picture, report) if as_json else "\n".join(_lines(picture, report, fixed))


def _lines(picture: Picture, report: TransformReport, fixed: set[str]) -> list[str]:
    links = {link.child_frame: link for link in report.links}
    rows = [("frame", "rate", "samples", "from [s]", "to [s]", "gaps")]
    for row in picture.rows:
        link = links.get(row.frame)
        name = row.branch + printable(row.frame)
        if link is None or link.static:
            rows.append((name, "static" if link else "", "", "", "", ""))
            continue
        times = f"{link.oldest_ns / 1e9:.3f}", f"{link.newest_ns / 1e9:.3f}"
        gaps = str(len(report.gaps.get(row.frame, ())) or "")
        rows.append((name, _rate(link, fixed), f"{link.samples:,}", *times, gaps))
    loops = [f"loop: {printable(' -> '.join((*loop, loop[0])))}" for loop in picture.loops]
    return [report.headline(), *table_lines(rows, left=(0,)), *loops, *report.complaints()]


def _rate(link: Link, fixed: set[str]) -> str:
    """Return the rate of a moving link, and whether it is also sent on a static topic."""
    rate = f"{link.rate_hz:.1f} Hz" if link.rate_hz else "one stamp"
    both = any(sender.name in fixed for sender in link.senders)
    return f"static and {rate}" if both else rate


def _json(picture: Picture, report: TransformReport) -> str:
    links = {link.child_frame: link for link in report.links}
    frames: list[dict[str, Any]] = []
    for row in picture.rows:
        frame: dict[str, Any] = {"frame": row.frame, "parent": row.parent or None}
        if row.frame in links:
            link = links[row.frame]
            frame |= {
                "static": link.static,
                "rate": link.rate_hz,
                "samples": link.samples,
                "oldest_ns": link.oldest_ns,
                "newest_ns": link.newest_ns,
                "gaps": report.gaps.get(row.frame, []),
            }
        frames.append(frame)
    found = {
        "bag": report.name,
        "messages": report.messages,
        "publishers": report.publishers,
        "frames": frames,
        "loops": picture.loops,
        "new_parents": [change._asdict() for change in report.new_parents],
        "steps_back": {child: steps._asdict() for child, steps in report.steps_back.items()},
        "jumps": [jump._asdict() for jump in report.jumps],
        "conflicts": [conflict._asdict() for conflict in report.conflicts],
        "refused": {child: refused.counts for child, refused in report.refused.items()},
        "problems": report.problems,
        "part_of": report.part_of or None,
    }
    return json.dumps(found)
