"""Messages to bytes and back: the CDR encoding of ROS 2, with its four header bytes."""

from __future__ import annotations

import struct
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import TYPE_CHECKING, Any, overload

from turtlewire.errors import CdrError
from turtlewire.msg.classes import get_message, type_name
from turtlewire.msg.message import Message, MessageT

if TYPE_CHECKING:
    from turtlewire.msg.values import Cdr


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
    except Exception as error:  # noqa: BLE001 - any; what is wrong is found out below
        fault = str(error)
    # Outside of the handler, because the generated code's error would not help users.
    from turtlewire.msg.diagnosis import check_message

    if not isinstance(message, Message):
        raise TypeError(f"expected a message, got {_shown(message)}")
    check_message(message._DEFINITION, message)
    raise CdrError(f"{type_name(type(message))}: {fault}")


def _shown(value: object) -> str:
    """Return what was passed in place of a message, and what to write."""
    if isinstance(value, type):
        return f"the class {value.__name__}; write {value.__name__}()"
    if isinstance(value, dict):
        return "dict; its fields are given to the class: get_message(type)(**fields)"
    return type(value).__name__


@overload
def deserialize(
    interface: type[MessageT], data: bytes | bytearray | memoryview, *, arrays: bool = False
) -> MessageT: ...
@overload
def deserialize(
    interface: str, data: bytes | bytearray | memoryview, *, arrays: bool = False
) -> Any: ...
def deserialize(
    interface: type[Message] | str, data: bytes | bytearray | memoryview, *, arrays: bool = False
) -> Any:
    """Decode a message.

    Args:
        interface: Its class, or its name such as ``"geometry_msgs/msg/Twist"``.
        data: The encoded bytes, header included. Bytes after the content (padding) are ignored.
        arrays: True to get sequences of messages that hold nothing but ``float`` or nothing but
            ``double`` numbers (Point, ColorRGBA, Pose …) as read-only NumPy arrays of shape
            ``(n, numbers of each)``. They share the memory of ``data``, so a million points take no
            longer than one. Such a message is for reading: it cannot be compared or encoded.

    Bytes of an older ROS 2, whose message had fewer fields, are read too: the fields that they lack
    have their defaults, and `missing_fields` names them.

    Returns:
        A new message. Without ``arrays`` it shares no memory with ``data``.

    Raises:
        CdrError: The bytes are malformed; the text names the field and the offset. Never reads
            beyond ``data``.
        InterfaceError: ``interface`` is not a message class or the name of a message.
    """
    if type(data) is not bytes:
        data = _bytes_of(interface, data)
    if arrays:
        return _with_arrays(
            get_message(interface) if isinstance(interface, str) else interface, data
        )
    encapsulation = data[:2]
    try:
        if encapsulation == _LITTLE_ENDIAN:
            return interface._from_cdr(data)  # type: ignore[union-attr] # a str raises
        if encapsulation == _BIG_ENDIAN:
            return interface._from_cdr_big_endian(data)  # type: ignore[union-attr]
    except Exception as error:  # noqa: BLE001 - any; what is wrong is found out below
        fault = str(error)
    else:
        name = interface if isinstance(interface, str) else type_name(interface)
        raise CdrError(
            f"{name}: unknown encapsulation {encapsulation.hex(' ') or '(no bytes)'} at offset 0"
        ).with_hint("Plain CDR is read: 00 01 (little endian) and 00 00 (big endian).")
    # Outside of the handler, because the generated code's error would not help users.
    if isinstance(interface, str):
        return deserialize(get_message(interface), data)
    from turtlewire.msg.diagnosis import check_bytes
    from turtlewire.msg.evolution import older_evolution

    name = type_name(interface)
    if older := older_evolution(name):
        with suppress(CdrError):
            return older.decode(data)
    check_bytes(interface._DEFINITION, data, "<" if encapsulation == _LITTLE_ENDIAN else ">")
    raise CdrError(f"{name}: {fault}")


def _bytes_of(interface: object, data: object) -> bytes:
    """Return the bytes of a message.

    Raises:
        TypeError: ``data`` is something else, or the arguments are swapped.
    """
    with suppress(TypeError):
        return bytes(memoryview(data))  # type: ignore[arg-type] # tried
    if isinstance(interface, (bytes, bytearray, memoryview)):
        raise TypeError("deserialize() takes the class or its name first, and then the bytes")
    advice = ""
    if hasattr(data, "decode") and isinstance(getattr(data, "data", None), bytes):
        advice = "; call its decode(), or pass its data"
    elif isinstance(data, Message):
        advice = ", which is decoded already"
    raise TypeError(f"data must be bytes, not {type(data).__name__}{advice}")


def _with_arrays(interface: type[Message] | str, data: bytes) -> Message:
    cls = get_message(interface) if isinstance(interface, str) else interface
    order = {_LITTLE_ENDIAN: "<", _BIG_ENDIAN: ">"}.get(data[:2], "")
    if not order:
        return deserialize(cls, data)
    hashable: Any = cls  # mypy does not see that classes have hashes
    try:
        message: Message = _row_decoder(hashable, order)(data)
    except (ValueError, IndexError, struct.error):
        return deserialize(cls, data)  # which says what is wrong
    return message


@cache
def _row_decoder(cls: Any, order: str) -> Callable[[bytes], Any]:
    from turtlewire.msg.decoder import make_decoder

    return make_decoder(cls, order, get_message, rows=True)
