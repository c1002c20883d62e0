"""One file of a bag, whichever storage it uses."""

from __future__ import annotations

from bisect import bisect_left
from contextlib import suppress
from typing import TYPE_CHECKING, Protocol

from turtlewire.bag.compression import ZSTD_MAGIC
from turtlewire.bag.mcap_reader import McapFile
from turtlewire.bag.mcap_records import MAGIC
from turtlewire.bag.message import BagMessage
from turtlewire.bag.metadata import BagMetadata, TopicInfo, parse_metadata
from turtlewire.bag.qos_yaml import load_yaml, profiles_from_yaml
from turtlewire.bag.ros1_reader import MAGIC as ROS1_MAGIC
from turtlewire.bag.ros1_reader import Ros1Storage
from turtlewire.bag.sqlite_reader import SqliteFile
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterator

    from turtlewire.bag.mcap_records import ChunkIndex

__all__ = ["McapStorage", "SqliteStorage", "StorageFile", "TransformTarget", "open_storage"]

#: Log time, channel, publish time and bytes of a message in an MCAP file.
_Raw = tuple[int, int, int, bytes]

_SQLITE_MAGIC = b"SQLite format 3\0"


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

    def messages(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[BagMessage]:
        """Return the messages in order of log time; bounds are included.

        Args:
            wanted: Decides of a topic whether its messages are read.
            start_ns: The first log time.
            end_ns: The last log time.
            damaged: Called for each part that cannot be read.
        """

    def walk_transforms(
        self, names: Container[str], start_ns: int, end_ns: int, target: TransformTarget
    ) -> bool:
        """Pass the records of the topics ``names`` to ``target``, chunk by chunk.

        Returns:
            False if the file has no chunks: nothing was read, and `messages` has the transforms.
        """
        ...

    def counted_messages(self) -> int | None:
        """Return how many messages the file's statistics count; None if it has no statistics."""

    def close(self) -> None:
        """Release the file."""


def open_storage(path: str) -> StorageFile:
    """Open a ``.mcap`` or ``.db3`` file; its first bytes decide which of both it is.

    Raises:
        FileNotFoundError: The file does not exist.
        BagError: The file has none of these formats.
    """
    with open(path, "rb") as file:
        start = file.read(len(_SQLITE_MAGIC))
    if start.startswith(MAGIC):
        return McapStorage(path)
    if start == _SQLITE_MAGIC:
        return SqliteStorage(path)
    if start.startswith(ROS1_MAGIC):
        return Ros1Storage(path)
    raise BagError(f"{path} is neither an MCAP nor a sqlite3 file")


class McapStorage:
    """A file in the MCAP format; see `StorageFile`."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.file = McapFile(path)
        self.problems = self.file.problems
        self._topics: dict[int, TopicInfo] = {}

    def close(self) -> None:
        """Release the file."""
        self.file.close()

    def topic(self, channel_id: int) -> TopicInfo:
        """Return the topic of a channel.

        Raises:
            BagError: The file does not say which topic it is.
        """
        topic = self._topics.get(channel_id)
        if topic is None:
            topic = self._topics[channel_id] = self._read_topic(channel_id)
        return topic

    def _read_topic(self, channel_id: int) -> TopicInfo:
        channel = self.file.channels.get(channel_id)
        if channel is None:
            raise BagError(f"{self.path}: a message of the unknown channel {channel_id}")
        schema = self.file.schemas.get(channel.schema_id)
        return TopicInfo(
            channel.topic,
            schema.name if schema else "",
            channel.message_encoding,
            profiles_from_yaml(channel.metadata.get("offered_qos_profiles"), self.path),
            channel.metadata.get("topic_type_hash", ""),
            self.file.statistics.channel_counts.get(channel_id, 0),
        )

    def summary(self) -> BagMetadata:
        """Return the file's topics and times; channels of one topic count together."""
        topics: dict[str, TopicInfo] = {}
        for channel_id in sorted(self.file.channels):
            topic = self._read_topic(channel_id)
            known = topics.setdefault(topic.name, topic)
            if known is not topic:
                known.message_count += topic.message_count
        statistics = self.file.statistics
        embedded = self._embedded()
        return BagMetadata(
            storage="mcap",
            topics=list(topics.values()),
            start_ns=statistics.start_ns,
            duration_ns=statistics.end_ns - statistics.start_ns,
            message_count=statistics.message_count,
            custom_data=embedded.custom_data if embedded else {},
            ros_distro=embedded.ros_distro if embedded else self._old_distro(),
        )

    def _embedded(self) -> BagMetadata | None:
        text = self.file.metadata.get("rosbag2", {}).get("serialized_metadata")
        try:
            return parse_metadata(load_yaml(text, self.path), self.path) if text else None
        except BagError as error:
            self.problems.append(f"the metadata in the file cannot be read: {error}")
            return None

    def _old_distro(self) -> str:
        return self.file.metadata.get("rosbag2", {}).get("ROS_DISTRO", "")

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of the definition of each type."""
        return {
            schema.name: (schema.encoding, schema.data.decode("utf-8", "replace"))
            for schema in self.file.schemas.values()
        }

    def chunks(
        self, wanted: Callable[[TopicInfo], bool], start_ns: int, end_ns: int
    ) -> list[ChunkIndex]:
        """Return the chunks that may hold wanted messages, in order of their first log time."""
        channels = self._wanted_channels(wanted)
        return sorted(
            (
                chunk
                for chunk in self.file.chunks
                if chunk.end_ns >= start_ns
                and chunk.start_ns <= end_ns
                and (chunk.channels is None or chunk.channels & channels)
            ),
            key=lambda chunk: chunk.start_ns,
        )

    def _wanted_channels(self, wanted: Callable[[TopicInfo], bool]) -> set[int]:
        return {number for number in self.file.channels if wanted(self.topic(number))}

    def messages(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[BagMessage]:
        """Yield messages; only chunks whose times overlap are in memory together."""
        channels = self._wanted_channels(wanted)
        waiting: list[_Raw] = []
        missing = self.expected_count(channels, start_ns, end_ns)
        for chunk in self.chunks(wanted, start_ns, end_ns):
            if waiting and waiting[-1][0] < chunk.start_ns:
                yield from self._finished(waiting)
                waiting = []
            elif waiting and waiting[0][0] < chunk.start_ns:
                count = bisect_left(waiting, chunk.start_ns, key=_log_time)
                yield from self._finished(waiting[:count])
                del waiting[:count]
            found = self._messages_of(chunk, channels, start_ns, end_ns, damaged)
            missing -= len(found)
            waiting += found
            waiting.sort(key=_log_time)
        yield from self._finished(waiting)
        if missing > 0:
            damaged(self.missing_messages_error(missing))

    def walk_transforms(
        self, names: Container[str], start_ns: int, end_ns: int, target: TransformTarget
    ) -> bool:
        """Pass the records to ``target``, each chunk decompressed while the last is taken."""
        from turtlewire.bag.chunk_walk import decompressed  # its threads take 10 ms to import

        topics = {
            number: topic.name
            for number in self.file.channels
            if (topic := self.topic(number)).name in names
        }
        chunks = self.chunks(lambda topic: topic.name in names, start_ns, end_ns)
        total, done = sum(chunk.length for chunk in chunks) or 1, 0
        expected = target.messages + self.expected_count(topics, start_ns, end_ns)
        known_problems = len(target.problems)
        for chunk, records in decompressed(self.file, chunks):
            if isinstance(records, BagError):
                target.complain(str(records))
            else:
                damaged_at = target.take(records, topics)
                if damaged_at >= 0:
                    target.complain(str(self.file.cut(chunk, damaged_at)))
            self.file.forget(chunk)
            done += chunk.length
            target.tell(done / total)
        missing = expected - target.messages
        if missing > 0 and len(target.problems) == known_problems:
            target.complain(str(self.missing_messages_error(missing)))
        return True

    def counted_messages(self) -> int | None:
        """Return the message count of the file's statistics."""
        return self.file.statistics.message_count

    def expected_count(self, channels: Container[int], start_ns: int, end_ns: int) -> int:
        """Return the channels' message count by the statistics; 0 for a part of the file's time."""
        statistics = self.file.statistics
        if start_ns > statistics.start_ns or end_ns < statistics.end_ns:
            return 0
        return sum(n for number, n in statistics.channel_counts.items() if number in channels)

    def missing_messages_error(self, count: int) -> BagError:
        """Return the error of a file that holds fewer messages than its statistics say."""
        return BagError(
            f"{self.path}: damaged: {count:,} messages listed in its statistics are missing"
        )

    def _messages_of(
        self,
        chunk: ChunkIndex,
        channels: Container[int],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> list[_Raw]:
        """Return the wanted messages of a chunk; of a damaged one those before the damage."""
        messages: list[_Raw] = []
        try:
            # extend() keeps what came before an error.
            messages.extend(self.file.messages(chunk, channels))
        except BagError as error:
            damaged(error)
        if chunk.start_ns >= start_ns and chunk.end_ns <= end_ns:
            return messages
        return [message for message in messages if start_ns <= message[0] <= end_ns]

    def _finished(self, messages: list[_Raw]) -> Iterator[BagMessage]:
        topics = {number: self.topic(number) for number in {message[1] for message in messages}}
        names = {number: (topic.name, topic.type) for number, topic in topics.items()}
        make = tuple.__new__  # half the time of the constructor, which reads keywords
        for log_time, channel, publish_time, data in messages:
            name, type_name = names[channel]
            yield make(BagMessage, (name, type_name, log_time, publish_time, data))


def _log_time(message: _Raw) -> int:
    return message[0]


class SqliteStorage:
    """A sqlite3 file; see `StorageFile`."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.file = SqliteFile(path)
        self.problems = self.file.problems

    def close(self) -> None:
        """Release the file."""
        self.file.close()

    def summary(self) -> BagMetadata:
        """Return the file's metadata."""
        start, end = self.file.times()
        embedded = self.file.embedded_metadata()
        topics = list(self.file.topics.values())
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
            for _, _, data in self.file.messages(self.file.topics, 0, (1 << 64) - 1):
                return "zstd" if data.startswith(ZSTD_MAGIC) else ""
        return ""

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of the definition of each type."""
        return self.file.definitions()

    def walk_transforms(
        self, _names: Container[str], _start_ns: int, _end_ns: int, _target: TransformTarget
    ) -> bool:
        """Return False, because rows are not chunks."""
        return False

    def counted_messages(self) -> int | None:
        """Return None: sqlite3 keeps no statistics."""
        return None

    def messages(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[BagMessage]:
        """Yield messages; sqlite3 bags have no publish time."""
        topics = {number: topic for number, topic in self.file.topics.items() if wanted(topic)}
        try:
            for log_time, number, data in self.file.messages(topics, start_ns, end_ns):
                topic = topics[number]
                yield BagMessage(topic.name, topic.type, log_time, log_time, data)
        except BagError as error:
            damaged(error)
