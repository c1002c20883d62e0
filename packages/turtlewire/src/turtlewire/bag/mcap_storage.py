"""An MCAP file as a file of a bag: topics, definitions, messages in order of time."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from typing import TYPE_CHECKING

from turtlewire.bag.mcap_reader import McapFile
from turtlewire.bag.mcap_records import Schema
from turtlewire.bag.message import BagChannel, channel_of_text
from turtlewire.bag.metadata import BagMetadata, TopicInfo, full_type_name, parse_metadata
from turtlewire.bag.qos_yaml import load_yaml, profiles_from_yaml
from turtlewire.bag.ros1_storage import Ros1Messages, converted_blocks
from turtlewire.bag.storage import (
    add_extent,
    add_messages,
    class_of_channel,
    extents_of_chunk,
    in_order,
    one_ahead,
)
from turtlewire.errors import BagError
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.bag.mcap_records import ChunkIndex
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.record_messages import RawMessage
    from turtlewire.bag.storage import Extent, TransformTarget

__all__ = ["McapStorage"]


class McapStorage:
    """A file in the MCAP format; see `turtlewire.bag.storage.StorageFile`."""

    def __init__(self, path: str, name: str = "") -> None:
        self.file = McapFile(path, name)
        self.path = self.file.path
        self.problems = self.file.problems
        self._topics: dict[int, TopicInfo] = {}
        self._classes: dict[int, type[BagMessage]] = {}
        self._ros1: dict[int, Ros1Messages | None] = {}

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
        ros1 = self.ros1_messages(channel_id)
        return TopicInfo(
            channel.topic,
            ros1.name if ros1 else schema.name if schema else "",
            ros1.encoding if ros1 else channel.message_encoding,
            profiles_from_yaml(channel.metadata.get("offered_qos_profiles"), self.path),
            channel.metadata.get("topic_type_hash", ""),
            self.file.statistics.channel_counts.get(channel_id, 0),
        )

    def ros1_messages(self, number: int) -> Ros1Messages | None:
        """Return the converter of a channel with messages of ROS 1; None for any other."""
        if number not in self._ros1:
            channel = self.file.channels[number]
            schema = self.file.schemas.get(channel.schema_id)
            self._ros1[number] = None
            if channel.message_encoding == "ros1" and schema and schema.encoding == "ros1msg":
                text = schema.data.decode("utf-8", "replace")
                self._ros1[number] = Ros1Messages(schema.name, text)
        return self._ros1[number]

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
        found = {
            full_type_name(schema.name): (schema.encoding, schema.data.decode("utf-8", "replace"))
            for schema in self.file.schemas.values()
        }
        kinds = [self.ros1_messages(number) for number in self.file.channels]
        return found | {kind.name: kind.definition for kind in kinds if kind and not kind.problem}

    @property
    def converts(self) -> bool:
        """True if the file has messages of ROS 1, which are converted."""
        return any(self.ros1_messages(number) for number in self.file.channels)

    def channels(self) -> list[BagChannel]:
        """Return the channels with the definitions that their messages follow."""
        return [self.channel(number) for number in sorted(self.file.channels)]

    def channel(self, number: int) -> BagChannel:
        """Return a channel with the definition that its messages follow."""
        topic, ros1 = self.topic(number), self.ros1_messages(number)
        if ros1:
            return channel_of_text(topic, ros1.definition)
        record = self.file.channels[number]
        schema = self.file.schemas.get(record.schema_id) or Schema(0, "", "", b"")
        return BagChannel(topic, schema, record)

    def message_class(self, number: int) -> type[BagMessage]:
        """Return the class of a channel's messages, which knows the channel's definition."""
        found = self._classes.get(number)
        if found is None:
            channel, ros1 = self.channel(number), self.ros1_messages(number)
            found = ros1.message_class(channel) if ros1 else class_of_channel(channel)
            self._classes[number] = found
        return found

    def chunks(
        self, wanted: Callable[[TopicInfo], bool], start_ns: int, end_ns: int
    ) -> list[ChunkIndex]:
        """Return the chunks that may hold wanted messages, in order of their first log time."""
        channels = self.wanted_channels(wanted)
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

    def wanted_channels(self, wanted: Callable[[TopicInfo], bool]) -> set[int]:
        """Return the channels of the wanted topics."""
        return {number for number in self.file.channels if wanted(self.topic(number))}

    def blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        """Yield messages in blocks; only chunks whose times overlap are in memory together."""
        blocks = self._blocks(wanted, start_ns, end_ns, damaged)
        converters = {
            number: (self.topic(number).name, ros1)
            for number in self.wanted_channels(wanted)
            if (ros1 := self.ros1_messages(number))
        }
        return converted_blocks(blocks, converters, self.path, damaged) if converters else blocks

    unordered_blocks = blocks

    def _blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        channels = self.wanted_channels(wanted)
        missing = self.expected_count(channels, start_ns, end_ns)
        chunks = self.chunks(wanted, start_ns, end_ns)
        for block in self.blocks_of(chunks, channels, start_ns, end_ns, damaged):
            missing -= len(block)
            yield block
        if missing > 0:
            damaged(self.missing_messages_error(missing))

    def blocks_of(
        self,
        chunks: list[ChunkIndex],
        channels: Container[int],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        """Yield the messages of some chunks in blocks, without conversion from ROS 1.

        Args:
            chunks: In order of their first log time.
            channels: The channels whose messages are wanted.
            start_ns: The first log time.
            end_ns: The last log time.
            damaged: Called for each part that cannot be read.
        """

        def load(chunk: ChunkIndex) -> list[RawMessage]:
            found = self._messages_of(chunk, channels, start_ns, end_ns, damaged)
            self.file.forget(chunk)
            return found

        return in_order(chunks, load)

    def walk_transforms(
        self, names: Container[str], start_ns: int, end_ns: int, target: TransformTarget
    ) -> bool:
        """Pass the records to ``target``, each chunk decompressed while the last is taken."""
        topics = {
            number: topic.name
            for number in self.file.channels
            if (topic := self.topic(number)).name in names
        }
        if any(self.ros1_messages(number) for number in topics):
            return False  # their messages are converted one by one
        chunks = self.chunks(lambda topic: topic.name in names, start_ns, end_ns)
        total, done = sum(chunk.length for chunk in chunks) or 1, 0
        expected = target.messages + self.expected_count(topics, start_ns, end_ns)
        known_problems = len(target.problems)

        def load(chunk: ChunkIndex) -> bytes | memoryview | BagError:
            try:
                return self.file.records(chunk)
            except BagError as error:
                return error

        for chunk, records in one_ahead(chunks, load):
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

    def extents(self) -> dict[str, Extent]:
        """Return counts, sizes and times from the message indexes, else from the messages."""
        found: dict[str, Extent] = {}
        for chunk in self.file.chunks:
            raw = self.file.raw_chunk(chunk)
            if raw is None:
                messages = self.file.messages(chunk)
                add_messages(found, messages, lambda each: self.topic(each).name, self.problems)
                self.file.forget(chunk)
            else:
                for number, extent in extents_of_chunk(raw).items():
                    add_extent(found, self.topic(number).name, extent)
        return found

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
            f"{self.path}: damaged: {counted(count, 'message')} listed in its statistics "
            f"{'is' if count == 1 else 'are'} missing"
        )

    def _messages_of(
        self,
        chunk: ChunkIndex,
        channels: Container[int],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> list[RawMessage]:
        """Return the wanted messages of a chunk; of a damaged one those before the damage."""
        messages: list[RawMessage] = []
        try:
            # extend() keeps what came before an error.
            messages.extend(self.file.messages(chunk, channels))
        except BagError as error:
            damaged(error)
        if chunk.start_ns >= start_ns and chunk.end_ns <= end_ns:
            return messages
        return [message for message in messages if start_ns <= message[0] <= end_ns]
