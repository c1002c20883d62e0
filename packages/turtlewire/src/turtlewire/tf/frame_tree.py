"""The parent of each frame, with statistics of its transform, as diagrams show them."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.tf.links import links

if TYPE_CHECKING:
    from turtlewire.tf import links as contents
    from turtlewire.tf.links import HasLinks


__all__ = ["FrameLink", "FrameTree", "find_loops", "read_frame_tree"]

#: tf2 divides by at least this [s] for a rate.
_SHORTEST = 1e-4


class FrameLink(NamedTuple):
    """A frame, its parent, and the samples between them; times in seconds.

    Attributes:
        child: Frame id.
        parent: Frame id.
        broadcaster: Who sent the newest sample.
        is_static: Whether the transform holds at all times; it then has no time.
        rate_hz: As tf2 reckons it: samples by time, of which there is at least 100 microseconds.
        newest: Stamp of the newest sample.
        oldest: Stamp of the oldest sample.
        length: Time between the two.
    """

    child: str
    parent: str
    broadcaster: str
    is_static: bool
    rate_hz: float
    newest: float
    oldest: float
    length: float


class FrameTree:
    """A forest of frames, with loops cut open.

    Args:
        links: One for each frame that has a parent, in order of arrival.

    Attributes:
        links: By child.
        children: By parent, for each frame; loops are cut before the child that arrived first.
        roots: Frames without a parent, then one frame of each loop.
        loops: For each loop its frames, from child to parent.
    """

    def __init__(self, links: Iterable[FrameLink]) -> None:
        self.links = {link.child: link for link in links}
        frames = dict.fromkeys(
            name for link in self.links.values() for name in (link.parent, link.child)
        )
        self.loops = find_loops({link.child: link.parent for link in self.links.values()})
        cut = {loop[0] for loop in self.loops}
        self.roots = [frame for frame in frames if frame not in self.links] + [
            loop[0] for loop in self.loops
        ]
        self.children: dict[str, list[str]] = {frame: [] for frame in frames}
        for link in self.links.values():
            if link.child not in cut:
                self.children[link.parent].append(link.child)


def read_frame_tree(buffer: HasLinks, most: int = sys.maxsize) -> FrameTree:
    """Return the tree of a buffer as it is now; of its first ``most`` links."""
    return FrameTree(_link(info) for info in links(buffer, most) if info.samples)


def _link(info: contents.Link) -> FrameLink:
    length = (info.newest_ns - info.oldest_ns) / 1e9
    rate_hz = info.samples / max(length, _SHORTEST)
    broadcaster = info.senders[-1].name if info.senders else "no recorded authority"
    newest, oldest = info.newest_ns / 1e9, info.oldest_ns / 1e9
    return FrameLink(
        info.child_frame,
        info.parent_frame,
        broadcaster,
        info.static,
        rate_hz,
        newest,
        oldest,
        length,
    )


def find_loops(parents: Mapping[str, str]) -> list[list[str]]:
    """The frames that are their own ancestors: for each loop its frames, from child to parent.

    Args:
        parents: Each child with its parent; a loop begins with the child that stands first here.
    """
    loops, settled = [], set[str]()
    for start in parents:
        way: dict[str, None] = {}
        frame = start
        while frame in parents and frame not in way and frame not in settled:
            way[frame] = None
            frame = parents[frame]
        if frame in way:  # the walk has come back to itself
            walked = list(way)
            loop = walked[walked.index(frame) :]
            first = min(loop, key=list(parents).index)
            loops.append(loop[loop.index(first) :] + loop[: loop.index(first)])
        settled.update(way)
    return loops
