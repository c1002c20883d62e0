"""Rename frames in the bytes of messages, by the definitions in the bag."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from turtlewire.bag.definitions import ENCODING, in_ros2msg, parse_definition
from turtlewire.bag.message import channel_of
from turtlewire.bag.metadata import is_decodable
from turtlewire.errors import BagError, CdrError, InterfaceError
from turtlewire.msg.types import AbstractNestedType, AbstractString, NamespacedType
from turtlewire.msg.written_records import WrittenRecords

if TYPE_CHECKING:
    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.msg.definition import MessageDefinition

__all__ = ["FrameRenaming", "frame_fields", "records_of", "rename_frames"]


class FrameRenaming:
    """Replaces names of frames in messages; messages without them stay as they are.

    Args:
        names: New names by old name. They are replaced together, so that two may be swapped.

    Attributes:
        found: The old names that were in messages.
        problems: Why messages that may name such a frame were not changed, by topic.

    Raises:
        BagError: A name is empty, or a new one begins with a slash.
    """

    def __init__(self, names: Mapping[str, str]) -> None:
        for old, new in names.items():
            if not old or not new:
                raise BagError(f"the name of a frame must not be empty: {old}:={new}")
            if new.startswith("/"):
                raise BagError(f"the frame name '{new}' begins with a slash, which tf2 refuses")
        self._names = dict(names)
        # A text ends with a zero in CDR.
        self._bytes = [name.encode() + b"\0" for name in names]
        self._kinds: dict[type[BagMessage], tuple[WrittenRecords, dict[str, Any]] | None] = {}
        self.found: set[str] = set()
        self.problems: dict[str, str] = {}

    def apply(self, message: BagMessage) -> bytes:
        """Return the bytes of a message with the new names."""
        data = message.data
        if not any(name in data for name in self._bytes):
            return data
        try:
            kind = self._kind(type(message))
            if kind is None:
                return data
            records, fields = kind
            record = records.decode(data)
            return records.encode(record) if rename_frames(record, fields, self._new) else data
        except (InterfaceError, CdrError) as error:
            reason = str(error)
        except Exception as error:  # noqa: BLE001 - whatever malformed bytes lead to
            reason = f"its bytes do not follow its definition: {str(error) or type(error).__name__}"
        self.problems.setdefault(
            message.topic, f"{message.topic}: its frames are not renamed: {reason}"
        )
        return data

    def frames_in(self, message: BagMessage) -> set[str]:
        """Return the frames that a message names; none if it cannot be decoded."""
        found: set[str] = set()

        def note(frame: str) -> str:
            found.add(frame)
            return frame

        with suppress(Exception):  # whatever malformed bytes and definitions lead to
            if kind := self._kind(type(message)):
                records, fields = kind
                rename_frames(records.decode(message.data), fields, note)
        return found

    def unused(self) -> list[str]:
        """Return the old names that no message had."""
        return [name for name in self._names if name not in self.found]

    def _new(self, frame: str) -> str:
        new = self._names.get(frame)
        if new is None:
            return frame
        self.found.add(frame)
        return new

    def _kind(self, cls: type[BagMessage]) -> tuple[WrittenRecords, dict[str, Any]] | None:
        """Return how to decode the messages of a class, and their frames; None without frames."""
        if cls not in self._kinds:
            channel = channel_of(cls)
            records = records_of(channel)
            fields = frame_fields(channel.topic.type, records.definition)
            self._kinds[cls] = (records, fields) if fields else None
        return self._kinds[cls]


def records_of(channel: BagChannel) -> WrittenRecords:
    """Return the decoder and encoder of a channel's messages.

    Raises:
        InterfaceError: The messages are not in CDR, or their definition is missing or invalid.
    """
    topic, schema = channel.topic, channel.schema
    if not is_decodable(topic):
        raise InterfaceError(f"its messages are not in CDR but in '{topic.serialization_format}'")
    text = schema.data.decode("utf-8", "replace")
    encoding, text = in_ros2msg(topic.type, schema.encoding, text)
    return _records(topic.type, text if encoding == ENCODING else "")


@lru_cache(maxsize=64)
def _records(type_name: str, text: str) -> WrittenRecords:
    written = parse_definition(type_name, text) if text and "/msg/" in type_name else {}
    return WrittenRecords(type_name, written, exact=True)


def frame_fields(
    full_name: str, definition_of: Callable[[str], MessageDefinition]
) -> dict[str, Any]:
    """Return the fields of a message that name frames, at any depth.

    Args:
        full_name: The message.
        definition_of: Returns the definition of a message by its full name.

    Returns:
        Names of fields with None for a text, and with the fields in it for messages.

    Raises:
        InterfaceError: A type in the message is not known.
    """
    found: dict[str, Any] = {}
    for field in definition_of(full_name).fields:
        is_nested = isinstance(field.type, AbstractNestedType)
        inner = field.type.value_type if isinstance(field.type, AbstractNestedType) else field.type
        if isinstance(inner, NamespacedType):
            if fields := frame_fields(inner.full_name, definition_of):
                found[field.name] = fields
        elif (
            isinstance(inner, AbstractString) and not is_nested and field.name.endswith("frame_id")
        ):
            found[field.name] = None
    return found


def rename_frames(message: Any, fields: dict[str, Any], rename: Callable[[str], str]) -> bool:
    """Replace the names of frames in a message.

    Args:
        message: A message.
        fields: What `frame_fields` returned for its type.
        rename: Returns the new name of a frame, which may be the old one.

    Returns:
        True if a name has changed.
    """
    changed = False
    for name, inner in fields.items():
        value = getattr(message, name)
        if inner is None:
            new = rename(value)
            if new != value:
                setattr(message, name, new)
                changed = True
            continue
        for one in value if isinstance(value, list) else [value]:
            changed |= rename_frames(one, inner, rename)
    return changed
