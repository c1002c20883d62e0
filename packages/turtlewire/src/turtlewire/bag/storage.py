"""The interface of a file of a bag, common to all storages, and the order of its messages."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Container, Iterable, Iterator
from itertools import islice
from operator import itemgetter
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeVar

from turtlewire.bag.message import UndecodableType, channel_of, message_class
from turtlewire.bag.metadata import is_decodable
from turtlewire.bag.written_types import written_type
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.mcap_records import ChunkIndex, RawChunk
    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.bag.metadata import BagMetadata, TopicInfo
    from turtlewire.bag.record_messages import LoggedBytes, RawMessage

__all__ = [
    "Extent",
    "StorageFile",
    "TransformTarget",
    "add_extent",
    "add_messages",
    "class_of_channel",
    "extents_of_chunk",
    "in_order",
    "messages_of_blocks",
    "one_ahead",
]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")

#: Opcode, length and fields of a message before its bytes.
_MESSAGE_HEAD = 31
#: Opcode, length, channel and size of a MessageIndex record before its entries.
_INDEX_HEAD = 15


class Extent(NamedTuple):
    """The messages of a topic.

    Attributes:
        messages: Number of messages.
        data_bytes: Their bytes before compression.
        first_ns: Log time of the first message.
        last_ns: Log time of the last message.
    """

    messages: int
    data_bytes: int
    first_ns: int
    last_ns: int


def add_extent(extents: dict[str, Extent], topic: str, extent: Extent) -> None:
    """Add messages to the extent of a topic."""
    known = extents.get(topic)
    if known is not None:
        extent = Extent(
            known.messages + extent.messages,
            known.data_bytes + extent.data_bytes,
            min(known.first_ns, extent.first_ns),
            max(known.last_ns, extent.last_ns),
        )
    extents[topic] = extent


def add_messages(
    extents: dict[str, Extent],
    messages: Iterable[RawMessage],
    name: Callable[[int], str],
    problems: list[str],
) -> None:
    """Add messages one by one to the extents of their topics.

    Args:
        extents: The extents by topic.
        messages: They may end with a `BagError`, which is added to the ``problems``.
        name: Returns the topic of a channel.
        problems: What is damaged.
    """
    try:
        for log_time, number, _, data in messages:
            add_extent(extents, name(number), Extent(1, len(data), log_time, log_time))
    except BagError as error:
        problems.append(str(error))


def extents_of_chunk(chunk: RawChunk) -> dict[int, Extent]:
    """Return the extent of each channel of an MCAP chunk, which is not decompressed.

    A message ends where the next record begins; definitions between messages count with them.
    """
    import numpy as np

    entries = {
        channel: np.frombuffer(
            chunk.indexes, "<u8", 2 * chunk.counts[channel], position + _INDEX_HEAD
        ).reshape(-1, 2)
        for channel, position in chunk.index_offsets.items()
    }
    if not entries:
        return {}
    begins = np.concatenate([each[:, 1] for each in entries.values()])
    order = np.argsort(begins, kind="stable")
    ends = np.append(begins[order][1:], np.uint64(chunk.plain_bytes))
    sizes = np.empty(len(begins), np.int64)
    sizes[order] = (ends - begins[order]).astype(np.int64) - _MESSAGE_HEAD
    extents, at = {}, 0
    for channel, rows in entries.items():
        own = sizes[at : at + len(rows)]
        at += len(rows)
        times = rows[:, 0]
        extents[channel] = Extent(
            len(rows), int(own.clip(0).sum()), int(times.min()), int(times.max())
        )
    return extents


_FOREVER = 1 << 64

_log_time = itemgetter(0)


class TransformTarget(Protocol):
    """The reader of a bag's transforms, as far as `StorageFile.walk_transforms` needs it.

    Attributes:
        messages: How many messages it has taken.
        problems: What is damaged, one sentence each.
    """

    @property
    def messages(self) -> int: ...
    @property
    def problems(self) -> list[str]: ...

    def take(self, records: bytes | memoryview, topics: dict[int, str]) -> int:
        """Store the transforms of a chunk's records.

        Args:
            records: The records of an MCAP chunk.
            topics: The topics to read, by channel.

        Returns:
            Where the records are damaged; -1 if they are not.
        """
        ...

    def complain(self, problem: str) -> None:
        """Add to `problems` what is not among them yet."""

    def tell(self, share: float) -> None:
        """Report which share of the file was read."""


class StorageFile(Protocol):
    """The interface of a bag's file for the rest of this package.

    Attributes:
        path: Where it is.
        problems: What is damaged, one sentence each.
    """

    path: str
    problems: list[str]

    def summary(self) -> BagMetadata:
        """Topics, types and times, read from the file itself."""

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of the definition of each type, as far as the file has them."""

    def channels(self) -> list[BagChannel]:
        """Return the topics with the definitions that their messages follow."""

    def message_class(self, number: int) -> type[BagMessage]:
        """Return the class of the messages of a channel, which decodes them."""

    def blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        """Return the messages in order of log time, some at a time; bounds are included.

        Messages of ROS 1 are converted to CDR.

        Args:
            wanted: Decides of a topic whether its messages are read.
            start_ns: The first log time.
            end_ns: The last log time.
            damaged: Called for each part that cannot be read.
        """

    def unordered_blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage] | list[LoggedBytes]]:
        """Return the messages in any order, some at a time, with the arguments of `blocks`.

        The log time is the first item of a message, its bytes are the last.
        """

    def extents(self) -> dict[str, Extent]:
        """Return counts, sizes and times of the readable messages of each topic.

        What is damaged is added to ``problems``.
        """

    def walk_transforms(
        self, names: Container[str], start_ns: int, end_ns: int, target: TransformTarget
    ) -> bool:
        """Pass the records of the topics ``names`` to ``target``, chunk by chunk.

        Returns:
            False if the file has no chunks: nothing was read, and `blocks` has the transforms.
        """
        ...

    def counted_messages(self) -> int | None:
        """Return how many messages the file's statistics count; None if it has no statistics."""

    def close(self) -> None:
        """Release the file."""


