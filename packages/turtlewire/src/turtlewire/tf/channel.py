"""The subscriptions that fill buffers; all buffers of one context share that of a topic.

Each message goes into every buffer as bytes. With the compiled core, Python only looks up the name
of each publisher once and handles malformed messages: native code, an ``Intake``, stores all
others.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakKeyDictionary

from turtlewire import msg
from turtlewire.errors import CdrError, WireError
from turtlewire.guarded import call_guarded
from turtlewire.tf.buffer import CORE, Buffer
from turtlewire.tf.publishers import PublisherNames
from turtlewire.tf.refusal_warnings import RefusalWarnings
from turtlewire.tf.tf_topics import TF_TYPE
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


class Member(NamedTuple):
    """A buffer that a listener fills, and the node of the listener."""

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


class Feed:
    """Hands the bytes of a message, with the publisher's name, to all members.

    The subscription calls it on the reader thread.

    Attributes:
        intake: Does the same without Python, once it knows the publisher's name; None with the
            plain-Python core.
    """

    def __init__(
        self,
        members: tuple[Member, ...],
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
    def members(self) -> tuple[Member, ...]:
        """Members whose buffers are filled."""
        return self._members

    @members.setter
    def members(self, members: tuple[Member, ...]) -> None:
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


class Channel:
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
        self._feed: Feed | None = None
        self._subscription: base.Subscription | None = None

    def join(self, member: Member) -> None:
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

    def leave(self, member: Member) -> None:
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

    def _move_subscription(self, members: tuple[Member, ...]) -> None:
        """Subscribe with the first node that is open; that of the former subscription is closing.

        Without one, the whole context is closed, and nothing more comes.
        """
        for first in range(len(members)):
            with suppress(WireError):
                self._subscribe(members[first:] + members[:first])
                return

    def _subscribe(self, members: tuple[Member, ...]) -> None:
        """Begin a subscription of the first member's node in place of the former one.

        A former latched one ends first: what it still had on the way is older than what the new one
        brings again, and must not come after it. Otherwise it ends last, for what came in between
        would be lost; a transform that comes twice is stored once.
        """
        former, former_feed = self._subscription, self._feed
        if former is not None and self._latched:
            former.close()
        self._feed = Feed(
            members,
            self._topic,
            self._qos,
            static=self._static,
            arrivals=self.arrivals,
            refusal_warnings=self._refusal_warnings,
        )
        type_id = TypeId(TF_TYPE, msg.type_hash(TF_TYPE))
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


_lock = threading.Lock()
_channels: WeakKeyDictionary[base.Context, dict[tuple[str, QoS, bool], Channel]] = (
    WeakKeyDictionary()
)


def channel_of(context: base.Context, topic: str, qos: QoS, *, static: bool) -> Channel:
    """Return the one channel of a topic in this process, made when it is asked for first."""
    with _lock:
        channels = _channels.setdefault(context, {})
        return channels.setdefault((topic, qos, static), Channel(topic, qos, static=static))
