"""Takes the messages out of the records of a chunk, natively where the compiled core exists."""

from __future__ import annotations

import struct
from collections.abc import Callable, Container
from typing import TYPE_CHECKING

from turtlewire.bag.mcap_records import OPCODE_AND_LENGTH, Op
from turtlewire.platforms import asked_core

if TYPE_CHECKING:
    _Split = Callable[[bytes | memoryview, int, Container[int] | None, "list[RawMessage]"], int]

__all__ = [
    "LoggedBytes",
    "RawMessage",
    "mcap_messages",
    "plain_mcap_messages",
    "plain_ros1_messages",
    "ros1_fields",
    "ros1_header",
    "ros1_messages",
]

#: Log time, channel, publish time and bytes of a message.
RawMessage = tuple[int, int, int, bytes]

#: Log time and bytes of a message.
LoggedBytes = tuple[int, bytes]

_MCAP_MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
_U32 = struct.Struct("<I")
_TIME = struct.Struct("<II")  # seconds, nanoseconds
_ROS1_MESSAGE = b"\x02"


def plain_mcap_messages(
    records: bytes | memoryview,
    position: int,
    wanted: Container[int] | None,
    into: list[RawMessage],
) -> int:
    """Append the messages of records to a list, up to a record of another kind.

    Args:
        records: The records of an MCAP chunk.
        position: Where the first record begins.
        wanted: The channels whose messages are wanted; None means all.
        into: The list.

    Returns:
        Where the first damaged record or one of another kind begins; else the end.
    """
    unpack, unpack_message = OPCODE_AND_LENGTH.unpack_from, _MCAP_MESSAGE.unpack_from
    prefix, fields, end = OPCODE_AND_LENGTH.size, _MCAP_MESSAGE.size, len(records)
    while position + prefix <= end:
        opcode, length = unpack(records, position)
        body = position + prefix
        if opcode != Op.MESSAGE or length < fields or body + length > end:
            break
        position = body + length
        channel, _, log_time, publish_time = unpack_message(records, body)
        if wanted is None or channel in wanted:
            data = bytes(records[body + fields : position])
            into.append((log_time, channel, publish_time, data))
    return position


def plain_ros1_messages(
    records: bytes | memoryview,
    position: int,
    wanted: Container[int] | None,
    into: list[RawMessage],
) -> int:
    """Do the same with the records of a chunk of ROS 1; the channels are its connections."""
    while position < len(records):
        try:
            fields, data, end = ros1_fields(records, position)
            if fields.get("op") != _ROS1_MESSAGE:
                break
            (connection,) = _U32.unpack(fields["conn"])
            seconds, nanoseconds = _TIME.unpack(fields["time"])
        except (ValueError, KeyError, struct.error):
            break
        position = end
        if wanted is None or connection in wanted:
            log_time = seconds * 1_000_000_000 + nanoseconds
            into.append((log_time, connection, log_time, bytes(data)))
    return position


def ros1_fields(
    records: bytes | memoryview, position: int
) -> tuple[dict[str, bytes], memoryview, int]:
    """Return the fields and the data of a record of ROS 1, and where it ends.

    Raises:
        ValueError: The record is damaged, or the bytes end before it does.
    """
    head, position = _part(memoryview(records), position)
    data, end = _part(memoryview(records), position)
    return ros1_header(head), data, end


def ros1_header(head: memoryview) -> dict[str, bytes]:
    """Return the fields of a header: ``name=value``, each after its length.

    Raises:
        ValueError: The header is damaged.
    """
    fields, at = {}, 0
    while at < len(head):
        field, at = _part(head, at)
        name, equals, value = bytes(field).partition(b"=")
        if not equals:
            raise ValueError("a field without a value")
        fields[name.decode("utf-8", "replace")] = value
    return fields


def _part(data: memoryview, position: int) -> tuple[memoryview, int]:
    """Return the bytes whose length stands before them, and where they end."""
    begin = position + 4
    if begin > len(data):
        raise ValueError("the bytes end in a length")
    end = begin + int.from_bytes(data[position:begin], "little")
    if end > len(data):
        raise ValueError("the bytes end in a record")
    return data[begin:end], end


def _choose() -> tuple[_Split, _Split]:
    if asked_core() != "python":
        try:
            from turtlewire._native import mcap_messages, ros1_messages
        except ImportError:
            pass
        else:
            return mcap_messages, ros1_messages
    return plain_mcap_messages, plain_ros1_messages


mcap_messages, ros1_messages = _choose()
