"""A sqlite3 file as a file of a bag: topics, definitions, messages in order of time."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING

from turtlewire.bag.compression import ZSTD_MAGIC
from turtlewire.bag.message import channel_of_text
from turtlewire.bag.metadata import BagMetadata, TopicInfo
from turtlewire.bag.sqlite_reader import SqliteFile
from turtlewire.bag.storage import add_messages, class_of_channel
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.bag.record_messages import LoggedBytes, RawMessage
    from turtlewire.bag.storage import Extent, TransformTarget

__all__ = ["SqliteStorage"]


class SqliteStorage:
    """A sqlite3 file; see `turtlewire.bag.storage.StorageFile`."""

    def __init__(self, path: str, name: str = "") -> None:
        self.file = SqliteFile(path, name)
        self.path = self.file.path
        self.problems = self.file.problems
        self._classes: dict[int, type[BagMessage]] = {}

    def close(self) -> None:
        """Release the file."""
        self.file.close()

    def summary(self) -> BagMetadata:
        """Return the file's metadata."""
        start, end = self.file.times()
        embedded = self.file.embedded_metadata()
        counts = self.file.counts()
        topics = [
            replace(topic, message_count=counts.get(number, 0))
            for number, topic in self.file.topics.items()
        ]
        packed = "" if embedded else self._packed()
        return BagMetadata(
            storage="sqlite3",
            topics=topics,
            start_ns=start,
            duration_ns=end - start,
            message_count=sum(topic.message_count for topic in topics),
            compression_format=embedded.compression_format if embedded else packed,
            compression_mode=embedded.compression_mode if embedded else "MESSAGE" * bool(packed),
            custom_data=embedded.custom_data if embedded else {},
            ros_distro=embedded.ros_distro if embedded else "",
        )

    def _packed(self) -> str:
        """The compression of the messages as the first one shows it: no CDR begins like zstd."""
        with suppress(BagError):
            for block in self.file.blocks(self.file.topics, 0, (1 << 64) - 1):
                for _, _, _, data in block:
                    return "zstd" if data.startswith(ZSTD_MAGIC) else ""
        return ""

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of the definition of each type."""
        return self.file.definitions()

    def channels(self) -> list[BagChannel]:
        """Return the topics with the definitions of their types."""
        texts = self.definitions()
        return [
            channel_of_text(topic, texts.get(topic.type, ("", "")))
            for topic in self.file.topics.values()
        ]

    def extents(self) -> dict[str, Extent]:
        """Return counts, sizes and times; sizes of single compressed messages are compressed."""
        extents: dict[str, Extent] = {}
        topics = self.file.topics
        messages = chain.from_iterable(self.file.blocks(topics, 0, (1 << 64) - 1))
        add_messages(extents, messages, lambda number: topics[number].name, self.problems)
        return extents

    def walk_transforms(
        self, _names: Container[str], _start_ns: int, _end_ns: int, _target: TransformTarget
    ) -> bool:
        """Return False, because rows are not chunks."""
        return False

    def counted_messages(self) -> int | None:
        """Return None: sqlite3 keeps no statistics."""
        return None

    def message_class(self, number: int) -> type[BagMessage]:
        """Return the class of the messages of a topic."""
        if not self._classes:
            channels = zip(self.file.topics, self.channels(), strict=True)
            self._classes = {each: class_of_channel(channel) for each, channel in channels}
        return self._classes[number]

    def blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        """Yield messages in blocks; sqlite3 bags have no publish time."""
        topics = [number for number, topic in self.file.topics.items() if wanted(topic)]
        try:
            yield from self.file.blocks(topics, start_ns, end_ns)
        except BagError as error:
            damaged(error)

    def unordered_blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage] | list[LoggedBytes]]:
        """Yield messages in the order of the table."""
        topics = [number for number, topic in self.file.topics.items() if wanted(topic)]
        try:
            yield from self.file.unordered_blocks(topics, start_ns, end_ns)
        except BagError as error:
            damaged(error)
