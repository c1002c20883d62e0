"""Rejected transforms, counted by frame."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from turtlewire.tf.plain.failure import Refusal, Verdict

_MOST_FRAMES = 1000
"""The refusals of further frames are counted together."""


class MalformedMessages(NamedTuple):
    """Messages in which not even the transforms could be separated."""

    messages: int = 0
    last: str = ""
    sender: str = ""


class RefusalRecord:
    """The number of rejected transforms of a child frame by reason, and the last of them."""

    def __init__(self, last: Refusal) -> None:
        self.counts: Counter[Verdict] = Counter()
        self.last = last


class Refusals:
    """All refusals of a tree.

    Attributes:
        kinds: The number of pairs of a frame and a reason, without the lack of room.
    """

    def __init__(self) -> None:
        self.kinds = 0
        self.by_child: dict[str, RefusalRecord] = {}
        self.malformed = MalformedMessages()

    def add(self, refusal: Refusal) -> None:
        """Count a transform that was not taken."""
        child = refusal.child
        if len(self.by_child) >= _MOST_FRAMES and child not in self.by_child:
            child = "(others)"
        record = self.by_child.setdefault(child, RefusalRecord(refusal))
        record.counts[refusal.verdict] += 1
        if record.counts[refusal.verdict] == 1 and refusal.verdict.value != "too_many_frames":
            self.kinds += 1
        record.last = refusal

    def add_malformed(self, fault: str, sender: str) -> None:
        """Count a message that could not be decoded."""
        self.malformed = MalformedMessages(self.malformed.messages + 1, fault, sender)

    def rename_sender(self, name: str, shown: str) -> None:
        """Show another name for a sender."""
        if self.malformed.sender == name:
            self.malformed = self.malformed._replace(sender=shown)
