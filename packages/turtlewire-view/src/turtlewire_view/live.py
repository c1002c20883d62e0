"""The network as a source: frames from ``/tf`` and ``/tf_static``, messages of any topic."""

from __future__ import annotations

import copy
import os
import threading
import time
from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, cast

from turtlewire import msg, wire
from turtlewire.errors import WireError
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.listener import NOTHING_RECEIVED, TransformListener
from turtlewire.tf.restarts import RestartWatch
from turtlewire.tf.tf_topics import TfTopics
from turtlewire.wire.base import TypeId
from turtlewire.wire.names import validate_namespace
from turtlewire.wire.qos import Durability, QoS, Reliability, fit_subscription
from turtlewire_view.service_watch import ParameterWatch, ServiceWatch
from turtlewire_view.source import (
    ParameterAnswer,
    ServiceAnswer,
    ServiceCalls,
    TimelineState,
    Topic,
    no_service,
)

if TYPE_CHECKING:
    from turtlewire.wire import base

__all__ = [
    "MAX_FRAMES",
    "HasHistory",
    "LiveSource",
    "LiveTimeline",
    "frames_left_out",
    "newest_stamp_ns",
    "stamp_range_ns",
]

#: How much history the page can go back to: longer than the ten seconds of tf2, for a lesson
#: explains what happened before.
_HISTORY_NS = 60 * 10**9
#: Robots have a few hundred frames. With 5,000, the server uses a fifth of a core for each page.
MAX_FRAMES = 5_000
#: Smaller stamps are simulated time, not system time [ns].
_WALL_TIME_FROM_NS = 10**18
_TOPICS = TfTopics()
_NODE_NAME = "turtlewire_view_{}"
_DEPTH = 100
#: Publishers of the tools; the one that was used longest ago ends for another.
_MOST_PUBLISHERS = 16


