"""A channel of a bag: a topic with one definition of its type."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from turtlewire.bag.mcap_records import Schema

if TYPE_CHECKING:
    from turtlewire.bag.mcap_records import Channel
    from turtlewire.bag.metadata import TopicInfo

__all__ = ["BagChannel", "channel_of_text"]


@dataclass(frozen=True, eq=False)
class BagChannel:
    """A topic with one definition of its type, as a file of a bag has it.

    A topic whose messages follow two definitions has two channels.

    Attributes:
        topic: The topic.
        schema: The definition of the type; its number is 0 outside of MCAP, and its name is empty
            if there is no definition.
        record: The channel of an MCAP file; None in other storages.
    """

    topic: TopicInfo
    schema: Schema
    record: Channel | None = None


def channel_of_text(topic: TopicInfo, definition: tuple[str, str]) -> BagChannel:
    """Return the channel of a topic with the encoding and text of its definition."""
    encoding, text = definition
    return BagChannel(topic, Schema(0, topic.type, encoding, text.encode()))
