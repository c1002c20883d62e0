"""Bags of ROS 1, read through the package `rosbags` (an extra) and turned into ROS 2's CDR."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.bag.message import BagMessage
from turtlewire.bag.metadata import BagMetadata, TopicInfo
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["MAGIC", "Ros1Storage"]

MAGIC = b"#ROSBAG V2.0\n"

#: The type of /tf in old bags, which has the same fields.
_RENAMED = {"tf/msg/tfMessage": "tf2_msgs/msg/TFMessage"}


class Ros1Storage:
    """A ``.bag`` file; see `turtlewire.bag.storage.StorageFile`.

    Messages whose type ROS 2 does not have keep their ROS 1 bytes, and their topic's
    ``serialization_format`` is ``ros1``.

    Raises:
        BagError: The bag is damaged, or `rosbags` is not installed.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self.problems: list[str] = []
        try:
            from rosbags.rosbag1 import Reader
            from rosbags.typesys import Stores, get_typestore
        except ImportError:
            raise BagError(f"{path} is a bag of ROS 1").with_hint(
                "Install rosbags to read it: pip install 'turtlewire[ros1]'"
            ) from None
        self._store = get_typestore(Stores.ROS2_JAZZY)
        try:
            self._reader = Reader(path)
            self._reader.open()
        except Exception as error:  # whatever rosbags makes of damaged bytes
            raise BagError(f"{path}: {error}") from error

    def close(self) -> None:
        """Release the file."""
        self._reader.close()

    def summary(self) -> BagMetadata:
        """Return the file's metadata."""
        topics: dict[str, TopicInfo] = {}
        for connection in self._reader.connections:
            kind = self._type(connection)
            encoding = "cdr" if self._is_known(kind) else "ros1"
            topic = TopicInfo(connection.topic, kind, encoding, [], "", 0)
            topics.setdefault(connection.topic, topic).message_count += connection.msgcount
        filled = self._reader.message_count > 0
        return BagMetadata(
            storage="ros1",
            topics=list(topics.values()),
            start_ns=self._reader.start_time if filled else 0,
            duration_ns=self._reader.duration if filled else 0,
            message_count=self._reader.message_count,
        )

    def definitions(self) -> dict[str, tuple[str, str]]:
        """None: those in the file are of ROS 1."""
        return {}

    def walk_transforms(
        self, _names: object, _start_ns: int, _end_ns: int, _target: object
    ) -> bool:
        """Return False: ROS 1's messages are converted one by one."""
        return False

    def counted_messages(self) -> int | None:
        """Return None: a ROS 1 bag keeps no statistics."""
        return None

    def messages(
        self,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damaged: Callable[[BagError], None],
    ) -> Iterator[BagMessage]:
        """Yield messages; bags of ROS 1 have no publish time."""
        topics = {topic.name: topic for topic in self.summary().topics}
        connections = [each for each in self._reader.connections if wanted(topics[each.topic])]
        if not connections:
            return
        try:
            for connection, time, raw in self._reader.messages(connections):
                if start_ns <= time <= end_ns:
                    topic = topics[connection.topic]
                    data = raw
                    if topic.serialization_format == "cdr":
                        data = bytes(self._store.ros1_to_cdr(raw, topic.type))
                    yield BagMessage(topic.name, topic.type, time, time, bytes(data))
        except Exception as error:  # noqa: BLE001 - whatever rosbags makes of damaged bytes
            damaged(BagError(f"{self.path}: {error}; the messages before it were read"))

    def _type(self, connection: Any) -> str:
        kind: str = connection.msgtype
        return _RENAMED.get(kind, kind)

    def _is_known(self, kind: str) -> bool:
        return kind in self._store.fielddefs
