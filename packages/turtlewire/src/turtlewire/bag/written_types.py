"""Types as a bag defines them; converts their messages to ours."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

from turtlewire.bag.definitions import has_interface, in_ros2msg, learn_types, parse_definition
from turtlewire.errors import CdrError, InterfaceError
from turtlewire.msg.cdr import deserialize, serialize
from turtlewire.msg.classes import get_message
from turtlewire.msg.evolution import Evolution, differs, older_evolution
from turtlewire.msg.message import missing_fields
from turtlewire.msg.parser import without_comment
from turtlewire.msg.registry import load_message

__all__ = ["WrittenType", "ros2_definition", "written_type"]

_STATEMENT = re.compile(r"\s*([\w/]+)(\[\d*\])?\s+(\w+)\s*(=?)(.*)")
_TYPES = {
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
    "Header": "std_msgs/Header",
}


class WrittenType:
    """A message type with the definition that its writer had.

    Args:
        name: ``"sensor_msgs/msg/Range"``.
        encoding: ``ros2msg``, ``ros2idl``, ``ros1msg``; another if the definition cannot be read.
        text: The definition with its dependencies; empty if the bag has none.
        is_ros1: Whether the messages are bytes of ROS 1 instead of CDR.
    """

    def __init__(self, name: str, encoding: str, text: str, *, is_ros1: bool = False) -> None:
        self.name = name
        self._is_ros1 = is_ros1
        encoding, text = in_ros2msg(name, encoding, text)
        self._text = ros2_definition(text) if encoding == "ros1msg" else text
        self._is_readable = encoding in ("ros2msg", "ros1msg")
        #: An empty text of ROS 1 is that of an empty message; other writers also leave texts out.
        self._has_definition = encoding == "ros1msg" or (encoding == "ros2msg" and bool(text))
        self._failure: InterfaceError | None = None
        self._is_compared = False
        self._evolution: Evolution | None = None

    @property
    def evolution(self) -> Evolution | None:
        """The decoder for the messages; None if they follow our definition.

        Raises:
            InterfaceError: The type is not known and the definition cannot be read.
        """
        if self._failure is not None:  # looking up a type again would be slow
            raise self._failure
        if not self._is_compared:
            try:
                self._evolution = self._compared()
            except InterfaceError as error:
                self._failure = error
                raise
            self._is_compared = True
        return self._evolution

    def _compared(self) -> Evolution | None:
        is_known = has_interface(self.name)
        if not self._has_definition and (not self._is_readable or is_known):
            load_message(self.name)  # the error says how to get an unknown type
            return None
        try:
            written = parse_definition(self.name, self._text)
            learn_types(self.name, self._text)
            if self._is_ros1 or differs(self.name, written):
                return Evolution(self.name, written, is_ros1=self._is_ros1)
        except (InterfaceError, ValueError) as error:  # ValueError: it is not the name of a type
            if is_known and not self._is_ros1:
                return None
            raise InterfaceError(
                f"the bag's definition of {self.name} cannot be used: {error}"
            ) from error
        return None

    def decode(self, data: bytes) -> Any:
        """Return a message as an object of our type.

        Raises:
            CdrError: The bytes are malformed.
            InterfaceError: The type is not known and the definition cannot be read.
        """
        evolution = self._evolution if self._is_compared else self.evolution
        if evolution is not None:
            return evolution.decode(data)
        return deserialize(get_message(self.name), data)

    def upgrade(self, data: bytes) -> bytes:
        """Return the CDR bytes by our definition; what cannot be decoded stays as it is."""
        try:
            evolution = self.evolution
            if evolution is None and (self._has_definition or not older_evolution(self.name)):
                return data
            message = self.decode(data)
        except (InterfaceError, CdrError):
            return data
        return serialize(message) if evolution or missing_fields(message) else data


@lru_cache(maxsize=512)
def written_type(name: str, encoding: str, text: str, *, is_ros1: bool = False) -> WrittenType:
    """Return the same `WrittenType` for the same arguments: comparing definitions takes a while."""
    return WrittenType(name, encoding, text, is_ros1=is_ros1)


def ros2_definition(text: str) -> str:
    """Return a definition of ROS 1, with the types that it uses, in the words of ROS 2.

    ``time``, ``duration`` and ``Header`` become ROS 2's types, and strings get quotes. Names stay
    as they are, except the names of constants, which ROS 2 demands in capitals.
    """
    return "\n".join(_line(line) for line in text.splitlines())


def _line(line: str) -> str:
    found = _STATEMENT.fullmatch(line)
    if found is None or line.lstrip().startswith("#"):
        return line
    type_, array, name, equals, value = found.groups()
    type_ = _TYPES.get(type_, type_)
    if not equals:
        return f"{type_}{array or ''} {name}"
    if type_ == "string":  # the value is the rest of the line, including '#'
        quoted = value.strip().replace("\\", "\\\\").replace('"', '\\"')
        return f'string {name.upper()}="{quoted}"'
    value = without_comment(value).strip()
    if type_ in ("byte", "char") and re.fullmatch(r"-\d+", value):  # bytes have signs in ROS 1
        value = f"{256 + int(value)}"
    return f"{type_} {name.upper()}={value}"
