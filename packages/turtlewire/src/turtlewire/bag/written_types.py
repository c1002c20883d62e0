"""Types as a bag defines them; converts their messages to ours."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from turtlewire.bag.definitions import has_interface, learn_types, parse_definition
from turtlewire.bag.ros1_definitions import ros2_definition
from turtlewire.errors import CdrError, InterfaceError
from turtlewire.msg.cdr import deserialize, serialize
from turtlewire.msg.classes import get_message
from turtlewire.msg.evolution import Evolution, differs, older_evolution
from turtlewire.msg.message import missing_fields
from turtlewire.msg.registry import load_message

if TYPE_CHECKING:
    from turtlewire.msg.message import Message

__all__ = ["WrittenType", "written_type"]


class WrittenType:
    """A message type with the definition that its writer had.

    Args:
        name: ``"sensor_msgs/msg/Range"``.
        encoding: ``ros2msg``, ``ros1msg``; another if the definition cannot be read.
        text: The definition with its dependencies; empty if the bag has none.
        is_ros1: Whether the messages are bytes of ROS 1 instead of CDR.
    """

    def __init__(self, name: str, encoding: str, text: str, *, is_ros1: bool = False) -> None:
        self.name = name
        self._is_ros1 = is_ros1
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

    def decode(self, data: bytes) -> Message:
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
