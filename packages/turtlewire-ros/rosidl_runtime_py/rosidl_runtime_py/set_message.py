"""Fills messages from dictionaries; `ros2 topic pub` and similar verbs read them from YAML."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any

from rosidl_runtime_py.convert import get_message_slot_types
from turtlewire.msg import Message, get_message
from turtlewire.msg.types import AbstractNestedType, AbstractSequence, BasicType, NamespacedType

if TYPE_CHECKING:
    from turtlewire.msg.types import AbstractType

_HEADER = "std_msgs/msg/Header"
_TIME = "builtin_interfaces/msg/Time"


def set_message_fields(
    msg: Message,
    values: dict[str, Any],
    expand_header_auto: bool = False,
    expand_time_now: bool = False,
) -> list[Any]:
    """Set fields of a message.

    Args:
        msg: The message; what ``values`` does not name stays.
        values: Values by field name, nested dictionaries for nested messages.
        expand_header_auto: Replace ``"auto"`` by a header with the time of publishing.
        expand_time_now: Replace ``"now"`` by the time of publishing.

    Returns:
        The ``builtin_interfaces/msg/Time`` objects in the message that await the time of
        publishing.

    Raises:
        AttributeError: A name is not a field.
        TypeError: A nested message got something else than a dictionary.
        ValueError: A value cannot be converted to the type of its field.
    """
    stamps: list[Any] = []
    _Filler(expand_header_auto, expand_time_now, stamps).fill(msg, values)
    return stamps


class _Filler:
    """One filling of a message; collects the stamps for later."""

    def __init__(self, expand_header_auto: bool, expand_time_now: bool, stamps: list[Any]) -> None:
        self.expand_header_auto = expand_header_auto
        self.expand_time_now = expand_time_now
        self.stamps = stamps

    def fill(self, msg: Any, values: Any) -> None:
        if not hasattr(values, "items"):
            raise TypeError(
                f"Value '{values}' is expected to be a dictionary but is a {type(values).__name__}"
            )
        types = get_message_slot_types(msg) if isinstance(msg, Message) else {}
        for name, value in values.items():
            current = getattr(msg, name)
            # The fields keep their zeros until the time of publishing is known.
            if self._awaits_time(current, value):
                continue
            setattr(msg, name, self._converted(types[name], current, value))

    def _awaits_time(self, current: Any, value: Any) -> bool:
        full_name = getattr(current, "_TYPE_NAME", None)
        if full_name == _HEADER and value == "auto" and self.expand_header_auto:
            self.stamps.append(current.stamp)
        elif full_name == _TIME and value == "now" and self.expand_time_now:
            self.stamps.append(current)
        else:
            return False
        return True

    def _converted(self, type_: AbstractType, current: Any, value: Any) -> Any:
        if isinstance(type_, NamespacedType):
            return self._message(type_, value)
        if isinstance(type_, AbstractNestedType):
            return self._values(type_, current, value)
        if type_ == BasicType("octet"):
            return _byte(value)
        return value if type(value) is type(current) else type(current)(value)

    def _message(self, type_: NamespacedType, value: Any) -> Any:
        # Messages are accepted unchanged, so that callers may nest them in dictionaries.
        if getattr(value, "_TYPE_NAME", None) == type_.full_name:
            return value
        message = get_message(type_.full_name)()
        if not self._awaits_time(message, value):
            self.fill(message, value)
        return message

    def _values(self, type_: AbstractNestedType, current: Any, value: Any) -> Any:
        if not hasattr(value, "__iter__"):
            raise TypeError(
                f"Value '{value}' is expected to be a list but is a {type(value).__name__}"
            )
        if isinstance(type_.value_type, NamespacedType):
            return [self._message(type_.value_type, item) for item in value]
        if type_.value_type == BasicType("octet"):
            return [_byte(item) for item in value]
        if isinstance(type_, AbstractSequence) and isinstance(current, array):
            # `array` converts and checks all numbers at once.
            return array(current.typecode, value)
        return list(value)


def _byte(value: Any) -> bytes:
    if isinstance(value, int):
        # Not `bytes(value)`, which would make that many zeros.
        return bytes((value,))
    # The inverse of `convert`: one character per byte.
    return value.encode("latin-1") if isinstance(value, str) else bytes(value)
