"""Fills buffers from the wire.

The bytes of each ``TFMessage`` go into the buffer as they are, on a thread of the wire.

No message object or executor is involved, so a lookup may wait for data wherever it is called. All
buffers of one context that listen to a topic share one subscription, and each keeps its own data.
With the compiled core, Python only looks up the name of each publisher once and handles malformed
messages: native code, an ``Intake``, stores all others.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakKeyDictionary

from turtlewire import msg, wire
from turtlewire.errors import CdrError, WireError
from turtlewire.guarded import call_guarded
from turtlewire.tf.buffer import CORE, Buffer
from turtlewire.tf.publishers import DepartureWatch, PublisherNames, departed_frames
from turtlewire.tf.refusal_warnings import RefusalWarnings
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, History, QoS
from turtlewire.wire.report import warn_once

if TYPE_CHECKING or CORE == "native":
    from turtlewire._native import Intake

if TYPE_CHECKING:
    from typing import Protocol

    from turtlewire.tf.publishers import Forgetful
    from turtlewire.wire import base

    class Store(Forgetful, Protocol):
        """The part of :class:`turtlewire.Buffer` that a listener needs."""

        def add_tf_message(
            self, cdr: bytes, *, static: bool = False, sender: str = "default_authority"
        ) -> int:
            """Store the transforms of a serialized ``TFMessage``."""
            ...

        def _rename_sender(self, name: str, shown: str) -> None:
            """Show another name for a sender."""
            ...


__all__ = [
    "NOTHING_RECEIVED",
    "QOS",
    "STATIC_QOS",
    "STATIC_TOPIC",
    "TOPIC",
    "TYPE_NAME",
    "TransformListener",
    "new_node_name",
]

#: The topic of transforms that change.
TOPIC = "/tf"
#: The topic of static transforms, latched for late joiners.
STATIC_TOPIC = "/tf_static"
TYPE_NAME = "tf2_msgs/msg/TFMessage"
QOS = QoS(depth=100)
STATIC_QOS = QoS(depth=100, durability=Durability.TRANSIENT_LOCAL)
#: The hint of lookups in a buffer that a network fills, before the first transform.
NOTHING_RECEIVED = (
    "No transform has arrived yet. Is a program that sends transforms running in the same domain?"
)


class _Member(NamedTuple):
    node: base.Node
    graph: base.Graph
    store: Store


class _Arrivals:
    """Tells listeners of the next message of a channel, after it was stored. Thread-safe.

    With an intake, native code stores and counts most messages.

    Attributes:
        counted: The number of the other messages.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._calls: dict[Callable[[], None], None] = {}
        self.counted = 0

    def add(self, call: Callable[[], None]) -> None:
        """Call ``call()`` after messages from now on."""
        with self._lock:
            self._calls[call] = None

    def discard(self, call: Callable[[], None]) -> None:
        """Undo :meth:`add`."""
        with self._lock:
            self._calls.pop(call, None)

    def count(self, messages: int = 1) -> None:
        """Count messages that native code does not count (any more)."""
        with self._lock:
            self.counted += messages
        self.tell()

    def tell(self) -> None:
        """Call all listeners."""
        with self._lock:
            calls = list(self._calls)
        # Without the lock: a call may take any other lock.
        for call in calls:
            call_guarded(call)


class _Feed:
    """Hands the bytes of a message, with the publisher's name, to all members.

    The subscription calls it on the reader thread.

    Attributes:
        intake: Does the same without Python, once it knows the publisher's name; None with the
            plain-Python core.
    """

    def __init__(
        self,
        members: tuple[_Member, ...],
        topic: str,
        qos: QoS,
        *,
        static: bool,
        arrivals: _Arrivals,
        refusal_warnings: RefusalWarnings,
    ) -> None:
        self._refusal_warnings = refusal_warnings
        self._topic = topic
        self._static = static
        self._arrivals = arrivals
        self.intake = self._make_intake(qos) if CORE == "native" else None
        self.members = members
        self._publishers = PublisherNames(members[0].graph, self._rename)

    @property
    def members(self) -> tuple[_Member, ...]:
        """Members whose buffers are filled."""
        return self._members

    @members.setter
    def members(self, members: tuple[_Member, ...]) -> None:
        self._members = members
        if self.intake is not None:
            # With any other store among them, Python fills all, so that each message takes one
            # path.
            buffers = tuple(member.store for member in members if type(member.store) is Buffer)
            self.intake.feed(buffers if len(buffers) == len(members) else ())

    def __call__(self, cdr: bytes, info: base.MessageInfo) -> None:
        publisher = self._publishers[info.publisher_gid]
        for member in self._members:
            self._store(member.store, cdr, publisher)
        self._arrivals.count()

    def _make_intake(self, qos: QoS) -> Intake:
        return Intake(self._static, _most_kept(qos), self._identify, self._tell)

    def _tell(self) -> None:
        """Tell of an expected message, or warn of one that a buffer refused."""
        for member in self._members:
            self._refusal_warnings.look(member.store)
        self._arrivals.tell()

    def _identify(self, publisher: int, gid_of: Callable[[int], bytes]) -> tuple[bytes, str]:
        """Gid and name of a publisher that the intake does not know; the gid may be empty."""
        gid = gid_of(publisher)
        return gid, self._publishers[gid] if gid else ""

    def _store(self, store: Store, cdr: bytes, publisher: str) -> None:
        try:
            store.add_tf_message(cdr, static=self._static, sender=publisher)
            self._refusal_warnings.look(store)
        except CdrError as error:  # the store has counted it
            warn_once(
                f"malformed {self._topic}",
                f"a message on {self._topic} was lost: {error} (publisher: {publisher})",
            )

    def _rename(self, gid: str, name: str) -> None:
        if self.intake is not None:
            self.intake.name(bytes.fromhex(gid), name)
        for member in self._members:
            member.store._rename_sender(gid, name)

    def close(self) -> None:
        """Let go of the graph and of the members."""
        self._publishers.close()
        self.members = ()
        # The intake's own count ends with it; the total must not fall.
        self._arrivals.count(0 if self.intake is None else self.intake.stored())


