"""Describes the contents of a bag, topic by topic: counts, times, sizes, definitions."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from turtlewire.bag.definitions import ENCODING, definition_text
from turtlewire.bag.latched import is_latched
from turtlewire.bag.mcap_storage import McapStorage
from turtlewire.bag.reader import open_bag
from turtlewire.bag.storage import add_extent
from turtlewire.errors import InterfaceError

if TYPE_CHECKING:
    from turtlewire.bag.metadata import TopicInfo
    from turtlewire.bag.storage import Extent, StorageFile

__all__ = ["BagOverview", "TopicOverview", "describe_bag"]


@dataclass
class TopicOverview:
    """The messages of one topic.

    Attributes:
        name: The topic.
        type: Its type; may be empty.
        encoding: ``cdr``, or another encoding of its messages.
        count: Number of messages.
        data_bytes: Bytes of the messages before compression.
        rate_hz: Messages a second between its first and last; 0.0 for fewer than two times.
        latched: Whether late subscribers get its last messages.
        has_definition: Whether the bag has the definition of its type.
    """

    name: str
    type: str
    encoding: str
    count: int = 0
    data_bytes: int = 0
    rate_hz: float = 0.0
    latched: bool = False
    has_definition: bool = False


@dataclass
class BagOverview:
    """The contents of a bag.

    Attributes:
        path: The folder or file.
        storage: ``mcap``, ``sqlite3`` or ``ros1``.
        compression: ``zstd`` or ``lz4``; empty for none.
        ros_distro: The distribution that recorded it; empty if the bag does not name it.
        files: Names of its files.
        file_bytes: Size of its files.
        start_ns: Log time of the first message.
        duration_ns: From the first to the last message.
        count: Number of messages.
        topics: The topics, those with the most bytes first.
        problems: What is damaged or missing, one sentence each.
    """

    path: str
    storage: str
    compression: str
    ros_distro: str
    files: list[str]
    file_bytes: int
    start_ns: int
    duration_ns: int
    count: int
    topics: list[TopicOverview] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)


def describe_bag(path: str | os.PathLike[str]) -> BagOverview:
    """Return what a bag holds.

    The message indexes of MCAP files and the rows of sqlite3 files contain the sizes. Other files
    are read to their end.

    Args:
        path: The bag; see `open_bag`.

    Raises:
        FileNotFoundError: ``path`` does not exist.
        BagError: ``path`` is not a bag.
    """
    with open_bag(path) as bag:
        metadata = bag.metadata
        files = bag.readable_files(metadata.paths, [])
        definitions: dict[str, tuple[str, str]] = {}
        for file in files:
            definitions |= file.definitions()
        topics = {topic.name: _described(topic, definitions) for topic in metadata.topics}
        _measure(files, topics)
        folder = bag.path if os.path.isdir(bag.path) else os.path.dirname(bag.path)
        sizes = [_size(os.path.join(folder, name)) for name in metadata.paths]
        return BagOverview(
            bag.path,
            metadata.storage,
            metadata.compression_format or _chunk_compression(files),
            metadata.ros_distro,
            metadata.paths,
            sum(sizes),
            metadata.start_ns,
            metadata.duration_ns,
            metadata.message_count,
            sorted(topics.values(), key=lambda topic: (-topic.data_bytes, topic.name)),
            list(
                dict.fromkeys([*bag.problems, *(text for file in files for text in file.problems)])
            ),
        )


def _described(topic: TopicInfo, definitions: dict[str, tuple[str, str]]) -> TopicOverview:
    encoding, text = definitions.get(topic.type, ("", ""))
    return TopicOverview(
        topic.name,
        topic.type,
        topic.serialization_format or "cdr",
        latched=is_latched(topic),
        has_definition=bool(text) or encoding == "ros1msg" or _has_no_fields(topic.type, encoding),
    )


def _has_no_fields(type_name: str, encoding: str) -> bool:
    """Return True if a type, such as Empty, is defined by no characters."""
    try:
        return encoding == ENCODING and not definition_text(type_name)
    except (InterfaceError, ValueError):  # unknown, or not the name of a type
        return False


def _measure(files: list[StorageFile], topics: dict[str, TopicOverview]) -> None:
    """Fill in counts, sizes and rates."""
    extents: dict[str, Extent] = {}
    for file in files:
        for name, extent in file.extents().items():
            add_extent(extents, name, extent)
    for name in extents.keys() & topics.keys():
        topic, (count, size, first, last) = topics[name], extents[name]
        topic.count, topic.data_bytes = count, size
        if last > first:
            topic.rate_hz = (count - 1) / ((last - first) * 1e-9)


def _chunk_compression(files: list[StorageFile]) -> str:
    for file in files:
        if isinstance(file, McapStorage):
            return file.file.compression
    return ""


def _size(path: str) -> int:
    try:
        return os.path.getsize(path)
    except OSError:  # a missing file is among the problems
        return 0
