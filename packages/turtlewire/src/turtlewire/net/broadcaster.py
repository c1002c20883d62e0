"""Transforms out."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.listener import QOS, STATIC_QOS, STATIC_TOPIC, TOPIC, TYPE_NAME
from turtlewire.wire.base import TypeId

if TYPE_CHECKING:
    from turtlewire.wire import base

__all__ = ["Broadcaster"]


class Broadcaster:
    """Sends transforms of one node, each after the checks of a buffer. Thread-safe."""

    def __init__(self, node: base.Node) -> None:
        self._node = node
        self._lock = threading.Lock()
        self._publishers: dict[str, base.Publisher] = {}
        self._static: dict[str, Any] = {}

    def send(self, parent: str, child: str, stamp_ns: Any, translation: Any, rotation: Any) -> None:
        """Send a transform at one time.

        Raises:
            TypeError: An argument is of another type.
        """
        if stamp_ns is None or isinstance(stamp_ns, (tuple, list)):
            remedy = "the translation comes after the stamp"
            if stamp_ns is None:
                remedy = "for a transform that holds at all times, call send_static_transform"
            given = type(stamp_ns).__name__
            raise TypeError(
                "stamp_ns must be an int of nanoseconds or a numpy.datetime64, for example "
                f"time.time_ns(), not {given}; {remedy}"
            )
        checked = Buffer()
        checked.set_transform(parent, child, stamp_ns, translation, rotation)
        found = checked.lookup_transform(checked.frames()[1], checked.frames()[0])
        self._publish(TOPIC, [_message(found)])

    def send_static(self, parent: str, child: str, translation: Any, rotation: Any) -> None:
        """Send a transform that holds at all times; late listeners get all static transforms."""
        checked = Buffer()
        checked.set_static_transform(parent, child, translation, rotation)
        found = checked.lookup_transform(checked.frames()[1], checked.frames()[0])
        with self._lock:
            self._static[found.source_frame] = _message(found)
            messages = list(self._static.values())
        self._publish(STATIC_TOPIC, messages)

    def _publish(self, topic: str, transforms: list[Any]) -> None:
        with self._lock:
            publisher = self._publishers.get(topic)
            if publisher is None:
                qos = QOS if topic == TOPIC else STATIC_QOS._replace(depth=1)
                type_id = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
                publisher = self._node.create_publisher(topic, type_id, qos)
                self._publishers[topic] = publisher
            message = msg.get_message(TYPE_NAME)(transforms=transforms)
            publisher.publish(msg.serialize(message))


def _message(transform: Any) -> Any:
    stamped: Any = msg.get_message("geometry_msgs/msg/TransformStamped")()
    seconds, nanoseconds = divmod(transform.stamp_ns or 0, 1_000_000_000)
    stamped.header.stamp.sec, stamped.header.stamp.nanosec = seconds, nanoseconds
    stamped.header.frame_id = transform.target_frame
    stamped.child_frame_id = transform.source_frame
    place, turn = stamped.transform.translation, stamped.transform.rotation
    place.x, place.y, place.z = transform.translation
    turn.x, turn.y, turn.z, turn.w = transform.rotation
    return stamped
