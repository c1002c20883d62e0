"""A bag of ROS 1 as a file of a bag, its messages turned into ROS 2's CDR."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from turtlewire.bag.message import channel_of_text
from turtlewire.bag.metadata import BagMetadata, TopicInfo
from turtlewire.bag.ros1_file import Ros1File
from turtlewire.bag.ros1_messages import Ros1Messages, converted_blocks
from turtlewire.bag.storage import add_messages, in_order
from turtlewire.errors import BagError
from turtlewire.wire.qos import Durability, QoS

if TYPE_CHECKING:
    from turtlewire.bag.mcap_records import ChunkIndex
    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.bag.record_messages import RawMessage
    from turtlewire.bag.storage import Extent

__all__ = ["Ros1Storage"]


class Ros1Storage:
    """A ``.bag`` file; see `turtlewire.bag.storage.StorageFile`.

    Messages are converted by the definitions in the bag to CDR by ROS 2's, or by the bag's if ROS 2
    does not have the type. Messages whose definition cannot be read keep their ROS 1 bytes, and
    their topic's ``serialization_format`` is ``ros1``.

    Raises:
        BagError: The file is not a bag of ROS 1.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self.file = Ros1File(path)
        self.problems = self.file.problems
        self._types: dict[int, Ros1Messages] = {}
        self._classes: dict[int, type[BagMessage]] = {}
        for number in self.file.connections:
            self._type(number)

    def _type(self, number: int) -> Ros1Messages:
        """Return the type of a connection; damaged bags have some that only a chunk defines."""
        found = self._types.get(number)
        if found is None:
            connection = self.file.connections[number]
            found = Ros1Messages(connection.type, connection.definition)
            self._types[number] = found
            problem = f"{self.path}: {connection.topic} is not converted: {found.problem}"
            if found.problem and problem not in self.problems:
                self.problems.append(problem)
        return found

    def close(self) -> None:
        """Release the file."""
        self.file.close()

    def summary(self) -> BagMetadata:
        """Return the file's metadata."""
        chunks = self.file.chunks
        start = min((chunk.start_ns for chunk in chunks), default=0)
        return BagMetadata(
            storage="ros1",
            topics=list(self._topics().values()),
            start_ns=start,
            duration_ns=max((chunk.end_ns for chunk in chunks), default=0) - start,
            message_count=sum(self.file.counts.values()),
        )

    def _topics(self) -> dict[str, TopicInfo]:
        topics: dict[str, TopicInfo] = {}
        for number, connection in self.file.connections.items():
            kind = self._type(number)
            # A publisher that latches keeps its last message.
            latched = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
            qos = [latched] if connection.latching else []
            topic = TopicInfo(connection.topic, kind.name, kind.encoding, qos, "", 0)
            known = topics.setdefault(connection.topic, topic)
            known.message_count += self.file.counts.get(number, 0)
        return topics

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of the definitions that the converted messages follow."""
        return {kind.name: kind.definition for kind in self._types.values() if not kind.problem}

    def channels(self) -> list[BagChannel]:
        """Return the topics with the definitions that their messages follow."""
        return list(self._channels().values())

    def _channels(self) -> dict[int, BagChannel]:
        topics = self._topics()
        return {
            number: channel_of_text(topics[connection.topic], self._type(number).definition)
            for number, connection in self.file.connections.items()
        }

    def extents(self) -> dict[str, Extent]:
        """Return counts, sizes and times; the sizes count the bytes of ROS 1."""
        extents: dict[str, Extent] = {}
        connections = self.file.connections
        for chunk in self.file.chunks:
            messages = self.file.messages(chunk, connections)
            add_messages(extents, messages, lambda number: connections[number].topic, self.problems)
            self.file.forget(chunk)
        return extents

    def walk_transforms(
        self, _names: object, _start_ns: int, _end_ns: int, _target: object
    ) -> bool:
        """Return False: ROS 1's messages are converted one by one."""
        return False

    def counted_messages(self) -> int | None:
        """Return None: a ROS 1 bag keeps no statistics."""
        return None

    def message_class(self, number: int) -> type[BagMessage]:
        """Return the class of the messages of a connection."""
        found = self._classes.get(number)
        if found is None:
            channel = self._channels()[number]
            found = self._classes[number] = self._type(number).message_class(channel)
        return found

    def blocks(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        """Yield messages in blocks; bags of ROS 1 have no publish time.

        A message that does not follow its definition is left out.
        """
        topics = self._topics()
        connections = {
            number for number, each in self.file.connections.items() if wanted(topics[each.topic])
        }
        blocks = self._blocks(connections, start_ns, end_ns, damaged)
        converters = {
            number: (self.file.connections[number].topic, self._type(number))
            for number in connections
        }
        return converted_blocks(blocks, converters, self.path, damaged)

    unordered_blocks = blocks

    def _blocks(
        self,
        connections: set[int],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[list[RawMessage]]:
        """Yield the messages of connections in order of time."""
        chunks = [
            chunk
            for chunk in self.file.chunks
            if chunk.end_ns >= start_ns
            and chunk.start_ns <= end_ns
            and (chunk.channels is None or chunk.channels & connections)
        ]
        chunks.sort(key=lambda chunk: chunk.start_ns)

        def load(chunk: ChunkIndex) -> list[RawMessage]:
            found: list[RawMessage] = []
            try:
                # extend() keeps what came before an error.
                found.extend(self.file.messages(chunk, connections))
            except BagError as error:
                damaged(error)
            self.file.forget(chunk)
            return [message for message in found if start_ns <= message[0] <= end_ns]

        return in_order(chunks, load)
