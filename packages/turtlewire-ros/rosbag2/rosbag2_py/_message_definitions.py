"""Definitions of message types from this installation."""

from __future__ import annotations

from rosbag2_py._storage import MessageDefinition
from turtlewire.bag.definitions import ENCODING, definition_text
from turtlewire.errors import InterfaceError
from turtlewire.msg import type_hash


class LocalMessageDefinitionSource:
    """Finds the definitions that bags carry."""

    def get_full_text(self, root_topic_type: str) -> MessageDefinition:
        """Return the definition of a type, followed by all types in it.

        Returns:
            The definition; its encoding is ``unknown`` and its text empty for an unknown type, as
            in rosbag2.
        """
        try:
            text = definition_text(root_topic_type)
            return MessageDefinition(root_topic_type, ENCODING, text, type_hash(root_topic_type))
        except InterfaceError:
            return MessageDefinition(root_topic_type, "unknown", "", "")
