"""One message of a bag."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import InterfaceError

if TYPE_CHECKING:
    from turtlewire.msg import Message

__all__ = ["BagMessage"]


class BagMessage(NamedTuple):
    """One recorded message.

    Attributes:
        topic: Name of its topic.
        type: ``"tf2_msgs/msg/TFMessage"``.
        log_time_ns: When the recorder received it, nanoseconds since 1970.
        publish_time_ns: When it was sent; equal to ``log_time_ns`` where the bag does not tell. A
            latched message may have been sent long before the bag began.
        data: Its CDR bytes.
    """

    topic: str
    type: str
    log_time_ns: int
    publish_time_ns: int
    data: bytes

    def decode(self) -> Message:
        """Return the message object.

        Raises:
            CdrError: The bytes are malformed.
            InterfaceError: The type is not known and the bag does not define it.
        """
        from turtlewire.msg import deserialize, get_message

        if self.type and "/" not in self.type:
            raise InterfaceError(f"{self.topic}: '{self.type}' is not a type of ROS 2").with_hint(
                "The messages of this topic may be JSON or Protobuf: topics[name]."
                "serialization_format tells, and `data` has the bytes."
            )
        return deserialize(get_message(self.type), self.data)
