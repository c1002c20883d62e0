"""The contract of a middleware: bytes in, bytes out, QoS, names and the graph. No messages.

A middleware implements the abstract classes below; the code above it (rclpy, the TF listener, the
command line) uses only these. Topic and service names are fully qualified ROS names
(``/turtle1/pose``); a middleware mangles them itself. ``cdr`` always means a serialized message
with its four encapsulation bytes (``00 01 00 00``).

Threading: every method may be called from any thread. :meth:`WaitSet.wait` blocks without the GIL.
A subscription that was made with ``on_message`` is served by the context's own reader thread, which
the context starts, owns and joins in :meth:`Context.close`; all other entities are polled by their
owner after a :class:`WaitSet` reports them ready.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from .records import (
    EndpointInfo,
    EventKind,
    EventStatus,
    ForeignServer,
    MessageInfo,
    NodeInfo,
    RequestId,
    ServiceTypes,
    TypeId,
)

if TYPE_CHECKING:
    from .encapsulation import Cdr
    from .qos import QoS

__all__ = [
    "Client",
    "Context",
    "EndpointInfo",
    "Entity",
    "Event",
    "EventKind",
    "EventStatus",
    "ForeignServer",
    "Graph",
    "MessageInfo",
    "Node",
    "NodeInfo",
    "Outlet",
    "Publisher",
    "RequestId",
    "Service",
    "ServiceTypes",
    "Sink",
    "Subscription",
    "TypeId",
    "WaitSet",
    "Waitable",
]


class Entity(ABC):
    """Something with a lifetime on the wire.

    Waitable ones can be attached to a :class:`WaitSet`.
    """

    @abstractmethod
    def close(self) -> None:
        """Leave the wire. Idempotent; returns without waiting for other parties.

        In a forked child it does nothing: the middleware would wait for threads that only the
        parent has.
        """


class Event(Entity):
    """Reports one kind of event of one publisher or subscription.

    Waitable (ready: it happened since the last :meth:`take`).
    """

    kind: EventKind

    @abstractmethod
    def take(self) -> EventStatus | None:
        """The counters, or None if nothing happened since the last call (or since the creation)."""


class Sink(Protocol):
    """Native code that takes the messages of a subscription on the middleware's own threads.

    It is a ``turtlewire::Sink`` (``native/feeds/middleware.hpp``). When its ``receive`` returns
    true, the middleware's reader thread calls :meth:`serve` until nothing is left, or the
    subscription without ``on_message`` becomes ready, and its ``take`` calls :meth:`serve`.
    """

    def serve(self, gid_of: Callable[[int], bytes]) -> list[tuple[bytes, int, int]]:
        """Do what needs Python after messages were received.

        Args:
            gid_of: Returns the gid of a publisher from the middleware's number of it; empty if it
                is not known.

        Returns:
            Messages for Python to deliver: bytes, number of the publisher, time of sending in ns.
            The sink takes new messages itself only after a call that returned none.
        """
        ...


class Outlet(Protocol):
    """Native code that sends messages: ``turtlewire::Outlet`` (``native/feeds/middleware.hpp``)."""


class Publisher(Entity):
    """Writes messages of one type to one topic."""

    topic: str
    gid: bytes

    @abstractmethod
    def publish(self, cdr: Cdr) -> None:
        """Send one message. Its buffers may change as soon as this returns.

        Raises:
            WireError: The middleware refused it (closed, or blocked for longer than its limit).
        """

    def outlet(self) -> Outlet | None:
        """Return the sender for native code; None if the middleware has none.

        It may be used for longer than the publisher lives. It blocks only if the publisher keeps
        all messages.
        """
        return None

    @abstractmethod
    def subscription_count(self) -> int:
        """Return the number of matching subscriptions that are known now."""

    def is_heard(self) -> bool:
        """Return True if a message may have a receiver; cheaper than :meth:`subscription_count`.

        Never False while a matching subscription is known; may be True for a moment after the last
        one has left.
        """
        return self.subscription_count() > 0

    @abstractmethod
    def create_event(self, kind: EventKind) -> Event:
        """Return the event of this kind (one per kind and endpoint); it closes with the endpoint.

        As in ROS 2, a middleware may accept an event that it never reports; `Context.events` has
        those that it does report.

        Raises:
            WireError: The middleware cannot report it.
        """

    @abstractmethod
    def assert_liveliness(self) -> None:
        """Say that this publisher is alive (for ``MANUAL_BY_TOPIC``; publishing says it too)."""

    @abstractmethod
    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:
        """Block until all reliable subscriptions have received all published messages.

        False if the timeout passes first.
        """


class Subscription(Entity):
    """Receives messages of one topic. Waitable (ready: messages can be taken)."""

    topic: str

    @abstractmethod
    def take(self, limit: int = 32) -> list[tuple[bytes, MessageInfo]]:
        """Take up to ``limit`` waiting messages, oldest first.

        The list is empty if no messages are waiting.
        """

    @abstractmethod
    def publisher_count(self) -> int:
        """Return the number of matching publishers that are known now."""

    @abstractmethod
    def create_event(self, kind: EventKind) -> Event:
        """Return the event of this kind (one per kind and endpoint); it closes with the endpoint.

        Raises:
            WireError: The middleware cannot report it.
        """


class Client(Entity):
    """Sends requests to a service. Waitable (ready: responses can be taken).

    Attributes:
        service: Fully qualified ROS name.
        client_id: What :class:`RequestId` says of its requests.
    """

    service: str
    client_id: int

    @abstractmethod
    def send_request(self, cdr: bytes) -> int:
        """Send a request; its sequence number comes back with the response.

        Raises:
            UncallableServiceError: A server would misread the request, so it is not sent (see
                :meth:`Graph.foreign_servers`).
            WireError: The middleware refused it.
        """

    @abstractmethod
    def take(self, limit: int = 32) -> list[tuple[int, bytes]]:
        """Take up to ``limit`` responses to this client as ``(sequence_number, cdr)``."""

    @abstractmethod
    def is_ready(self) -> bool:
        """Return True if a server is available that receives requests and can answer them."""


class Service(Entity):
    """Answers requests. Waitable (ready: requests can be taken)."""

    service: str

    @abstractmethod
    def take(self, limit: int = 32) -> list[tuple[RequestId, bytes]]:
        """Take up to ``limit`` waiting requests, oldest first."""

    @abstractmethod
    def send_response(self, request_id: RequestId, cdr: bytes) -> None:
        """Answer a request. A client that has disappeared is not an error."""


Waitable = Subscription | Client | Service | Event
"""What can be attached to a :class:`WaitSet`."""


class WaitSet(Entity):
    """Waits for several entities at once. One thread waits at a time.

    Any thread may attach, detach and wake.
    """

    @abstractmethod
    def attach(self, entity: Waitable) -> None:
        """Include an entity in this and later waits."""

    @abstractmethod
    def detach(self, entity: Waitable) -> None:
        """Exclude an entity. Closing it detaches it as well."""

    @abstractmethod
    def wait(self, timeout_ns: int | None = None) -> list[Entity]:
        """Block until an attached entity is ready, :meth:`wake` is called, or the timeout passes.

        Args:
            timeout_ns: None and centuries wait forever, 0 and less look once.

        Returns:
            The ready entities, empty after a wake-up or at the end of the time. An entity stays
            ready until all of its data is taken (level-triggered). With DDS, one can be ready
            without data: when the last peer that sent to it is missed. A wake-up without a
            waiting thread ends the next wait at once.
        """

    @abstractmethod
    def wake(self) -> None:
        """End the current or the next :meth:`wait`.

        Safe from any thread and from a signal's helper thread.
        """

    def native_waker(self) -> tuple[int, int] | None:
        """Return what :meth:`wake` calls: the address of a C function, and the guard it takes.

        Native code wakes the waiting thread with it; None if only Python can.
        """
        return None


class Node(Entity):
    """A named member of the graph that owns endpoints. Closing it closes them.

    The methods that create one raise a WireError if the name is not valid, or the node or its
    context is closed.
    """

    name: str
    namespace: str

    @abstractmethod
    def create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        """Announce and return a publisher of ``topic``.

        It is a fully qualified ROS name, or any with QoS ``avoid_ros_namespace_conventions``.
        """

    @abstractmethod
    def create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
        sink: Sink | None = None,
    ) -> Subscription:
        """Announce and return a subscription.

        Args:
            topic: As for a publisher.
            type_id: What to match.
            qos: What is requested.
            on_message: When given, the context's reader thread calls it for every message, and the
                subscription cannot be attached to a wait set. It must be short. If it raises, the
                exception is reported once, and the next message is delivered. What still waits when
                the subscription closes is not delivered.
            sink: It may get the messages first, without Python and on any thread of the
                middleware; those that it leaves go to ``on_message``, or are taken. A middleware
                is free to do without it.
        """

    @abstractmethod
    def create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        """Announce and return a client of ``service`` (a fully qualified ROS name)."""

    @abstractmethod
    def create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        """Announce and return the server of ``service`` (a fully qualified ROS name)."""


class Graph(ABC):
    """The nodes and endpoints that this process has discovered, and its own."""

    @abstractmethod
    def nodes(self) -> list[NodeInfo]:
        """Return all known nodes, duplicates (two nodes of one name) included."""

    @abstractmethod
    def endpoints(self) -> list[EndpointInfo]:
        """All known endpoints, services' included (as ``rq/…`` names unless asked below)."""

    @abstractmethod
    def endpoints_of(self, topic: str, kind: str) -> list[EndpointInfo]:
        """Return the endpoints of one topic, named as in :meth:`endpoints`.

        Args:
            topic: Name of the topic.
            kind: ``"publisher"`` or ``"subscription"``.
        """

    @abstractmethod
    def topic_names_and_types(self, *, demangle: bool = True) -> dict[str, list[str]]:
        """Topic name to sorted type names.

        Services hidden and names demangled unless ``demangle`` is False.
        """

    @abstractmethod
    def service_names_and_types(self) -> dict[str, list[str]]:
        """Service name to sorted type names (``turtlesim/srv/Spawn``)."""

    def foreign_servers(self) -> list[ForeignServer]:
        """Return the servers that would misread requests of this process, so that it sends none.

        A service that has such a server is not called at all, even if another server of it
        understands requests: a request reaches all servers.
        """
        return []

    def middlewares(self) -> dict[str, int]:
        """Return the middlewares of the other ROS participants that are known, with their numbers.

        It is empty for a middleware that meets no others.
        """
        return {}

    @abstractmethod
    def wait_for(self, predicate: Callable[[], bool], timeout_ns: int | None = None) -> bool:
        """Block until ``predicate()`` is true; test it at once and after every change of the graph.

        Args:
            predicate: Called without locks held, on the calling thread.
            timeout_ns: As in :meth:`WaitSet.wait`.

        Returns:
            The last value of the predicate. Closing the context ends the wait.
        """

    @abstractmethod
    def is_complete(self) -> bool:
        """Return True if everything on this host is known.

        Its participants, if the system reports their number, and what they announced.

        Of participants on other hosts that are not known yet it says nothing.
        """

    @abstractmethod
    def hurry(self) -> None:
        """Query peers that have not announced anything, instead of waiting for them to repeat.

        It is for short-lived programs: with nodes on Fast DDS, the graph is complete in a few
        dozen milliseconds instead of four seconds, but every process of the domain sees a
        participant come and go.
        """

    @abstractmethod
    def add_listener(self, on_change: Callable[[], None]) -> Callable[[], None]:
        """Call ``on_change`` on the context's reader thread after changes.

        If it raises, the exception is reported, and the other listeners are called.

        Returns a function that ends it.
        """


