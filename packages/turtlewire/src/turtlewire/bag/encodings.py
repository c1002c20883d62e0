"""Topics whose messages are not in CDR, the encoding of ROS 2: MCAP files may hold any."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from turtlewire.bag.metadata import TopicInfo

__all__ = ["is_cdr", "is_decodable", "not_in_cdr"]

_MOST_NAMES = 10


def is_cdr(topic: TopicInfo) -> bool:
    """Return whether messages of a topic are in CDR; an encoding without a name counts."""
    return topic.serialization_format in ("cdr", "")


def is_decodable(topic: TopicInfo) -> bool:
    """Return whether messages of a topic are in CDR and of a type that the bag names."""
    return is_cdr(topic) and bool(topic.type)


def not_in_cdr(topics: Iterable[TopicInfo], consequence: str = "neither decoded nor shown") -> str:
    """Name the topics that cannot be decoded, with encoding and type; empty if all can.

    Args:
        topics: The topics, of which some may be decodable.
        consequence: What does not happen to the messages of the others.
    """
    others = sorted((each for each in topics if not is_decodable(each)), key=lambda each: each.name)
    foreign = [
        f"{each.name} ({each.serialization_format} {each.type})"
        for each in others
        if not is_cdr(each)
    ]
    nameless = [each.name for each in others if is_cdr(each)]
    sentences = []
    if foreign:
        sentences.append(
            f"Not in ROS 2's encoding, CDR, and therefore {consequence}: {_listed(foreign)}."
        )
    if nameless:
        sentences.append(
            f"Without a type in the bag, and therefore {consequence}: {_listed(nameless)}."
        )
    return printable(" ".join(sentences))


def _listed(names: list[str]) -> str:
    rest = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
    return f"{', '.join(names[:_MOST_NAMES])}{rest}"