class LiveSource:
    """The live frames and messages of this process's domain.

    Args:
        context: The participant to use; None joins the domain of the environment.
        history_ns: How long samples of frames are kept.
        max_frames: How many frames are shown; the page says when there are more. None: no limit.
        topics: Where the transforms are published.

    Raises:
        WireError: The network cannot be joined.
    """

    kind = "live"
    joints = None

    def __init__(
        self,
        context: base.Context | None = None,
        *,
        history_ns: int = _HISTORY_NS,
        max_frames: int | None = MAX_FRAMES,
        topics: TfTopics = _TOPICS,
    ) -> None:
        self._own_context = wire.open_context() if context is None else None
        self._context = context or cast("base.Context", self._own_context)
        self.name = f"ROS_DOMAIN_ID {self._context.domain_id}"
        self.history_ns = history_ns
        self.buffer = Buffer(history_ns, max_frames)
        self.buffer._hint_if_empty = NOTHING_RECEIVED
        self._restarts = RestartWatch(self.buffer)
        self._changed: Callable[[], None] = _nothing
        self._lock = threading.Lock()
        self._subscriptions: set[_FittedSubscription] = set()
        self._publishers: dict[tuple[str, str], base.Publisher] = {}
        self._node = self._context.create_node(_NODE_NAME.format(os.getpid()))
        self._listener = TransformListener(
            self.buffer,
            self._node,
            context=self._context,
            topic=topics.moving,
            static_topic=topics.static,
        )
        self._ends = [
            self.buffer.on_change(self._tell),
            self._context.graph.add_listener(self._take_graph),
        ]

    @property
    def problem(self) -> str:
        """Says that more frames or topics are there than are shown; empty if all are shown."""
        with self._lock:
            faults = [each.problem for each in self._subscriptions]
        return " ".join(filter(None, (frames_left_out(self.buffer), *faults)))

    def now_ns(self) -> int:
        """System time; of a simulation, the newest stamp."""
        newest = newest_stamp_ns(self.buffer)
        return time.time_ns() if newest is None or newest >= _WALL_TIME_FROM_NS else newest

    def departed_frames(self) -> list[str]:
        """Return the moving frames whose publisher has left the graph."""
        return self._listener.departed_frames()

    def new_timeline(self) -> LiveTimeline:
        """Return a page's own time, which follows the wire until the page is paused."""
        return LiveTimeline(self)

    def topics(self) -> list[Topic]:
        """Return all topics of the graph."""
        endpoints = self._context.graph.endpoints()
        counts = Counter(
            (each.topic, each.type_name) for each in endpoints if each.kind == "publisher"
        )
        named = self._context.graph.topic_names_and_types()
        return [
            Topic(name, type_name, counts[name, type_name])
            for name, type_names in sorted(named.items())
            for type_name in type_names
        ]

    def subscribe(
        self, topic: str, type_name: str, on_message: Callable[[bytes], None]
    ) -> Callable[[], None]:
        """Subscribe with the QoS that fits all publishers, also those that come later."""
        subscription = _FittedSubscription(self._context, self._node, topic, type_name, on_message)
        with self._lock:
            self._subscriptions.add(subscription)

        def end() -> None:
            with self._lock:
                self._subscriptions.discard(subscription)
            subscription.close()

        return end

    def ask_parameter(
        self, node: str, name: str, on_answer: Callable[[ParameterAnswer], None]
    ) -> Callable[[], None]:
        """Ask the node's parameter service."""
        # The name of a node with its namespace has the form of a namespace.
        if fault := validate_namespace(node):
            problem = f"{node!r} is not the name of a node: {fault.message}"
            on_answer(ParameterAnswer(problem=problem))
            return _nothing
        return ParameterWatch(self._context, self._node, node, name, on_answer).close

    def ask_service(
        self, name: str, type_name: str, on_answer: Callable[[ServiceAnswer], None]
    ) -> ServiceCalls:
        """Call the service of the network."""
        # The name of a service has the form of a namespace.
        if fault := validate_namespace(name):
            problem = f"{name!r} is not the name of a service: {fault.message}"
            return no_service(problem, on_answer)
        request = msg.serialize(msg.get_service(type_name).Request())
        return ServiceWatch(
            self._context,
            self._node,
            name,
            type_name,
            request,
            on_answer,
            absent=lambda: f"no server offers the service {name}",
        )

    def advertise(self, topic: str, type_name: str) -> None:
        """Create the publisher of a topic."""
        self._publisher(topic, type_name)

    def publish(self, topic: str, type_name: str, cdr: bytes) -> int:
        """Send a message, and give how many subscriptions there are.

        The publisher stays for the next message.
        """
        self._publisher(topic, type_name).publish(cdr)
        return len(self._context.graph.endpoints_of(topic, "subscription"))

    def _publisher(self, topic: str, type_name: str) -> base.Publisher:
        with self._lock:
            publisher = self._publishers.pop((topic, type_name), None)
            if publisher is None:
                identity = TypeId(type_name, msg.type_hash(type_name))
                publisher = self._node.create_publisher(topic, identity, QoS())
            self._publishers[topic, type_name] = publisher
            while len(self._publishers) > _MOST_PUBLISHERS:
                self._publishers.pop(next(iter(self._publishers))).close()
        return publisher

    def on_change(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on the wire's reader thread."""
        self._changed = call

    def drop_old_timeline(self) -> None:
        """Clear the buffer when a simulation or a bag has started again."""
        self._restarts.look()

    def close(self) -> None:
        """Leave the wire."""
        for end in self._ends:
            end()
        self._listener.close()
        self._node.close()
        if self._own_context is not None:
            self._own_context.close()

    def _tell(self) -> None:
        self._changed()

    def _take_graph(self) -> None:
        with self._lock:
            subscriptions = list(self._subscriptions)
        for subscription in subscriptions:
            subscription.fit()
        self._changed()


class HasHistory(Protocol):
    """A source whose buffer grows."""

    @property
    def buffer(self) -> Buffer:
        """The buffer with the frames."""
        ...

    @property
    def history_ns(self) -> int:
        """Length of the history before the newest stamp that a page can show."""
        ...


class LiveTimeline:
    """Follows the source; while paused, a copy of the buffer stays as it was."""

    def __init__(self, source: HasHistory) -> None:
        self._source = source
        self._lock = threading.Lock()
        self._kept: Buffer | None = None
        self._stamp_ns: int | None = None

    @property
    def buffer(self) -> Buffer:
        """Shown buffer: the source's, or its copy."""
        return self._kept or self._source.buffer

    def stamp_ns(self) -> int | None:
        """The time that the page shows; None while it follows the source."""
        return self._stamp_ns

    def state(self) -> TimelineState:
        """Return the history that there is."""
        with self._lock:
            oldest, newest = self._range()
            live = self._kept is None
            now = newest if self._stamp_ns is None else self._stamp_ns
        simulated = newest < _WALL_TIME_FROM_NS
        return TimelineState(now / 1e9, oldest / 1e9, newest / 1e9, live, live, 1.0, simulated)

    def pause(self) -> None:
        """Keep what there is; new data does not change the picture."""
        with self._lock:
            if self._kept is None:
                self._kept = copy.copy(self._source.buffer)
                self._stamp_ns = newest_stamp_ns(self._kept)

    def play(self) -> None:
        """Follow the source again."""
        with self._lock:
            self._kept, self._stamp_ns = None, None

    def seek(self, stamp_ns: int) -> None:
        """Pause, and show this time."""
        self.pause()
        with self._lock:
            oldest, newest = self._range()
            self._stamp_ns = min(max(stamp_ns, oldest), newest)

    def set_speed(self, factor: float) -> None:
        """Live data has only one speed."""

    def _range(self) -> tuple[int, int]:
        """Return the times that the page can show, without transforms that ended long ago."""
        oldest, newest = stamp_range_ns(self.buffer) or (0, 0)
        return max(oldest, newest - self._source.history_ns), newest


class _FittedSubscription:
    """A subscription whose QoS follows the publishers.

    Attributes:
        problem: Why it does not; empty if it does.
    """

    def __init__(
        self,
        context: base.Context,
        node: base.Node,
        topic: str,
        type_name: str,
        on_message: Callable[[bytes], None],
    ) -> None:
        self._graph, self._node = context.graph, node
        self._topic, self._type = topic, TypeId(type_name, msg.type_hash(type_name))
        self._on_message = on_message
        self._lock = threading.Lock()
        self._closed = False
        self.problem = ""
        self._qos = self._fitting()
        self._subscription = self._subscribe(self._qos)

    def fit(self) -> None:
        """Subscribe again if the publishers offer something else now."""
        with self._lock:
            qos = self._fitting()
            if self._closed or qos == self._qos:
                return
            try:
                fitted = self._subscribe(qos)
            except WireError as error:  # the next change of the graph is another attempt
                self.problem = f"{self._topic} may not be shown: {error.in_one_line()}"
                return
            self._subscription.close()
            self._subscription, self._qos, self.problem = fitted, qos, ""

    def close(self) -> None:
        with self._lock:
            self._closed = True
            self._subscription.close()

    def _subscribe(self, qos: QoS) -> base.Subscription:
        return self._node.create_subscription(
            self._topic, self._type, qos, lambda cdr, _: self._on_message(cdr)
        )

    def _fitting(self) -> QoS:
        offered = [endpoint.qos for endpoint in self._graph.endpoints_of(self._topic, "publisher")]
        wanted = QoS(
            depth=_DEPTH,
            reliability=Reliability.BEST_AVAILABLE,
            durability=Durability.BEST_AVAILABLE,
        )
        # Without publishers, the strictest QoS would not match weaker publishers.
        return fit_subscription(wanted, offered or [QoS(reliability=Reliability.BEST_EFFORT)])


def newest_stamp_ns(buffer: Buffer) -> int | None:
    """Return the newest stamp of a link that is not static."""
    found = stamp_range_ns(buffer)
    return None if found is None else found[1]


def frames_left_out(buffer: Buffer) -> str:
    """Return the sentence about a buffer with more frames than are shown; empty if all are."""
    if not buffer.is_full:
        return ""
    return (
        f"There are more than {buffer.max_frames} frames; further ones are not shown. "
        "(turtlewire view --max-frames N)"
    )


def stamp_range_ns(buffer: Buffer) -> tuple[int, int] | None:
    """Return the oldest and the newest stamp of links that are not static."""
    moving = [link for link in buffer.links() if link.samples and not link.static]
    if not moving:
        return None
    return min(link.oldest_ns for link in moving), max(link.newest_ns for link in moving)


def _nothing() -> None:
    pass
