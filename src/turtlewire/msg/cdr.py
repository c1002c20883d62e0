"""Messages to bytes and back: the CDR encoding of ROS 2, with its four header bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from turtlewire.errors import CdrError
from turtlewire.msg.classes import type_name
from turtlewire.msg.message import Message

if TYPE_CHECKING:
    from turtlewire.msg.values import Cdr

__all__ = ["deserialize", "encode", "serialize"]

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
    """What :func:`serialize` returns, without copying long sequences of numbers.

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
