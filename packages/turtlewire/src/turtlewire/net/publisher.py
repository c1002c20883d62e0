"""Messages and transforms out."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic

from turtlewire import msg
from turtlewire.call_errors import explain_calls, near_name
from turtlewire.msg.message import MessageT
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.datetimes import as_nanoseconds
from turtlewire.tf.listener import QOS, STATIC_QOS, STATIC_TOPIC, TOPIC, TYPE_NAME
from turtlewire.wire.base import TypeId

if TYPE_CHECKING:
    from turtlewire.tf.datetimes import Span
    from turtlewire.wire import base


@explain_calls
class Publisher(Generic[MessageT]):
    """Publishes messages of one type on one topic. Thread-safe.

    Attributes:
        topic: Its fully qualified name.
        type: The class of its messages.
    """

    def __init__(
        self,
        publisher: base.Publisher,
        graph: base.Graph,
        message_type: type[MessageT],
        on_close: Callable[[Publisher[MessageT]], None],
    ) -> None:
        self._publisher = publisher
        self._graph = graph
        self._on_close = on_close
        self.topic: str = publisher.topic
        self.type = message_type

    def publish(self, message: MessageT | None = None, /, **fields: Any) -> None:
        """Send a message, or one with these fields.

        Raises:
            TypeError: The message has another type or no such field, or both kinds of arguments
                are given.
            CdrError: A field cannot hold its value.
            WireError: The connection is closed.
        """
        if message is None:
            self._check_fields(fields)
            message = self.type(**fields)
        elif fields:
            raise TypeError("publish() takes a message or fields, not both")
        if not isinstance(message, self.type):
            wrong: object = message
            given = type(wrong).__name__
            if isinstance(wrong, type):
                given = f"the class {wrong.__name__}"
            raise TypeError(
                f"{self.topic} has the type {msg.type_name(self.type)}, but publish() was called "
                f"with {given}; its fields can be given by name: {', '.join(self._field_names())}"
            )
        self._publisher.publish(msg.serialize(message))

    def _field_names(self) -> list[str]:
        return list(self.type.get_fields_and_field_types())

    def _check_fields(self, fields: dict[str, Any]) -> None:
        known = self._field_names()
        for name in fields:
            if name not in known:
                near = near_name(name, known)
                advice = f"did you mean '{near}'?" if near else f"it has {', '.join(known)}"
                raise TypeError(f"{msg.type_name(self.type)} has no field '{name}'; {advice}")

    def wait_for_subscribers(self, count: int = 1, *, timeout_ns: Span | None = None) -> bool:
        """Block until this many subscriptions are matched.

        Args:
            count: How many.
            timeout_ns: How long to wait at most; None waits without limit.

        Returns:
            False if the time was over before.
        """
        limit = None if timeout_ns is None else as_nanoseconds(timeout_ns, "timeout_ns")
        return self._graph.wait_for(lambda: self._publisher.subscription_count() >= count, limit)

    def close(self) -> None:
        """Leave the topic. Idempotent."""
        self._publisher.close()
        self._on_close(self)


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
