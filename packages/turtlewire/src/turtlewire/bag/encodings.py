"""Topics whose messages are not in CDR, the encoding of ROS 2: MCAP files may hold any."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.bag.metadata import TopicInfo

__all__ = ["is_cdr", "not_in_cdr"]

_MOST_NAMES = 10


def is_cdr(topic: TopicInfo) -> bool:
    """Return whether messages of a topic can be decoded; ROS 1's and unnamed encodings count."""
    return topic.serialization_format in ("cdr", "ros1", "")


def not_in_cdr(topics: Iterable[TopicInfo], consequence: str = "neither decoded nor shown") -> str:
    """Name the topics that cannot be decoded, with encoding and type; empty if all can.

    Args:
        topics: The topics, of which some may be in CDR.
        consequence: What does not happen to the messages of the others.
    """
    others = sorted((topic for topic in topics if not is_cdr(topic)), key=lambda each: each.name)
    if not others:
        return ""
    named = [f"{each.name} ({each.serialization_format} {each.type})" for each in others]
    rest = f" and {len(named) - _MOST_NAMES} more" if len(named) > _MOST_NAMES else ""
    return printable(
        f"Not in ROS 2's encoding, CDR, and therefore {consequence}: "
        f"{', '.join(named[:_MOST_NAMES])}{rest}."
    )