def _most_kept(qos: QoS) -> int:
    """Return the number of messages a subscription keeps while the reader thread is busy."""
    return 0 if qos.history == History.KEEP_ALL else qos.depth


class _Channel:
    """A subscription that fills several buffers. It belongs to the node of the first one.

    Attributes:
        arrivals: Reports its messages.
    """

    def __init__(self, topic: str, qos: QoS, *, static: bool) -> None:
        self._topic = topic
        self._qos = qos
        self._static = static
        self._latched = qos.durability == Durability.TRANSIENT_LOCAL
        self._lock = threading.Lock()
        self.arrivals = _Arrivals()
        self._refusal_warnings = RefusalWarnings(topic)
        self._feed: _Feed | None = None
        self._subscription: base.Subscription | None = None

    def join(self, member: _Member) -> None:
        """Feed one more buffer from now on."""
        with self._lock:
            members = (*(self._feed.members if self._feed else ()), member)
            # What publishers keep for late joiners comes once, at the start of a subscription: a
            # newcomer needs a new one.
            if self._feed is None or self._latched:
                self._subscribe(members)
            else:
                self._feed.members = members

    def total(self) -> int:
        """Return the number of messages so far."""
        feed = self._feed
        intake = None if feed is None else feed.intake
        return self.arrivals.counted + (0 if intake is None else intake.stored())

    def expect(self, waker: tuple[int, int] | None) -> int:
        """Let native code report the next message that it stores; return :meth:`total`."""
        feed = self._feed
        intake = None if feed is None else feed.intake
        if intake is None:
            return self.arrivals.counted
        if waker is None:
            intake.expect()
            return self.total()
        return self.arrivals.counted + intake.expect_waking(*waker)

    def leave(self, member: _Member) -> None:
        """Feed one buffer less; the last one ends the subscription."""
        with self._lock:
            assert self._feed is not None
            assert self._subscription is not None
            former = self._feed.members
            self._feed.members = tuple(other for other in former if other is not member)
            if not self._feed.members:
                self._subscription.close()
                self._feed.close()
                self._subscription = self._feed = None
            elif member is former[0]:
                self._move_subscription(self._feed.members)

    def _move_subscription(self, members: tuple[_Member, ...]) -> None:
        """Subscribe with the first node that is open; that of the former subscription is closing.

        Without one, the whole context is closed, and nothing more comes.
        """
        for first in range(len(members)):
            with suppress(WireError):
                self._subscribe(members[first:] + members[:first])
                return

    def _subscribe(self, members: tuple[_Member, ...]) -> None:
        """Begin a subscription of the first member's node in place of the former one.

        A former latched one ends first: what it still had on the way is older than what the new one
        brings again, and must not come after it. Otherwise it ends last, for what came in between
        would be lost; a transform that comes twice is stored once.
        """
        former, former_feed = self._subscription, self._feed
        if former is not None and self._latched:
            former.close()
        self._feed = _Feed(
            members,
            self._topic,
            self._qos,
            static=self._static,
            arrivals=self.arrivals,
            refusal_warnings=self._refusal_warnings,
        )
        type_id = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
        try:
            self._subscription = members[0].node.create_subscription(
                self._topic, type_id, self._qos, self._feed, self._feed.intake
            )
        except BaseException:
            self._feed.close()
            self._feed = former_feed
            raise
        if former is not None and not self._latched:
            former.close()
        if former_feed is not None:
            former_feed.close()


