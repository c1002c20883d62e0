"""Rates and values of topics: subscriptions that exist only while a page asks for them.

They are best effort and volatile and keep few messages, so that no publisher waits for them. All
messages are counted, and only the newest is decoded, once for each reading.
"""

from __future__ import annotations

import json
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire import msg
from turtlewire.errors import TurtlewireError
from turtlewire.msg.json_messages import json_value
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS, Reliability

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Graph, MessageInfo, Node, Subscription

__all__ = ["Measuring", "Reading"]

_QOS = QoS(depth=10, reliability=Reliability.BEST_EFFORT)
_WINDOW_NS = 5 * 10**9
#: The most and the fewest messages that a rate covers; the fewest count however old they are.
_MOST, _FEWEST = 5_000, 2
#: Larger messages, such as images, are not shown.
_LARGEST = 20_000
_LATCHED = (
    "The publisher keeps its last messages for late subscribers. This page subscribes as best "
    "effort and does not get them; ros2 topic echo --once shows them."
)


class Reading(NamedTuple):
    """The rate, bandwidth and newest value of a measured topic.

    Attributes:
        rate: Messages a second [Hz]; None before the second message.
        bandwidth: Bytes a second; None before the second message.
        age: How long ago the last message arrived [s]; None without one.
        value: The last message as lines of text; empty without one.
        note: Why something is missing.
    """

    rate: float | None
    bandwidth: float | None
    age: float | None
    value: str
    note: str


class Measuring:
    """Subscribes to the topics that pages measure. For one thread.

    Args:
        graph: Knows the publishers and their types.
        node: Owns the subscriptions.
    """

    def __init__(self, graph: Graph, node: Node) -> None:
        self._graph = graph
        self._node = node
        self._topics: dict[str, _MeasuredTopic] = {}

    def follow(self, topics: set[str]) -> None:
        """Measure these topics, with the types that their publishers have now, and no others."""
        for topic in [name for name in self._topics if name not in topics]:
            self._topics.pop(topic).close()
        for topic in topics:
            if topic not in self._topics:
                self._topics[topic] = _MeasuredTopic(self._node, topic)
            self._topics[topic].fit(self._graph.endpoints_of(topic, "publisher"))

    def readings(self) -> dict[str, dict[str, Any]]:
        """Return the readings of all topics, for ``json.dumps``."""
        return {name: topic.read()._asdict() for name, topic in sorted(self._topics.items())}

    def close(self) -> None:
        """End all subscriptions."""
        self.follow(set())


class _MeasuredTopic:
    """A subscription for each type of a topic, and what they received."""

    def __init__(self, node: Node, topic: str) -> None:
        self._node = node
        self._topic = topic
        self._subscriptions: dict[TypeId, Subscription] = {}
        self._has_publisher = self._is_latched = False
        self._problem = ""
        self._lock = threading.Lock()  # of the next two
        self._arrivals: deque[tuple[int, int]] = deque(maxlen=_MOST)  # time and size
        self._last = ("", b"")  # type and bytes
        self._decoded = (self._last, "", "")

    def fit(self, publishers: list[EndpointInfo]) -> None:
        """Subscribe to the types of these publishers, unless it already has."""
        self._has_publisher = bool(publishers)
        durabilities = {each.qos.durability for each in publishers}
        self._is_latched = durabilities == {Durability.TRANSIENT_LOCAL}
        for type_id in sorted({TypeId(each.type_name, each.type_hash) for each in publishers}):
            if type_id in self._subscriptions:
                continue
            try:
                self._subscriptions[type_id] = self._subscribe(type_id)
            except TurtlewireError as error:
                self._problem = str(error)

    def close(self) -> None:
        for subscription in self._subscriptions.values():
            subscription.close()

    def _subscribe(self, type_id: TypeId) -> Subscription:
        name, type_hash = type_id

        def take(cdr: bytes, info: MessageInfo) -> None:
            """On the wire's thread."""
            with self._lock:
                self._arrivals.append((info.received_timestamp_ns, len(cdr)))
                self._last = name, cdr

        known = TypeId(name, type_hash or msg.type_hash(name))
        return self._node.create_subscription(self._topic, known, _QOS, take)

    def read(self) -> Reading:
        now_ns = time.time_ns()
        with self._lock:
            while len(self._arrivals) > _FEWEST and self._arrivals[0][0] < now_ns - _WINDOW_NS:
                self._arrivals.popleft()
            arrivals, last = list(self._arrivals), self._last
        if not arrivals:
            return Reading(None, None, None, "", self._reason())
        age_s = max(0.0, (now_ns - arrivals[-1][0]) / 1e9)
        value, note = self._text_of(last)
        span_s = (arrivals[-1][0] - arrivals[0][0]) / 1e9
        if span_s <= 0.0:
            return Reading(None, None, age_s, value, note)
        # A topic that has become silent slows down instead of keeping its last rate.
        count = len(arrivals) - 1
        span_s = max(span_s, span_s + age_s - 2 * span_s / count)
        size = sum(size for _, size in arrivals[1:])
        return Reading(count / span_s, size / span_s, age_s, value, note)

    def _reason(self) -> str:
        """Say why there is no message."""
        if not self._has_publisher:
            return "No node publishes this topic."
        return self._problem or (_LATCHED if self._is_latched else "No message yet.")

    def _text_of(self, last: tuple[str, bytes]) -> tuple[str, str]:
        """Return the text of a message, or why it is not shown; a message is decoded once."""
        if last is not self._decoded[0]:
            self._decoded = (last, *_decode(*last))
        return self._decoded[1:]


def _decode(type_name: str, cdr: bytes) -> tuple[str, str]:
    if len(cdr) > _LARGEST:
        return "", f"The message has {len(cdr):,} bytes, too many to show here."
    try:
        message = msg.deserialize(type_name, cdr)
    except TurtlewireError as error:
        return "", f"The message cannot be shown: {error}"
    return "\n".join(_lines(json_value(message), "")), ""


def _lines(value: Any, indent: str) -> list[str]:
    """Return a message as indented lines, much as ``ros2 topic echo`` prints it."""
    lines = []
    items = value.items() if isinstance(value, dict) else (("-", item) for item in value)
    for name, item in items:
        head = f"{indent}{name}" if isinstance(value, list) else f"{indent}{name}:"
        is_nested = isinstance(item, dict) or (
            isinstance(item, list) and any(isinstance(each, dict) for each in item)
        )
        if is_nested and item:
            lines += [head, *_lines(item, indent + "  ")]
        else:
            lines.append(f"{head} {json.dumps(item, ensure_ascii=False)}")
    return lines
