"""A bag of ROS 1 as a file of a bag, and the conversion of its messages to ROS 2's CDR."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from turtlewire.bag.definitions import ENCODING, definition_text, parse_definition
from turtlewire.bag.frame_renaming import frame_fields, rename_frames
from turtlewire.bag.message import UndecodableType, channel_of_text, message_class
from turtlewire.bag.metadata import BagMetadata, TopicInfo, full_type_name
from turtlewire.bag.ros1_file import Ros1File
from turtlewire.bag.ros1_steps import conversion_steps
from turtlewire.bag.storage import add_messages, in_order
from turtlewire.bag.written_types import ros2_definition, written_type
from turtlewire.errors import BagError, CdrError, InterfaceError
from turtlewire.msg.cdr import serialize
from turtlewire.msg.registry import load_message
from turtlewire.platforms import asked_core
from turtlewire.wire.qos import Durability, QoS
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire._native import Ros1ToCdr
    from turtlewire.bag.mcap_records import ChunkIndex
    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.bag.record_messages import RawMessage
    from turtlewire.bag.storage import Extent
    from turtlewire.msg.evolution import Evolution
    from turtlewire.msg.message import Message

__all__ = ["Ros1Messages", "Ros1Storage", "converted_blocks"]

#: The type of /tf in old bags, which has the same fields.
_RENAMED = dict.fromkeys(("tf/tfMessage", "tf/msg/tfMessage"), "tf2_msgs/msg/TFMessage")

#: A text that begins with a slash, if it is shorter than 256 bytes: the end of its length, and '/'.
_SLASH = b"\0\0\0/"


class Ros1Storage:
    """A ``.bag`` file; see `turtlewire.bag.storage.StorageFile`.

    Messages are converted by the definitions in the bag to CDR by ROS 2's, or by the bag's if ROS 2
    does not have the type. Messages whose definition cannot be read keep their ROS 1 bytes, and
    their topic's ``serialization_format`` is ``ros1``.

    Raises:
        BagError: The file is not a bag of ROS 1.
    """

    def __init__(self, path: str, name: str = "") -> None:
        self.file = Ros1File(path, name)
        self.path = self.file.path
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


class Ros1Messages:
    """The messages of one type in a bag of ROS 1.

    Args:
        name: ``"sensor_msgs/msg/Range"`` or, as ROS 1 has it, ``"sensor_msgs/Range"``.
        text: The definition with its dependencies, as ROS 1 wrote it.

    Attributes:
        name: The name of the type.
        problem: Why the messages cannot be converted; empty if they can.
        encoding: ``cdr``, or ``ros1`` if they cannot be converted.
        conversion: Their native conversion, if the compiled core has one for them.
    """

    def __init__(self, name: str, text: str) -> None:
        self.name = _RENAMED.get(name, full_type_name(name))
        self.problem = ""
        self._text = text
        self._evolution: Evolution | None = None
        self.conversion: Ros1ToCdr | None = None
        try:
            written = written_type(self.name, "ros1msg", text, is_ros1=True)
            self._evolution = written.evolution
            self.conversion = _conversion(self.name, text)
        except (InterfaceError, ValueError) as error:
            self.problem = str(error)
        self.encoding = "ros1" if self.problem else "cdr"

    def cdr(self, data: bytes) -> bytes:
        """Return a message as CDR by our definition, without the slashes before frame names.

        tf2 refuses such names since ROS 2.

        Raises:
            CdrError: The bytes do not follow the definition.
        """
        converted = self.conversion.convert(data) if self.conversion else None
        return self._cdr_of_message(data) if converted is None else converted

    def _cdr_of_message(self, data: bytes) -> bytes:
        assert self._evolution is not None
        message = self._evolution.decode(data)
        if _SLASH in data:
            rename_frames(message, _our_frame_fields(self.name), _without_slashes)
        return serialize(message)

    @property
    def definition(self) -> tuple[str, str]:
        """Encoding and text of the definition of `cdr`; of ROS 1's if it cannot be used."""
        return ("ros1msg", self._text) if self.problem else (ENCODING, definition_text(self.name))

    def message_class(self, channel: BagChannel) -> type[BagMessage]:
        """Return the class for the messages of a channel."""
        if not self.problem:
            return message_class(self, channel)
        topic = channel.topic.name
        undecodable = UndecodableType(topic, self.name, self.encoding, self.problem)
        return message_class(undecodable, channel)

    def decode(self, data: bytes) -> Message:
        """Decode what `cdr` returned; `missing_fields` names what ROS 1 does not have."""
        assert self._evolution is not None
        return self._evolution.decode_ours(data)

    def upgrade(self, data: bytes) -> bytes:
        """Return what `cdr` returned."""
        return data


def converted_blocks(
    blocks: Iterable[list[RawMessage]],
    converters: Mapping[int, tuple[str, Ros1Messages]],
    path: str,
    damaged: Callable[[BagError], None],
) -> Iterator[list[RawMessage]]:
    """Yield the messages of blocks in CDR where that is possible.

    A message that does not follow its definition is left out.

    Args:
        blocks: The messages.
        converters: Topic and converter of the channels with messages of ROS 1.
        path: The file, for errors.
        damaged: Called at the end for each topic of which messages are left out.
    """
    kinds = {number: kind for number, (_, kind) in converters.items() if not kind.problem}
    conversions = {number: kind.conversion for number, kind in kinds.items()}
    left_out: dict[str, tuple[int, CdrError]] = {}
    for block in blocks:
        converted: list[RawMessage] = []
        position = _convert_messages(block, 0, conversions, converted)
        while position < len(block):
            log_time, number, publish_time, data = block[position]
            try:
                cdr = kinds[number].cdr(data)
                converted.append((log_time, number, publish_time, cdr))
            except CdrError as error:
                topic = converters[number][0]
                count, first = left_out.get(topic, (0, error))
                left_out[topic] = count + 1, first
            position = _convert_messages(block, position + 1, conversions, converted)
        yield converted
    for topic, (count, first) in left_out.items():
        damaged(BagError(f"{path}: left out {counted(count, 'message')} of {topic}: {first}"))


def _convert_messages(
    messages: list[RawMessage],
    position: int,
    conversions: dict[int, Ros1ToCdr | None],
    into: list[RawMessage],
) -> int:
    """Append messages as long as they need no conversion by Python; return where the next is."""
    if any(conversions.values()):
        from turtlewire._native import convert_messages

        return convert_messages(messages, position, conversions, into)
    while position < len(messages) and messages[position][1] not in conversions:
        into.append(messages[position])
        position += 1
    return position


def _conversion(name: str, text: str) -> Ros1ToCdr | None:
    """Return the native conversion of a type's messages, if the core has one for it."""
    if asked_core() == "python":
        return None
    try:
        from turtlewire._native import Ros1ToCdr
    except ImportError:
        return None
    steps = conversion_steps(name, parse_definition(name, ros2_definition(text)))
    return Ros1ToCdr(steps) if steps else None


@cache
def _our_frame_fields(full_name: str) -> dict[str, Any]:
    return frame_fields(full_name, load_message)


def _without_slashes(frame: str) -> str:
    return frame.lstrip("/")
