"""Listens to the transforms for a while and notes who published what."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import CdrError
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS

if TYPE_CHECKING:
    from turtlewire.wire.base import Context, MessageInfo

__all__ = ["TfTraffic", "listen_to_transforms"]

_TYPE = "tf2_msgs/msg/TFMessage"


class TfTraffic:
    """What was heard.

    Attributes:
        parents: Frame to its parents.
        publishers: Frame to the gids of its publishers.
        newest_ns: Frame of /tf to its newest stamp.
        ended_ns: When the listening ended, system time.
    """

    def __init__(self) -> None:
        self.parents: dict[str, set[str]] = {}
        self.publishers: dict[str, set[bytes]] = {}
        self.newest_ns: dict[str, int] = {}
        self.ended_ns = 0

    def note(self, message: Any, publisher: bytes, *, static: bool) -> None:
        """Take over a TFMessage."""
        for transform in message.transforms:
            child = transform.child_frame_id
            self.parents.setdefault(child, set()).add(transform.header.frame_id)
            self.publishers.setdefault(child, set()).add(publisher)
            if not static:
                stamp = transform.header.stamp.sec * 1_000_000_000 + transform.header.stamp.nanosec
                self.newest_ns[child] = max(stamp, self.newest_ns.get(child, 0))


def listen_to_transforms(context: Context, seconds: float) -> TfTraffic:
    """Subscribe to /tf and /tf_static for so many seconds."""
    heard: list[tuple[bytes, bytes, bool]] = []
    node = context.create_node("_turtlewire_doctor_listener")
    kind = TypeId(_TYPE, msg.type_hash(_TYPE))
    for topic, durability in (("/tf", Durability.VOLATILE), ("/tf_static", Durability.TRANSIENT_LOCAL)):

        def keep(cdr: bytes, info: MessageInfo, static: bool = topic == "/tf_static") -> None:
            heard.append((cdr, info.publisher_gid, static))

        node.create_subscription(topic, kind, QoS(depth=100, durability=durability), keep)
    threading.Event().wait(seconds)
    node.close()
    traffic = TfTraffic()
    traffic.ended_ns = time.time_ns()
    for cdr, publisher, static in heard:
        try:
            message = msg.deserialize(msg.get_message(_TYPE), cdr)
        except CdrError:
            continue  # a foreign publisher on the topic; the check of types names it
        traffic.note(message, publisher, static=static)
    return traffic
