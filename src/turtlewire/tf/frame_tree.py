"""Which frame hangs on which, with the figures of each link: what pictures of a buffer show."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["FrameTree", "Link", "read_frame_tree"]

# One frame of tf2's YAML. Frame names are not quoted in it and may hold colons and quotes, so a YAML parser would not do.
_ENTRY = re.compile(
    r"(?P<child>.*?): \n  parent: '(?P<parent>.*?)'\n  broadcaster: '(?P<broadcaster>.*?)'\n  rate: (?P<rate>\S+)\n"
    r"  most_recent_transform: (?P<newest>\S+)\n  oldest_transform: (?P<oldest>\S+)\n  buffer_length: (?P<length>\S+)\n",
    re.DOTALL,
)


class Describes(Protocol):
    """A buffer of any kind."""

    def all_frames_as_yaml(self) -> str:
        """tf2's description of all frames."""
        ...


class Link(NamedTuple):
    """A frame, its parent, and the samples between them; times in seconds."""

    child: str
    parent: str
    broadcaster: str
    rate_hz: float
    newest: float
    oldest: float
    length: float

    @property
    def is_static(self) -> bool:
        """Whether it holds at all times: static links have no time of their own."""
        return self.newest == 0.0 == self.oldest


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

    def __init__(self, links: Iterable[Link]) -> None:
        self.links = {link.child: link for link in links}
        frames = dict.fromkeys(name for link in self.links.values() for name in (link.parent, link.child))
        self.loops = _loops(self.links)
        cut = {loop[0] for loop in self.loops}
        self.roots = [frame for frame in frames if frame not in self.links] + [loop[0] for loop in self.loops]
        self.children: dict[str, list[str]] = {frame: [] for frame in frames}
        for link in self.links.values():
            if link.child not in cut:
                self.children[link.parent].append(link.child)


def read_frame_tree(buffer: Describes) -> FrameTree:
    """The tree of a buffer as it is now."""
    return FrameTree(
        Link(entry["child"], entry["parent"], entry["broadcaster"], *(float(entry[key]) for key in ("rate", "newest", "oldest", "length")))
        for entry in _ENTRY.finditer(buffer.all_frames_as_yaml())
    )


def _loops(links: dict[str, Link]) -> list[list[str]]:
    loops, settled = [], set[str]()
    for start in links:
        way: dict[str, None] = {}
        frame = start
        while frame in links and frame not in way and frame not in settled:
            way[frame] = None
            frame = links[frame].parent
        if frame in way:  # the walk has come back to itself
            walked = list(way)
            loop = walked[walked.index(frame) :]
            first = min(loop, key=list(links).index)
            loops.append(loop[loop.index(first) :] + loop[: loop.index(first)])
        settled.update(way)
    return loops
