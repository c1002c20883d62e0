"""Finds the latched messages that a part of a bag needs."""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from turtlewire.bag.frame_renaming import records_of
from turtlewire.bag.message import channel_of
from turtlewire.errors import BagError
from turtlewire.wire.qos import Durability, History

if TYPE_CHECKING:
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.metadata import TopicInfo
    from turtlewire.bag.reader import Bag
    from turtlewire.msg.written_records import WrittenRecords

__all__ = ["is_latched", "latched_before"]

_TF_TYPE = "tf2_msgs/msg/TFMessage"
#: How many messages are repeated if a publisher keeps all of its messages.
_KEEP_ALL = 1000


def is_latched(topic: TopicInfo) -> bool:
    """Return True if late subscribers get the last messages of a topic."""
    return _is_static_tf(topic) or any(
        qos.durability == Durability.TRANSIENT_LOCAL for qos in topic.qos
    )


def _is_static_tf(topic: TopicInfo) -> bool:
    is_named = topic.name == "/tf_static" or topic.name.endswith("/tf_static")
    return topic.type == _TF_TYPE and is_named


def latched_before(
    bags: Sequence[Bag],
    takes: Callable[[TopicInfo], bool],
    time_ns: int,
    damaged: Callable[[BagError], None],
) -> list[BagMessage]:
    """Return the latched messages that a subscriber has at a time.

    These are the last transform of each child frame in one message, and the last messages of other
    topics, as many as their publishers keep.

    Args:
        bags: The bags.
        takes: Returns True for topics that are wanted.
        time_ns: The time; messages are older. It is the log time of the returned messages; their
            publish time stays.
        damaged: Called for each part that cannot be read.
    """
    kept: dict[tuple[int, str], deque[BagMessage]] = {}
    transforms = _Transforms()
    streams = []
    for number, bag in enumerate(bags):
        latched = {t.name: t for t in bag.metadata.topics if is_latched(t) and takes(t)}
        for name, topic in latched.items():
            kept[number, name] = deque(maxlen=_depth(topic))
        if latched and time_ns > bag.start_ns:
            streams.append(_numbered(number, bag, list(latched), time_ns, damaged))
    for number, message in heapq.merge(*streams, key=lambda pair: pair[1].log_time_ns):
        if message.type != _TF_TYPE or not transforms.add(message):
            kept[number, message.topic].append(message)
    found = [message for messages in kept.values() for message in messages]
    found.sort(key=lambda message: message.log_time_ns)
    return [message._replace(log_time_ns=time_ns) for message in (*found, *transforms.messages())]


def _numbered(
    number: int,
    bag: Bag,
    topics: list[str],
    time_ns: int,
    damaged: Callable[[BagError], None],
) -> Iterator[tuple[int, BagMessage]]:
    try:
        for message in bag.messages(topics, end_ns=time_ns - 1):
            yield number, message
    except BagError as error:
        damaged(error)


def _depth(topic: TopicInfo) -> int:
    """Return how many messages all latching publishers of a topic keep together."""
    profiles = [qos for qos in topic.qos if qos.durability == Durability.TRANSIENT_LOCAL]
    if any(qos.history == History.KEEP_ALL for qos in profiles):
        return _KEEP_ALL
    # Fast DDS does not announce the depth.
    return sum(max(1, qos.depth) for qos in profiles) or 1


class _Transforms:
    """The last transform of each child frame, by topic."""

    def __init__(self) -> None:
        self._last: dict[tuple[str, str], tuple[Any, BagMessage]] = {}

    def add(self, message: BagMessage) -> bool:
        """Take the transforms of a message; return False if it cannot be decoded."""
        try:
            record = records_of(channel_of(type(message))).decode(message.data)
        except Exception:  # noqa: BLE001 - whatever malformed bytes and definitions lead to
            return False
        for transform in record.transforms:
            self._last[message.topic, transform.child_frame_id] = transform, message
        return True

    def messages(self) -> Iterator[BagMessage]:
        """Yield one message for each topic and each definition of it."""
        groups: dict[tuple[str, WrittenRecords], tuple[list[Any], BagMessage]] = {}
        for transform, message in self._last.values():
            key = message.topic, records_of(channel_of(type(message)))
            transforms, newest = groups.setdefault(key, ([], message))
            transforms.append(transform)
            if message.log_time_ns > newest.log_time_ns:
                groups[key] = transforms, message
        for (_, records), (transforms, message) in groups.items():
            record = records.decode(message.data)
            record.transforms = transforms
            yield message._replace(data=records.encode(record))
