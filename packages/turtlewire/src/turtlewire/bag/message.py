"""One message of a bag, and its channel: a topic with one definition of its type."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, Protocol

from turtlewire.bag.mcap_records import Schema
from turtlewire.call_errors import hint_at
from turtlewire.errors import InterfaceError

if TYPE_CHECKING:
    from turtlewire.bag.mcap_records import Channel
    from turtlewire.bag.metadata import TopicInfo

__all__ = [
    "BagChannel",
    "BagMessage",
    "MessageType",
    "UndecodableType",
    "channel_of",
    "channel_of_text",
    "message_class",
]


@hint_at(
    {
        "message msg ros_msg deserialize decoded": "decode()",
        "timestamp stamp time t log_time": "log_time_ns",
        "publish_time": "publish_time_ns",
        "channel connection": "topic",
        "msgtype schema": "type",
        "rawdata raw": "data",
    }
)
class BagMessage(NamedTuple):
    """One recorded message.

    Attributes:
        topic: Name of its topic.
        type: ``"tf2_msgs/msg/TFMessage"``.
        log_time_ns: When the recorder received it, nanoseconds since 1970.
        publish_time_ns: When it was sent; equal to ``log_time_ns`` where the bag does not say. A
            latched message may have been sent long before the bag began.
        data: Its CDR bytes; messages of ROS 1 are converted to CDR.
    """

    topic: str
    type: str
    log_time_ns: int
    publish_time_ns: int
    data: bytes

    def decode(self) -> Any:
        """Return the message object.

        Its class is not known to type checkers; annotate it: ``odom: Odometry = message.decode()``.
        It is of the class that `turtlewire.msg.get_message` returns. If the bag defines the type
        otherwise, its definition decodes the bytes; `turtlewire.msg.missing_fields` returns the
        fields that it does not have.

        Raises:
            CdrError: The bytes are malformed.
            InterfaceError: The type is not known and the bag does not define it.
        """
        return self._written_type().decode(self.data)

    def upgraded_data(self) -> bytes:
        """Return the CDR bytes by the definition of `turtlewire.msg.get_message`.

        They differ from ``data`` if the bag defines the type otherwise, and are the same if the
        message cannot be decoded.
        """
        return self._written_type().upgrade(self.data)

    def __reduce__(self) -> tuple[Any, ...]:
        return BagMessage, tuple(self)

    def _written_type(self) -> MessageType:
        written: MessageType | None = getattr(type(self), "_WRITTEN", None)
        if written is not None:
            return written
        from turtlewire.bag.written_types import written_type

        return written_type(self.type, "", "")


class MessageType(Protocol):
    """The type of a topic's messages, as the bag defines it."""

    def decode(self, data: bytes) -> Any:
        """Return the object of a message; see `BagMessage.decode`."""

    def upgrade(self, data: bytes) -> bytes:
        """Return other bytes of a message; see `BagMessage.upgraded_data`."""


def message_class(written: MessageType, channel: BagChannel) -> type[BagMessage]:
    """Return the class for the messages of a channel.

    They know by which definition they decode, and `channel_of` returns their channel.
    """
    content = {"__slots__": (), "_WRITTEN": written, "_CHANNEL": channel}
    return type("BagMessage", (BagMessage,), content)


def channel_of(kind: type[BagMessage]) -> BagChannel:
    """Return the channel of the messages that a bag returned in a class."""
    channel: BagChannel = kind._CHANNEL  # type: ignore[attr-defined]
    return channel


class UndecodableType:
    """The type of messages that have another encoding, such as JSON.

    Args:
        topic: The topic.
        type_name: Its type as the bag names it; may be empty.
        encoding: ``json``, ``protobuf``.
        reason: Why not; empty if the encoding explains it.
    """

    def __init__(self, topic: str, type_name: str, encoding: str, reason: str = "") -> None:
        self._error = (topic, type_name, encoding, reason)

    def decode(self, _data: bytes) -> NoReturn:
        """Raise `InterfaceError` that names the encoding."""
        raise self._failure()

    def upgrade(self, data: bytes) -> bytes:
        """Return the bytes as they are."""
        return data

    def _failure(self) -> InterfaceError:
        topic, type_name, encoding, reason = self._error
        if reason:
            return InterfaceError(f"{topic}: {reason}")
        if not type_name:
            return InterfaceError(f"{topic}: the bag does not name the type of its messages")
        error = InterfaceError(
            f"{topic}: '{type_name}' is not a type of ROS 2 in CDR: its messages are in {encoding}"
        )
        error.with_hint("`data` has the bytes, which a library for that encoding decodes.")
        return error


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
