"""Messages to bytes and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from turtlewire import msg

from .type_support import check_for_type_support

if TYPE_CHECKING:
    from turtlewire.msg import Message

M = TypeVar("M", bound="Message")


def serialize_message(message: Message) -> bytes:
    """Encode a message as CDR, with its four encapsulation bytes.

    Raises:
        CdrError: A field holds what its type cannot.
    """
    check_for_type_support(type(message))
    return msg.serialize(message)


def deserialize_message(serialized_message: bytes, message_type: type[M]) -> M:
    """Decode CDR bytes as a message of ``message_type``.

    Raises:
        CdrError: The bytes are not such a message.
    """
    check_for_type_support(message_type)
    return msg.deserialize(message_type, serialized_message)
