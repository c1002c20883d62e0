"""Messages to bytes and back: the CDR encoding of ROS 2, with its four header bytes."""

from __future__ import annotations

import struct
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar

from turtlewire.errors import CdrError
from turtlewire.msg.classes import get_message, type_name
from turtlewire.msg.message import Message

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.msg.values import Cdr

__all__ = ["deserialize", "deserialize_rows", "encode", "serialize"]

_MessageT = TypeVar("_MessageT", bound=Message)

_LITTLE_ENDIAN = b"\x00\x01"
_BIG_ENDIAN = b"\x00\x00"


def serialize(message: Message) -> bytes:
    """Encode a message.

    Args:
        message: Any message. Integers and NumPy scalars are accepted where its fields hold floats.

    Returns:
        The header (``00 01 00 00``, little endian) and the content, not padded at the end.

    Raises:
        CdrError: A value does not fit its field; the text names the field, what was expected and
            what was found.
    """
    cdr = encode(message)
    return b"".join(cdr) if type(cdr) is tuple else bytes(cdr)  # type: ignore[arg-type] # no tuple


def encode(message: Message) -> Cdr:
    """Serialize a message without copying long sequences of numbers.

    For a caller that hands the result on at once: the parts are the message's own.
    """
    try:
        return message._to_cdr()
    except Exception as fault:
        from turtlewire.msg.diagnosis import check_message

        if not isinstance(message, Message):
            raise TypeError(f"expected a message, got {type(message).__name__}") from None
        check_message(message._DEFINITION, message)
        raise CdrError(f"{type_name(type(message))}: {fault}") from fault


def deserialize(cls: type[_MessageT], data: bytes | bytearray | memoryview) -> _MessageT:
    """Decode a message.

    Args:
        cls: Its class.
        data: The encoded bytes, header included. Bytes after the content (padding) are ignored.

    Returns:
        A new message that shares no memory with ``data``.

    Raises:
        CdrError: The bytes are malformed; the text names the field and the offset. Never reads
            beyond ``data``.
        InterfaceError: ``cls`` is not a message class.
    """
    if type(data) is not bytes:
        data = bytes(data)
    encapsulation = data[:2]
    try:
        if encapsulation == _LITTLE_ENDIAN:
            return cls._from_cdr(data)  # type: ignore[return-value]
        if encapsulation == _BIG_ENDIAN:
            return cls._from_cdr_big_endian(data)  # type: ignore[return-value]
    except Exception as fault:
        from turtlewire.msg.diagnosis import check_bytes

        name = type_name(cls)
        check_bytes(cls._DEFINITION, data, "<" if encapsulation == _LITTLE_ENDIAN else ">")
        raise CdrError(f"{name}: {fault}") from fault
    raise CdrError(
        f"{type_name(cls)}: unknown encapsulation {encapsulation.hex(' ') or '(no bytes)'} at "
        "offset 0"
    ).with_hint("Plain CDR is read: 00 01 (little endian) and 00 00 (big endian).")


def deserialize_rows(cls: type[_MessageT], data: bytes) -> _MessageT:
    """Decode a message whose long sequences are only looked at as a whole.

    Sequences of messages that hold nothing but ``float`` or nothing but ``double`` numbers (Point,
    ColorRGBA, Pose …) become read-only arrays of NumPy, ``(n, numbers of each)``, which share the
    memory of ``data``. A million points take no longer than one. Such a message is for reading:
    it cannot be compared or encoded.

    Raises:
        CdrError: As :func:`deserialize`.
    """
    order = {_LITTLE_ENDIAN: "<", _BIG_ENDIAN: ">"}.get(data[:2], "")
    if not order:
        return deserialize(cls, data)
    try:
        decode = _row_decoder(cls, order)  # type: ignore[arg-type] # classes have hashes
        message: _MessageT = decode(data)
    except (ValueError, IndexError, struct.error):
        return deserialize(cls, data)  # which says what is wrong
    return message


@cache
def _row_decoder(cls: Any, order: str) -> Callable[[bytes], Any]:
    from turtlewire.msg.decoder import make_decoder

    return make_decoder(cls, order, get_message, rows=True)