class Context(ABC):
    """One participant of a domain. A process normally has one.

    Attributes:
        domain_id: The domain.
        gid: 16 bytes.
        events: The kinds of events that its endpoints can report. Without ``INCOMPATIBLE_QOS``,
            endpoints of one topic and type match whatever their QoS.
    """

    domain_id: int
    gid: bytes
    events: frozenset[EventKind]

    @property
    @abstractmethod
    def graph(self) -> Graph:
        """The graph as this participant sees it; discovery of it starts at the first use."""

    @abstractmethod
    def create_node(self, name: str, namespace: str = "/") -> Node:
        """Announce a node, in the enclave of the context."""

    @abstractmethod
    def create_wait_set(self) -> WaitSet:
        """Return a new, empty wait set."""

    @abstractmethod
    def call_when_ready(self, entity: Waitable, call: Callable[[], None]) -> Callable[[], None]:
        """Call ``call()`` once, when a subscription, client or service has something to take.

        It is called at once if there is something already, on any thread, perhaps with locks held:
        it may only wake a thread, and must not raise. Use it to wait without a separate thread.

        Args:
            entity: What to wait for. It has one such call at a time.
            call: What to call.

        Returns:
            A function that takes the call back; call it before the entity is closed.

        Raises:
            WireError: The entity or the context is closed.
        """

    @abstractmethod
    def call_soon(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on the context's reader thread, unless the context closes before.

        If it raises, the exception is reported, and the thread goes on.

        Takes no lock that this thread may hold already, so a finalizer may use it.
        """

    @abstractmethod
    def close(self) -> None:
        """Close everything, end the reader thread and all waits, and join. Idempotent.

        Always returns.
        """