def messages_of_blocks(
    file: StorageFile, blocks: Iterable[list[RawMessage]]
) -> Iterator[BagMessage]:
    """Yield the messages of a file's blocks as objects of the classes of their channels."""
    kinds: dict[int, tuple[type[BagMessage], str, str]] = {}
    make = tuple.__new__  # half the time of the constructor, which reads keywords
    for block in blocks:
        for number in {message[1] for message in block} - kinds.keys():
            kind = file.message_class(number)
            topic = channel_of(kind).topic
            kinds[number] = kind, topic.name, topic.type
        for log_time, number, publish_time, data in block:
            kind, name, type_name = kinds[number]
            yield make(kind, (name, type_name, log_time, publish_time, data))


def class_of_channel(channel: BagChannel) -> type[BagMessage]:
    """Return the class of a channel's messages, which decodes them by the definition in the bag."""
    topic, schema = channel.topic, channel.schema
    if not is_decodable(topic):
        undecodable = UndecodableType(topic.name, topic.type, topic.serialization_format)
        return message_class(undecodable, channel)
    text = schema.data.decode("utf-8", "replace")
    return message_class(written_type(topic.type, schema.encoding, text), channel)


def one_ahead(
    items: Iterable[_Item], prepare: Callable[[_Item], _Result]
) -> Iterator[tuple[_Item, _Result]]:
    """Yield each item with the result of ``prepare``, which another thread calls one item ahead."""
    from concurrent.futures import ThreadPoolExecutor  # it takes 10 ms to import

    with ThreadPoolExecutor(1, "bag") as thread:
        following = iter(items)
        ahead = [(item, thread.submit(prepare, item)) for item in islice(following, 1)]
        while ahead:
            item, current = ahead.pop()
            ahead += [(item, thread.submit(prepare, item)) for item in islice(following, 1)]
            yield item, current.result()


def in_order(
    chunks: Iterable[ChunkIndex], load: Callable[[ChunkIndex], list[RawMessage]]
) -> Iterator[list[RawMessage]]:
    """Yield messages in order of time, at equal times in the order of the file.

    Only chunks whose times overlap are in memory together.

    Args:
        chunks: In order of their first log time.
        load: Returns the messages of a chunk.
    """
    waiting: dict[int, list[RawMessage]] = {}
    for chunk in chunks:
        yield _taken_before(chunk.start_ns, waiting)
        found = load(chunk)
        found.sort(key=_log_time)
        waiting[chunk.offset] = found
    yield _taken_before(_FOREVER, waiting)


def _taken_before(time_ns: int, waiting: dict[int, list[RawMessage]]) -> list[RawMessage]:
    """Remove messages of earlier log times from the waiting ones, and return them in order.

    Args:
        time_ns: The log time that is not taken any more.
        waiting: The messages of each chunk, in order of time, by the chunk's offset.
    """
    taken: list[RawMessage] = []
    for offset in sorted(waiting):
        messages = waiting[offset]
        count = bisect_left(messages, time_ns, key=_log_time)
        if count < len(messages):
            taken += messages[:count]
            del messages[:count]
        else:
            taken = taken + messages if taken else messages
            del waiting[offset]
    taken.sort(key=_log_time)
    return taken
