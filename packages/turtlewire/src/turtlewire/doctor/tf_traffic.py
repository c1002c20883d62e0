"""Listens to the transforms for a while and records the publisher of each."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.distro import current_distro
from turtlewire.doctor.graph_findings import owner_of
from turtlewire.errors import CdrError
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.faults import refusals
from turtlewire.tf.tf_topics import TfTopics
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS, Reliability

if TYPE_CHECKING:
    from turtlewire.wire.base import Context, EndpointInfo, Graph, MessageInfo

_DEFAULT = TfTopics()
_TYPE = "tf2_msgs/msg/TFMessage"
_CLOCK_TYPE = "rosgraph_msgs/msg/Clock"
#: How long completion listens: transforms are published at 10 Hz and more, static ones are kept for
#: late joiners, and a user does not wait longer for a TAB.
_COMPLETION_NS = 150_000_000
#: Number of consecutive messages that is enough to judge a publisher (0.8 s of the demo's).
_ENOUGH = 50
#: Number of stamps to keep per frame, to find gaps in them.
_STAMPS = 200
#: Backward steps of stamps within a clock's jitter are not a problem.
JITTER_NS = 1_000_000
#: As long as tf2 keeps samples.
_CACHE_NS = 10_000_000_000
#: Reasons of refused transforms that have findings of their own.
_FOUND_OTHERWISE = {"old_data", "self_transform"}
#: A frame leaps if it moves by more than this, and faster than any robot.
LEAP_M = 0.5
FASTEST_M_S = 100.0


class TfTraffic:
    """The received transforms.

    Frames have the names that tf2 stores: it removes one leading slash.

    Attributes:
        topics: Where they were published.
        heard: Gids of the publishers of the received messages, which may be empty.
        written: Name of a frame as it was sent to the gids of its publishers.
        parents: Frame to its parents.
        publishers: Frame to the gids of its publishers.
        newest_ns: Moving frame to its newest stamp.
        stamps_ns: Moving frame and gid of a publisher to their first stamps.
        back_ns: Frame to the largest step back of its stamps; steps of less than a clock's jitter
            do not count.
        leaps_m: Frame to its largest step within its parent that was faster than any robot.
        refused: Frame to tf2's words about the last transform of it that a buffer refuses.
            Stamps that go back and frames in themselves are not among them.
        ended_ns: When the listening ended, system time.
        clock_ns: The newest time of ``/clock``; None if it is not published.
    """

    def __init__(self) -> None:
        self.topics = TfTopics()
        self.heard: set[bytes] = set()
        self.written: dict[str, set[bytes]] = {}
        self.parents: dict[str, set[str]] = {}
        self.publishers: dict[str, set[bytes]] = {}
        self.newest_ns: dict[str, int] = {}
        self.stamps_ns: dict[tuple[str, bytes], list[int]] = {}
        self.back_ns: dict[str, int] = {}
        self.leaps_m: dict[str, float] = {}
        self.refused: dict[str, str] = {}
        self.ended_ns = 0
        self.clock_ns: int | None = None
        self._last: dict[str, tuple[str, int, Any]] = {}

    def note(self, message: Any, publisher: bytes, *, static: bool) -> None:
        """Take over a TFMessage."""
        self.heard.add(publisher)
        for transform in message.transforms:
            names = (transform.header.frame_id, transform.child_frame_id)
            for name in names:
                self.written.setdefault(name, set()).add(publisher)
            parent, child = (name.removeprefix("/") for name in names)
            self.parents.setdefault(child, set()).add(parent)
            self.publishers.setdefault(child, set()).add(publisher)
            if not static:
                stamp = transform.header.stamp.sec * 1_000_000_000 + transform.header.stamp.nanosec
                self.newest_ns[child] = max(stamp, self.newest_ns.get(child, 0))
                stamps = self.stamps_ns.setdefault((child, publisher), [])
                if len(stamps) < _STAMPS:
                    stamps.append(stamp)
                self._note_step(child, parent, stamp, transform.transform.translation)

    def _note_step(self, child: str, parent: str, stamp: int, place: Any) -> None:
        last_parent, last_stamp, last = self._last.get(child, (parent, stamp, place))
        self._last[child] = (parent, stamp, place)
        if last_stamp - stamp > JITTER_NS:
            self.back_ns[child] = max(last_stamp - stamp, self.back_ns.get(child, 0))
        leap = math.dist((place.x, place.y, place.z), (last.x, last.y, last.z))
        if parent == last_parent and leap > max(
            LEAP_M, FASTEST_M_S * abs(stamp - last_stamp) / 1e9
        ):
            self.leaps_m[child] = max(leap, self.leaps_m.get(child, 0.0))


class TfListener:
    """Keeps the transforms that are published from now on.

    Args:
        context: The context to subscribe in, with a node that :meth:`close` removes.
        topics: Where they are published.
    """

    def __init__(self, context: Context, topics: TfTopics = _DEFAULT) -> None:
        self._topics = topics
        self._messages: list[tuple[bytes, bytes, bool]] = []
        self._heard: Counter[bytes] = Counter()
        self._news = threading.Condition()
        self._graph = context.graph
        self._node = context.create_node("_turtlewire_doctor_listener")
        self._clock: bytes | None = None
        self._subscribe_clock()
        self._subscribe(topics.moving, Durability.VOLATILE, static=False)
        self._subscribe(topics.static, Durability.TRANSIENT_LOCAL, static=True)

    def _subscribe(self, topic: str, durability: Durability, *, static: bool) -> None:
        def keep(cdr: bytes, info: MessageInfo) -> None:
            with self._news:
                self._messages.append((cdr, info.publisher_gid, static))
                self._heard[info.publisher_gid] += 1
                self._news.notify_all()

        kind = TypeId(_TYPE, msg.type_hash(_TYPE))
        self._node.create_subscription(topic, kind, QoS(depth=100, durability=durability), keep)

    def _subscribe_clock(self) -> None:
        def keep(cdr: bytes, _: MessageInfo) -> None:
            with self._news:
                self._clock = cdr

        kind = TypeId(_CLOCK_TYPE, msg.type_hash(_CLOCK_TYPE))
        qos = QoS(depth=1, reliability=Reliability.BEST_EFFORT)
        self._node.create_subscription("/clock", kind, qos, keep)

    def wait(self, seconds: float, wanted: Mapping[bytes, int] | None = None) -> None:
        """Listen for a time [s], or until each publisher (gid) has sent a number of messages."""

        def heard_all() -> bool:
            return wanted is not None and all(
                self._heard[publisher] >= count for publisher, count in wanted.items()
            )

        with self._news:
            self._news.wait_for(heard_all, seconds)

    def gather(self, graph: Graph, seconds: float) -> bool:
        """Listen for at most a time [s].

        A static publisher sends all of its transforms at once to a new subscription. Fifty
        messages are enough of the others.

        Returns:
            Whether enough messages have arrived from every publisher.
        """
        publishers = tf_publishers(graph, self._topics)
        at_once = [_sends_at_once(publisher, self._topics) for publisher in publishers]
        wanted = {
            publisher.gid: 1 if known else _ENOUGH
            for publisher, known in zip(publishers, at_once, strict=True)
        }
        self.wait(seconds, wanted)
        return all(at_once)

    def close(self) -> TfTraffic:
        """Unsubscribe, and return the received transforms."""
        self._node.close()
        return self.traffic()

    def traffic(self) -> TfTraffic:
        """Return the traffic received so far."""
        traffic = TfTraffic()
        traffic.topics = self._topics
        traffic.ended_ns = time.time_ns()
        with self._news:
            messages, clock = list(self._messages), self._clock
        traffic.clock_ns = None if clock is None else _time_of(clock)
        buffer = Buffer(_CACHE_NS)
        buffer._follow_tf2(current_distro())
        owners = _owners(self._graph)
        for cdr, publisher, static in messages:
            try:
                message = msg.deserialize(msg.get_message(_TYPE), cdr)
            except CdrError:
                continue  # a foreign publisher on the topic; the check of types names it
            traffic.note(message, publisher, static=static)
            sender = owners.get(publisher, publisher.hex())
            buffer.add_tf_message(cdr, static=static, sender=sender)
        traffic.refused = {
            frame: refused.last
            for frame, refused in sorted(refusals(buffer).items())
            if refused.counts.keys() - _FOUND_OTHERWISE
        }
        return traffic


def _owners(graph: Graph) -> dict[bytes, str]:
    return {end.gid: owner_of(end) for end in graph.endpoints() if end.node is not None}


def _time_of(cdr: bytes) -> int | None:
    """Return the time of a Clock message [ns]; None if a foreign publisher sent something else."""
    try:
        clock: Any = msg.deserialize(msg.get_message(_CLOCK_TYPE), cdr)
    except CdrError:
        return None
    return int(clock.clock.sec * 1_000_000_000 + clock.clock.nanosec)


def tf_publishers(graph: Graph, topics: TfTopics = _DEFAULT) -> list[EndpointInfo]:
    """Return the publishers of moving and of static transforms."""
    return [end for topic in topics for end in graph.endpoints_of(topic, "publisher")]


def _sends_at_once(publisher: EndpointInfo, topics: TfTopics) -> bool:
    """Return True if a new subscription gets all transforms of the publisher."""
    return (
        publisher.topic == topics.static
        and publisher.type_name == _TYPE
        and publisher.qos.durability == Durability.TRANSIENT_LOCAL
    )


def frame_names() -> list[str]:
    """Names of the frames that are published now, for completion.

    A name with control characters is left out: the shell would act on them.
    """
    from turtlewire.wire import open_context

    context = open_context()
    try:
        listener = TfListener(context)
        context.graph.wait_for(context.graph.is_complete, _COMPLETION_NS)
        listener.gather(context.graph, _COMPLETION_NS / 1e9)
        parents = listener.close().parents
    finally:
        context.close()
    names = parents.keys() | {parent for of_child in parents.values() for parent in of_child}
    return sorted(name for name in names if name.isprintable())
