"""Problems of received transforms: rejections, malformed messages, and conflicts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from turtlewire.tf.links import links

if TYPE_CHECKING:
    from turtlewire.tf.implementation import BaseBuffer

__all__ = ["Conflict", "Malformed", "Refused", "conflicts", "malformed", "refusals"]


class Refused(NamedTuple):
    """What was refused of one child frame."""

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
    """Senders of one frame who contradict each other."""

    kind: str
    """``two publishers`` or ``two parents``."""
    child_frame: str
    text: str


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
    """Frames that more than one sender moves, or that go back and forth between parents.

    A sender counts as long as it has sent something within the history that the buffer keeps of the
    link. A frame that is handed over once from one parent to another, as when a gripper takes a
    part, is not a conflict.
    """
    found = []
    for link in links(buffer):
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
    return found
