"""`turtlewire frames`: the tree of frames as it is now, with the age, the rate and the publisher of each link."""

from __future__ import annotations

import json
import os
import shutil
import sys
import threading
import time
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.printable import printable
from turtlewire.tf import inspection
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.frame_tree import read_frame_tree
from turtlewire.tf.listener import TransformListener

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtlewire.tf.frame_tree import FrameTree

__all__ = ["Picture", "forget_former_time", "show_frames", "take_picture"]

#: Stamps below are of a simulation, and no system time [ns].
_WALL_TIME_FROM_NS = 1_000_000_000 * 10**9
#: A link is stale when its newest sample is older than this [s], and than so many periods of its
#: rate.
_STALE_S = 1.0
_STALE_PERIODS = 3.0
_RED, _BLUE, _PLAIN = "\033[31m", "\033[34m", "\033[0m"
_CLEAR_SCREEN = "\033[H\033[2J"
_NOTHING = "No transforms on /tf and /tf_static yet (ROS_DOMAIN_ID={domain})."


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
    """

    frame: str
    parent: str
    branch: str
    static: bool = False
    age_s: float | None = None
    rate_hz: float = 0.0
    publishers: tuple[str, ...] = ()
    stale: bool = False


class Picture(NamedTuple):
    """A buffer at one moment.

    Attributes:
        now_ns: What ages are counted to: system time, or the newest stamp of all when stamps are of
            a simulation.
        rows: All frames, each below its parent.
        loops: Frames that are their own ancestors, from child to parent.
    """

    now_ns: int
    rows: list[Row]
    loops: list[list[str]]

    def as_json(self) -> str:
        """In one line; roots have null as parent."""
        frames = [
            {
                "frame": row.frame,
                "parent": row.parent or None,
                "static": row.static,
                "age": row.age_s,
                "rate": row.rate_hz,
                "publishers": row.publishers,
                "stale": row.stale,
            }
            for row in self.rows
        ]
        return json.dumps({"now_ns": self.now_ns, "frames": frames, "loops": self.loops})

    def as_text(self, *, coloured: bool = False, columns: int | None = None) -> list[str]:
        """A line for each frame; ``columns`` cuts them."""
        if not self.rows:
            return [_NOTHING.format(domain=os.environ.get("ROS_DOMAIN_ID") or 0)]
        names = [row.branch + printable(row.frame) for row in self.rows]
        width = max(map(len, names))
        lines = []
        for row, name in zip(self.rows, names, strict=True):
            line = f"{name:{width}}{_figures(row)}".rstrip()[:columns]
            colour = _RED if row.stale else _BLUE if row.static else ""
            lines.append(f"{colour}{line}{_PLAIN}" if coloured and colour else line)
        return lines + [
            ("Loop: " + " -> ".join(map(printable, (*loop, loop[0]))))[:columns]
            for loop in self.loops
        ]


def _figures(row: Row) -> str:
    if not row.publishers:
        return ""
    state = "static" if row.age_s is None else f"{row.age_s:.3f} s"
    rate = f"{row.rate_hz:.1f} Hz" if row.rate_hz else ""
    return f"  {state:>9}  {rate:>9}  {', '.join(map(printable, row.publishers))}{'  (stale)' if row.stale else ''}"


def take_picture(buffer: Buffer, wall_ns: int) -> Picture:
    """The tree of a buffer as it is at a system time."""
    tree = read_frame_tree(buffer)
    links = {link.child_frame: link for link in inspection.links(buffer) if link.samples}
    newest_ns = max((link.newest_ns for link in links.values() if not link.static), default=wall_ns)
    now_ns = wall_ns if newest_ns >= _WALL_TIME_FROM_NS else newest_ns
    return Picture(
        now_ns, [_row(frame, branch, links, now_ns) for frame, branch in _walk(tree)], tree.loops
    )


def _walk(tree: FrameTree) -> Iterator[tuple[str, str]]:
    """Every frame after its parent, with the lines before its name; without recursion, for a tree may be deep."""
    waiting = [(root, "", "") for root in reversed(tree.roots)]
    while waiting:
        frame, branch, below = waiting.pop()
        yield frame, branch
        children = tree.children[frame]
        for child in reversed(children):
            last = child == children[-1]
            waiting.append(
                (child, below + ("└─ " if last else "├─ "), below + ("   " if last else "│  "))
            )


def _row(frame: str, branch: str, links: dict[str, inspection.LinkInfo], now_ns: int) -> Row:
    link = links.get(frame)
    if link is None:
        return Row(frame, "", branch)
    publishers = tuple(sorted({sender.name for sender in link.senders}))
    if link.static:
        return Row(frame, link.parent_frame, branch, static=True, publishers=publishers)
    age_s, rate_hz = link.age_ns(now_ns) / 1e9, link.rate_hz
    stale = age_s > max(_STALE_S, _STALE_PERIODS / rate_hz if rate_hz else 0.0)
    return Row(frame, link.parent_frame, branch, False, age_s, rate_hz, publishers, stale)


def show_frames(*, once: bool, as_json: bool, period_s: float) -> int:
    """Listen, and print the tree after every period until interrupted; in a terminal each in place of the former one.

    Args:
        once: Print it once.
        as_json: Each as a JSON object in one line.
        period_s: Time between two, and before the first.

    Returns:
        The exit status: 1 when there were no transforms to print once.
    """
    live = sys.stdout.isatty() and not as_json and not once
    buffer, before = Buffer(), dict[str, tuple[int, int]]()
    with TransformListener(buffer):
        while True:
            threading.Event().wait(period_s)  # nothing sets it: Ctrl-C ends the wait
            before = forget_former_time(buffer, before)
            picture = take_picture(buffer, time.time_ns())
            _print(picture.as_json() if as_json else _screen(picture, live=live))
            if once:
                return 0 if picture.rows else 1


def forget_former_time(
    buffer: Buffer, before: dict[str, tuple[int, int]]
) -> dict[str, tuple[int, int]]:
    """Clear the buffer when a link brings nothing but what is too old for it, as after a simulation or a bag began anew.

    Args:
        buffer: The buffer.
        before: What the call before returned; empty for the first.

    Returns:
        For each link, how many samples were too old for it, and its newest stamp.
    """
    newest = {link.child_frame: link.newest_ns for link in inspection.links(buffer)}
    refused = {
        frame: each.counts.get("old_data", 0) for frame, each in inspection.refusals(buffer).items()
    }
    now = {frame: (refused.get(frame, 0), stamp) for frame, stamp in newest.items()}
    if any(
        now[frame][0] > before[frame][0] and now[frame][1] == before[frame][1]
        for frame in now.keys() & before.keys()
    ):
        buffer.clear()
    return now


def _screen(picture: Picture, *, live: bool) -> str:
    coloured = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    if not live:
        return "\n".join(picture.as_text(coloured=coloured))
    columns, rows = shutil.get_terminal_size()
    lines = picture.as_text(coloured=coloured, columns=columns)
    if len(lines) >= rows:
        lines = [*lines[: rows - 2], f"... and {len(lines) - rows + 2} lines more"]
    return _CLEAR_SCREEN + "\n".join(lines)


def _print(text: str) -> None:
    """To a terminal or file of any encoding."""
    encoding = sys.stdout.encoding or "utf-8"
    print(text.encode(encoding, "replace").decode(encoding), flush=True)
