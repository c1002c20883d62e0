"""The links of a buffer: the sender of each, its rate, and its first stamp.

Diagrams of a buffer need only this module, so showing a buffer does not import the modules that
create buffers.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, NamedTuple, Protocol

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from typing import TypeAlias

    SenderRow: TypeAlias = tuple[str, str, int, int]
    LinkRow: TypeAlias = tuple[str, str, bool, int, int, int, int, int, list[SenderRow]]

__all__ = [
    "HasLinks",
    "Link",
    "Sender",
    "links",
    "text_tree",
]


class HasLinks(Protocol):
    """A Buffer of either core, as far as its links are concerned."""

    def frames(self) -> list[str]:
        """Return the names of all frames."""
        ...

    def _describe_links(self, most: int) -> list[LinkRow]: ...


class Sender(NamedTuple):
    """A publisher of a link's samples, and the parent that it names."""

    name: str
    parent_frame: str
    samples: int
    newest_ns: int


class Link(NamedTuple):
    """A link of the tree: the transform from a child frame to its parent."""

    child_frame: str
    parent_frame: str
    static: bool
    samples: int
    oldest_ns: int
    newest_ns: int
    parent_changes: int
    """How often the parent changes in the samples kept."""
    memory_bytes: int
    """Of the samples, with the room kept for more; 0 on the plain core."""
    senders: tuple[Sender, ...]
    """The last one to send is the last one here."""

    @property
    def rate_hz(self) -> float:
        """Mean rate of the samples kept; 0 for a static link or a single sample."""
        span = self.newest_ns - self.oldest_ns
        return (self.samples - 1) * 1e9 / span if span else 0.0

    def age_ns(self, now_ns: int) -> int:
        """Return the age of the newest sample; 0 for a static link."""
        return 0 if self.static else now_ns - self.newest_ns


def links(buffer: HasLinks, most: int = sys.maxsize) -> list[Link]:
    """Return the first ``most`` links, in the order in which their frames first arrived."""
    return [Link(*row[:8], _senders(row[8])) for row in buffer._describe_links(most)]


def _senders(rows: list[tuple[str, str, int, int]]) -> tuple[Sender, ...]:
    """One for each name and parent: a sender that got its name late has several rows."""
    merged: dict[tuple[str, str], Sender] = {}
    for name, parent, samples, newest in rows:
        known = merged.pop((name, parent), Sender(name, parent, 0, newest))
        merged[name, parent] = Sender(
            name, parent, known.samples + samples, max(known.newest_ns, newest)
        )
    return tuple(merged.values())


def text_tree(buffer: HasLinks) -> str:
    """Return one line for each frame, indented below its parent; frames of a loop come last."""
    parents = {link.child_frame: link.parent_frame for link in links(buffer)}
    children: dict[str, list[str]] = {}
    for child, parent in parents.items():
        children.setdefault(parent, []).append(child)
    lines: list[str] = []
    seen: set[str] = set()
    frames = buffer.frames()
    for root in [*(frame for frame in frames if frame not in parents), *frames]:
        waiting = [(root, 0)]
        while waiting:
            frame, depth = waiting.pop()
            if frame in seen:
                continue
            seen.add(frame)
            lines.append("  " * depth + printable(frame))
            waiting += [(child, depth + 1) for child in reversed(children.get(frame, []))]
    return "\n".join(lines)
