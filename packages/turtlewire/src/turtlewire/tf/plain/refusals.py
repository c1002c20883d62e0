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


class Refusals:
    """All refusals of a tree.

    Attributes:
        counts: The number of rejected transforms of each child frame, by reason.
        last: The last of each child frame.
        kinds: The number of pairs of a frame and a reason, without the lack of room.
    """

    def __init__(self) -> None:
        self.kinds = 0
        self.counts: dict[str, Counter[Verdict]] = {}
        self.last: dict[str, Refusal] = {}
        self.malformed = MalformedMessages()

    def add(self, refusal: Refusal) -> None:
        """Count a transform that was not taken."""
        child = refusal.child
        if len(self.counts) >= _MOST_FRAMES and child not in self.counts:
            child = "(others)"
        counts = self.counts.setdefault(child, Counter())
        counts[refusal.verdict] += 1
        if counts[refusal.verdict] == 1 and refusal.verdict.value != "too_many_frames":
            self.kinds += 1
        self.last[child] = refusal

    def add_malformed(self, fault: str, sender: str) -> None:
        """Count a message that could not be decoded."""
        self.malformed = MalformedMessages(self.malformed.messages + 1, fault, sender)

    def rename_sender(self, name: str, shown: str) -> None:
        """Show another name for a sender."""
        if self.malformed.sender == name:
            self.malformed = self.malformed._replace(sender=shown)
