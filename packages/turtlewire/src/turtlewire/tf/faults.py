"""Problems of received transforms: rejections, malformed messages, and conflicts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from turtlewire.tf.links import Link, links

if TYPE_CHECKING:
    from turtlewire.tf.implementation import BaseBuffer

__all__ = [
    "Conflict",
    "Malformed",
    "Problem",
    "Refused",
    "conflicts",
    "malformed",
    "problems",
    "refusals",
]


class Refused(NamedTuple):
    """The rejected transforms of one child frame."""

    counts: dict[str, int]
    """Counts by reason.

    The reasons are self_transform, no_child_frame, no_parent_frame, nan_value, old_data,
    reserved_name, bad_name and too_many_frames.
    """
    last: str
    """The reason of the last one in tf2's words."""


class Malformed(NamedTuple):
    """Messages of which nothing could be taken, because the bytes are no ``TFMessage``."""

    messages: int
    last: str
    """What was wrong with the last one; empty if there was none."""
    sender: str
    """Who sent that one."""


class Conflict(NamedTuple):
    """Transforms that contradict each other."""

    kind: str
    """``two publishers``, ``two parents`` or ``loop``."""
    child_frame: str
    text: str


class Problem(NamedTuple):
    """Something wrong with received transforms."""

    kind: str
    """``two publishers``, ``two parents``, ``loop``, ``refused`` or ``malformed``."""
    child_frame: str
    """Empty for malformed messages."""
    count: int  # type: ignore[assignment] # tuple.count is of no use here
    """How many transforms or messages were affected; 1 for a conflict."""
    text: str


def problems(buffer: BaseBuffer) -> list[Problem]:
    """Return conflicts, refused transforms and malformed messages."""
    found = [Problem(each.kind, each.child_frame, 1, each.text) for each in conflicts(buffer)]
    found += [
        Problem("refused", child, sum(refused.counts.values()), refused.last)
        for child, refused in sorted(refusals(buffer).items())
    ]
    broken = malformed(buffer)
    if broken.messages:
        text = f"from '{broken.sender}': {broken.last}"
        found.append(Problem("malformed", "", broken.messages, text))
    return found


def refusals(buffer: BaseBuffer) -> dict[str, Refused]:
    """Return the rejected transforms by child frame; beyond 1000, the rest is ``(others)``."""
    return {
        child: Refused(counts, last)
        for child, (counts, last) in buffer._describe_refusals().items()
    }


def malformed(buffer: BaseBuffer) -> Malformed:
    """Return the number of malformed messages, and the last one's error."""
    return Malformed(*buffer._describe_malformed())


def conflicts(buffer: BaseBuffer) -> list[Conflict]:
    """Frames that several senders move, that go back and forth between parents, or form a loop.

    A sender counts as long as it has sent something within the history that the buffer keeps of the
    link. A frame that is handed over once from one parent to another, as when a gripper takes a
    part, is not a conflict.
    """
    found = []
    known = links(buffer)
    for link in known:
        active = [
            sender for sender in link.senders if link.static or sender.newest_ns >= link.oldest_ns
        ]
        names = sorted({sender.name for sender in active})
        parents = sorted({sender.parent_frame for sender in active})
        if len(names) > 1:
            text = (
                f"'{link.child_frame}' is sent by {' and '.join(map(repr, names))}; "
                "each frame should have one publisher."
            )
            found.append(Conflict("two publishers", link.child_frame, text))
        # As many changes as parents: it has come back to one of them.
        if len(parents) > 1 and (link.static or link.parent_changes >= len(parents)):
            both = " and ".join(map(repr, parents))
            text = (
                f"'{link.child_frame}' goes back and forth between the parents {both}; "
                "a frame has one parent."
            )
            found.append(Conflict("two parents", link.child_frame, text))
    return found + _loops(known)


def _loops(known: list[Link]) -> list[Conflict]:
    """Frames that are below themselves by the newest parent of each, in data of one time."""
    by_child = {link.child_frame: link for link in known}
    found, seen = [], set()
    for child in by_child:
        way: list[str] = []
        frame = child
        while frame in by_child and frame not in seen:
            seen.add(frame)
            way.append(frame)
            frame = by_child[frame].parent_frame
        loop = way[way.index(frame) :] if frame in way else []
        moving = [link for name in loop if not (link := by_child[name]).static]
        # Of links that follow each other in time, the older ones are history.
        if loop and (
            not moving
            or max(link.oldest_ns for link in moving) <= min(link.newest_ns for link in moving)
        ):
            text = (
                f"{' in '.join(map(repr, [*loop, loop[0]]))} is a loop; swap parent and child of "
                "one of these transforms."
            )
            found.append(Conflict("loop", loop[0], text))
    return found
