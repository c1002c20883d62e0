"""The tree of frames of a buffer at one moment, as text and as JSON."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Collection, Iterable, Iterator
from textwrap import wrap
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.terminal.printable import printable
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.tf.frame_tree import read_frame_tree
from turtlewire.tf.tf_topics import TfTopics

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer
    from turtlewire.tf.frame_tree import FrameTree
    from turtlewire.tf.links import Link

#: Smaller stamps are simulated time, not system time [ns].
_WALL_TIME_FROM_NS = 1_000_000_000 * 10**9
#: A link is stale when its newest sample is older than this [s], and than this many periods of its
#: rate.
_STALE_S = 1.0
_STALE_PERIODS = 3.0
_BOLD, _RED, _BLUE, _PLAIN = "\033[1m", "\033[31m", "\033[34m", "\033[0m"
_NUMBER = re.compile(r"(\d+)")
_TOPICS = TfTopics()
_NOTHING = "No transforms on {topics} yet (ROS_DOMAIN_ID={domain})."


class Row(NamedTuple):
    """A frame with its link to the parent; a root has neither age nor publishers.

    Attributes:
        frame: Its id.
        parent: Id of the parent; empty for a root.
        branch: The lines of the tree before the name.
        static: Whether the link is static.
        age_s: How old the newest sample is; None without a parent and for a static link.
        rate_hz: Mean rate of the samples kept.
        publishers: Full names of the nodes that sent it.
        stale: Whether the newest sample is too old.
        departed: Whether the frame moves and its publisher has left the graph.
    """

    frame: str
    parent: str
    branch: str
    static: bool = False
    age_s: float | None = None
    rate_hz: float = 0.0
    publishers: tuple[str, ...] = ()
    stale: bool = False
    departed: bool = False


class Picture(NamedTuple):
    """A buffer at one moment.

    Attributes:
        now_ns: The time that ages refer to: system time, or the newest stamp if stamps come from
            a simulation.
        rows: The frames, each below its parent; siblings in the order of their names, so that a
            frame keeps its place.
        loops: Frames that are their own ancestors, from child to parent.
        missing: The reason if there are no rows.
    """

    now_ns: int
    rows: list[Row]
    loops: list[list[str]]
    missing: str = ""

    def as_json(self) -> str:
        """Return the tree as one line of JSON; the parent of a root is null."""
        frames = [
            {
                "frame": row.frame,
                "parent": row.parent or None,
                "static": row.static,
                "age": row.age_s,
                "rate": row.rate_hz,
                "publishers": row.publishers,
                "stale": row.stale,
                "departed": row.departed,
            }
            for row in self.rows
        ]
        return json.dumps({"now_ns": self.now_ns, "frames": frames, "loops": self.loops})

    def as_text(self, *, coloured: bool = False, columns: int | None = None) -> list[str]:
        """Return a header and a line for each frame, cut at ``columns``."""
        if not self.rows:
            lines = self.missing.splitlines()
            return [part for line in lines for part in wrap(line, columns or len(line))]
        names = [row.branch + printable(row.frame) for row in self.rows]
        width = max(len("frame"), *map(len, names))
        header = f"{'frame':{width}}  {'age':>9}  {'rate':>9}  publisher"
        lines = [_painted(header[:columns], _BOLD if coloured else "")]
        for row, name in zip(self.rows, names, strict=True):
            line = f"{name:{width}}{_figures(row)}".rstrip()[:columns]
            colour = _RED if row.stale or row.departed else _BLUE if row.static else ""
            lines.append(_painted(line, colour if coloured else ""))
        loops = (printable(" -> ".join((*loop, loop[0]))) for loop in self.loops)
        return lines + [f"Loop: {loop}"[:columns] for loop in loops]


def _painted(line: str, colour: str) -> str:
    return f"{colour}{line}{_PLAIN}" if colour else line


def _figures(row: Row) -> str:
    if not row.publishers:
        return ""
    state = "static" if row.age_s is None else f"{row.age_s:.3f} s"
    rate = f"{row.rate_hz:.1f} Hz" if row.rate_hz else ""
    publishers = ", ".join(map(printable, row.publishers))
    mark = "  (publisher left)" if row.departed else "  (stale)" if row.stale else ""
    return f"  {state:>9}  {rate:>9}  {publishers}{mark}"


def take_picture(
    buffer: Buffer,
    wall_ns: int,
    top: str | None = None,
    departed: Collection[str] = (),
    topics: TfTopics = _TOPICS,
) -> Picture:
    """Return the tree of a buffer at a system time.

    Args:
        buffer: What to look at.
        wall_ns: System time.
        top: Take only this frame and those below it; None means all.
        departed: Moving frames whose publisher has left the graph.
        topics: Where the transforms are published.
    """
    tree = read_frame_tree(buffer)
    links = {link.child_frame: link for link in buffer.links() if link.samples}
    newest_ns = max((link.newest_ns for link in links.values() if not link.static), default=wall_ns)
    now_ns = wall_ns if newest_ns >= _WALL_TIME_FROM_NS else newest_ns
    if not tree.children:
        domain = os.environ.get("ROS_DOMAIN_ID") or 0
        return Picture(now_ns, [], [], _NOTHING.format(topics=topics, domain=domain))
    if top is not None and top not in tree.children:
        text = f"No frame {top!r} yet. {did_you_mean(top, tree.children)}".rstrip()
        return Picture(now_ns, [], [], printable(text))
    rows = [
        _row(frame, branch, links, now_ns)._replace(departed=frame in departed)
        for frame, branch in _walk(tree, top)
    ]
    shown = {row.frame for row in rows}
    return Picture(now_ns, rows, [loop for loop in tree.loops if not shown.isdisjoint(loop)])


def _walk(tree: FrameTree, top: str | None) -> Iterator[tuple[str, str]]:
    """Yield every frame after its parent, with the lines before its name.

    Without recursion, for a tree may be deep.
    """
    roots = _by_name(tree.roots) if top is None else [top]
    waiting = [(root, "", "") for root in reversed(roots)]
    while waiting:
        frame, branch, below = waiting.pop()
        yield frame, branch
        children = _by_name(tree.children[frame])
        for child in reversed(children):
            last = child == children[-1]
            corner, line = ("└─ ", "   ") if last else ("├─ ", "│  ")
            waiting.append((child, below + corner, below + line))


def _by_name(frames: Iterable[str]) -> list[str]:
    """Sort by name, ``turtle2`` before ``turtle10``."""
    return sorted(frames, key=lambda frame: (_natural(frame), frame))


def _natural(name: str) -> list[tuple[int, str]]:
    """Return a key by which numbers in names are ordered as numbers."""
    return [
        (int(part), "") if part.isascii() and part.isdigit() else (-1, part)
        for part in _NUMBER.split(name)
    ]


def _row(frame: str, branch: str, links: dict[str, Link], now_ns: int) -> Row:
    link = links.get(frame)
    if link is None:
        return Row(frame, "", branch)
    publishers = tuple(sorted({sender.name for sender in link.senders}))
    if link.static:
        return Row(frame, link.parent_frame, branch, static=True, publishers=publishers)
    age_s, rate_hz = link.age_ns(now_ns) / 1e9, link.rate_hz
    stale = age_s > max(_STALE_S, _STALE_PERIODS / rate_hz if rate_hz else 0.0)
    return Row(frame, link.parent_frame, branch, False, age_s, rate_hz, publishers, stale)
