"""Listens to the transforms for a while and notes who published what."""

from __future__ import annotations

import math
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
_JITTER_NS = 1_000_000
_LEAP_M = 0.5
_FASTEST_M_S = 100.0


class TfTraffic:
    """What was heard.

    Attributes:
        parents: Frame to its parents.
        publishers: Frame to the gids of its publishers.
        newest_ns: Frame of /tf to its newest stamp.
        back_ns: Frame to the largest step back of its stamps; steps of less than a clock's jitter
            do not count.
        leaps_m: Frame to its largest step within its parent that was faster than any robot.
        ended_ns: When the listening ended, system time.
    """

    def __init__(self) -> None:
        self.parents: dict[str, set[str]] = {}
        self.publishers: dict[str, set[bytes]] = {}
        self.newest_ns: dict[str, int] = {}
        self.back_ns: dict[str, int] = {}
        self.leaps_m: dict[str, float] = {}
        self.ended_ns = 0
        self._last: dict[str, tuple[str, int, Any]] = {}

    def note(self, message: Any, publisher: bytes, *, static: bool) -> None:
        """Take over a TFMessage."""
        for transform in message.transforms:
            child = transform.child_frame_id
            self.parents.setdefault(child, set()).add(transform.header.frame_id)
            self.publishers.setdefault(child, set()).add(publisher)
            if not static:
                stamp = transform.header.stamp.sec * 1_000_000_000 + transform.header.stamp.nanosec
                self.newest_ns[child] = max(stamp, self.newest_ns.get(child, 0))
                self._note_step(
                    child, transform.header.frame_id, stamp, transform.transform.translation
                )

    def _note_step(self, child: str, parent: str, stamp: int, place: Any) -> None:
        last_parent, last_stamp, last = self._last.get(child, (parent, stamp, place))
        self._last[child] = (parent, stamp, place)
        if last_stamp - stamp > _JITTER_NS:
            self.back_ns[child] = max(last_stamp - stamp, self.back_ns.get(child, 0))
        leap = math.dist((place.x, place.y, place.z), (last.x, last.y, last.z))
        if parent == last_parent and leap > max(
            _LEAP_M, _FASTEST_M_S * abs(stamp - last_stamp) / 1e9
        ):
            self.leaps_m[child] = max(leap, self.leaps_m.get(child, 0.0))


def listen_to_transforms(context: Context, seconds: float) -> TfTraffic:
    """Subscribe to /tf and /tf_static for so many seconds."""
    heard: list[tuple[bytes, bytes, bool]] = []
    node = context.create_node("_turtlewire_doctor_listener")
    kind = TypeId(_TYPE, msg.type_hash(_TYPE))
    for topic, durability in (
        ("/tf", Durability.VOLATILE),
        ("/tf_static", Durability.TRANSIENT_LOCAL),
    ):

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