class _Channels:
    """All channels of this process."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._of_context: WeakKeyDictionary[base.Context, dict[tuple[str, QoS, bool], _Channel]] = (
            WeakKeyDictionary()
        )

    def get(self, context: base.Context, topic: str, qos: QoS, *, static: bool) -> _Channel:
        """Return the channel of a topic, made when it is asked for first."""
        with self._lock:
            channels = self._of_context.setdefault(context, {})
            return channels.setdefault((topic, qos, static), _Channel(topic, qos, static=static))


_channels = _Channels()


def new_node_name() -> str:
    """Return a node name for a listener that no other process has, as in ROS 2."""
    return f"transform_listener_impl_{os.urandom(6).hex()}"


class TransformListener:
    """Keeps a buffer filled until it is closed; also a context manager.

    Args:
        buffer: What to fill.
        node: Whose subscription it is in the graph; close the listener before the node. None makes
            its own node.
        context: The participant that ``node`` belongs to; None joins the domain of the environment.
        topic: Fully qualified name of the topic of changing transforms; None listens to static ones
            only.
        static_topic: Fully qualified name of the topic of static transforms; None leaves them out.
        qos: Of the first subscription.
        static_qos: Of the second one.
        forget_after_ns: Remove a moving frame this long after its publisher has left the graph;
            None keeps it, as tf2 does.

    The authority in the buffer is the publishing node (``/namespace/name``), or the
    publisher's gid in hex while the graph knows none. Messages that are no ``TFMessage`` are
    counted in the buffer (:meth:`turtlewire.Buffer.problems`); the first is warned of.
    """

    def __init__(
        self,
        buffer: Store,
        node: base.Node | None = None,
        *,
        context: base.Context | None = None,
        topic: str | None = TOPIC,
        static_topic: str | None = STATIC_TOPIC,
        qos: QoS = QOS,
        static_qos: QoS = STATIC_QOS,
        forget_after_ns: int | None = None,
    ) -> None:
        if forget_after_ns is not None and forget_after_ns < 0:
            raise ValueError(f"forget_after_ns must not be negative: {forget_after_ns}")
        self._own_context = wire.open_context() if context is None else None
        context = context or self._own_context
        assert context is not None
        self._own_node = context.create_node(new_node_name()) if node is None else None
        node = node or self._own_node
        assert node is not None
        self._member = _Member(node, context.graph, buffer)
        self._lock = threading.Lock()
        self._joined: list[_Channel] = []
        self._calls: list[Callable[[], None]] = []
        self._seen: dict[_Channel, int] = {}
        self._topic = topic
        self._departures: DepartureWatch | None = None
        try:
            for channel in self._wanted(context, topic, static_topic, qos, static_qos):
                # Before joining, which may bring latched messages at once.
                self._seen[channel] = channel.total()
                channel.join(self._member)
                self._joined.append(channel)
            if topic is not None and forget_after_ns is not None:
                self._departures = DepartureWatch(buffer, context.graph, topic, forget_after_ns)
        except BaseException:
            self.close()
            raise

    def departed_frames(self) -> list[str]:
        """Return the moving frames whose publisher has left the graph."""
        if self._topic is None:
            return []
        return departed_frames(self._member.store, self._member.graph, self._topic)

    def on_message(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on a thread of the wire after a message, until the listener is closed.

        Native code calls only after :meth:`expect_message`. A call may come without a message.
        """
        self._calls.append(call)
        for channel in self._seen:
            channel.arrivals.add(call)

    def expect_message(self, waker: tuple[int, int] | None = None) -> bool:
        """Return True if a message was stored since :meth:`take_arrivals`.

        If not, the next one leads to a call of what :meth:`on_message` was given.

        Args:
            waker: What native code does in place of the call where it stores the message; see
                :meth:`turtlewire.wire.base.WaitSet.native_waker`.
        """
        # A message that comes after its channel was asked is reported.
        return {channel: channel.expect(waker) for channel in self._seen} != self._seen

    def take_arrivals(self) -> bool:
        """Return True if a message was stored since the last call."""
        former = self._seen
        self._seen = {channel: channel.total() for channel in former}
        return self._seen != former

    @staticmethod
    def _wanted(
        context: base.Context,
        topic: str | None,
        static_topic: str | None,
        qos: QoS,
        static_qos: QoS,
    ) -> Iterator[_Channel]:
        if topic is not None:
            yield _channels.get(context, topic, qos, static=False)
        if static_topic is not None:
            yield _channels.get(context, static_topic, static_qos, static=True)

    def close(self) -> None:
        """Stop filling the buffer; what is in it stays. Idempotent, callable from any thread."""
        with self._lock:
            joined, self._joined = self._joined, []
        if self._departures is not None:
            self._departures.close()
        for channel in joined:
            for call in self._calls:
                channel.arrivals.discard(call)
            channel.leave(self._member)
        if self._own_node is not None:
            self._own_node.close()
        if self._own_context is not None:
            self._own_context.close()

    def __enter__(self) -> TransformListener:  # noqa: PYI034 -- typing.Self comes with Python 3.11
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()
