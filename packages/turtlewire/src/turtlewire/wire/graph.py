"""The graph: the common part of all middlewares, and the message that announces ROS nodes.

A DDS endpoint does not say which node owns it. Every ROS process therefore publishes its nodes and
their endpoints on ``ros_discovery_info``; :func:`pack_discovery_info` and
:func:`unpack_discovery_info` are its bytes.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from struct import Struct
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import CdrError
from turtlewire.guarded import call_guarded
from turtlewire.wake_up import seconds_of

from . import names
from .base import EndpointInfo, Graph, TypeId
from .qos import fit_publisher, fit_subscription

if TYPE_CHECKING:
    from .base import Context
    from .qos import QoS

#: DDS name of the topic; it has no ``rt/`` in front.
DISCOVERY_TOPIC = "ros_discovery_info"
DISCOVERY_TYPE = TypeId(
    "rmw_dds_common/msg/ParticipantEntitiesInfo",
    "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
)

_GID_SIZE = 16
_HUMBLE_GID_SIZE = 24
_NODE_MIN_SIZE = 24  # two empty strings, two empty sequences
_HEADER = b"\x00\x01\x00\x00"
_U32 = Struct("<I")


class NodeEndpoints(NamedTuple):
    """A node and the gids (16 bytes each) of its endpoints, as in ``ros_discovery_info``."""

    namespace: str
    name: str
    readers: tuple[bytes, ...]
    writers: tuple[bytes, ...]


def pack_discovery_info(participant: bytes, nodes: Iterable[NodeEndpoints]) -> bytes:
    """Serialize a ``rmw_dds_common/msg/ParticipantEntitiesInfo`` (little endian, with header)."""
    nodes = list(nodes)
    out = bytearray(_HEADER + participant + _U32.pack(len(nodes)))
    for node in nodes:
        for text in (node.namespace, node.name):
            _align(out)
            encoded = text.encode() + b"\x00"
            out += _U32.pack(len(encoded)) + encoded
        for gids in (node.readers, node.writers):
            _align(out)
            out += _U32.pack(len(gids)) + b"".join(gids)
    return bytes(out)


def _align(out: bytearray) -> None:
    out += b"\x00" * (-len(out) % 4)


def unpack_discovery_info(cdr: bytes) -> tuple[bytes, list[NodeEndpoints]]:
    """Read a ``ros_discovery_info`` sample: the participant's gid and its nodes.

    In Humble, a gid is followed by eight zeros; its samples are told by bytes that are left over.

    Raises:
        CdrError: The bytes are not such a message.
    """
    reader = _DiscoveryInfoReader(cdr, _GID_SIZE)
    humble = _DiscoveryInfoReader(cdr, _HUMBLE_GID_SIZE)
    if reader.fits() or not humble.fits():
        return reader.read()
    return humble.read()


class _DiscoveryInfoReader:
    """A cursor over the bytes of one sample that never leaves them."""

    def __init__(self, cdr: bytes, gid_size: int) -> None:
        self._cdr = cdr
        self._gid_size = gid_size
        self._at = 0

    def fits(self) -> bool:
        """Return whether the message ends where its bytes do, but for the padding of a field."""
        try:
            self.read()
        except CdrError:
            return False
        return len(self._cdr) - self._at < 4

    def read(self) -> tuple[bytes, list[NodeEndpoints]]:
        self._at = len(_HEADER)
        if self._cdr[:2] != _HEADER[:2]:
            raise CdrError(
                "ros_discovery_info: expected little endian CDR (00 01), got header "
                f"{self._cdr[:4].hex(' ')}"
            )
        participant = self._gid()
        return participant, [self._node() for _ in range(self._count(_NODE_MIN_SIZE))]

    def _node(self) -> NodeEndpoints:
        return NodeEndpoints(self._text(), self._text(), self._gids(), self._gids())

    def _text(self) -> str:
        encoded = self._bytes(self._count(1))
        try:
            return encoded.rstrip(b"\x00").decode()
        except UnicodeDecodeError as error:
            raise CdrError(f"ros_discovery_info: a name is not UTF-8: {encoded!r}") from error

    def _gids(self) -> tuple[bytes, ...]:
        return tuple(self._gid() for _ in range(self._count(self._gid_size)))

    def _gid(self) -> bytes:
        return self._bytes(self._gid_size)[:_GID_SIZE]

    def _count(self, item_size: int) -> int:
        """Return a sequence length, refused when not even ``item_size`` bytes per item are left."""
        self._at += -self._at % 4
        (count,) = _U32.unpack(self._bytes(4))
        if count * item_size > len(self._cdr) - self._at:
            raise CdrError(
                f"ros_discovery_info: {count} items announced, {len(self._cdr) - self._at} bytes "
                "left"
            )
        return int(count)

    def _bytes(self, size: int) -> bytes:
        start = self._at
        self._at += size
        if self._at > len(self._cdr):
            raise CdrError(
                f"ros_discovery_info: ends after {len(self._cdr)} bytes in the middle of a field"
            )
        return self._cdr[start : self._at]


def format_user_data(**values: str) -> bytes:
    """``typehash="RIHS01_ab"`` becomes ``b"typehash=RIHS01_ab;"``, in the order given."""
    return "".join(f"{key}={value};" for key, value in values.items()).encode()


def parse_user_data(user_data: bytes) -> dict[str, str]:
    """Read ``key=value;`` pairs.

    Other content is left out: peers other than ROS may put anything there.
    """
    text = user_data.rstrip(b"\x00").decode("utf-8", "replace")
    pairs = (item.partition("=") for item in text.split(";"))
    return {key.strip(): value for key, equals, value in pairs if equals}


class GraphView(Graph):
    """The part of :class:`Graph` that derives from ``nodes()`` and ``endpoints()``, and waiting.

    The subclass, which keeps the data, calls :meth:`notify_changed` after each change, without
    locks held, and :meth:`end_waits` at the end.
    """

    def __init__(self) -> None:
        # `with` takes the lock itself, which a signal cannot leave locked; see `wake_up`.
        self._lock_of_change = threading.RLock()
        self._change = threading.Condition(self._lock_of_change)
        self._version = 0
        self._ended = False
        self._listeners: list[Callable[[], None]] = []

    def endpoints_of(self, topic: str, kind: str) -> list[EndpointInfo]:
        return [
            endpoint
            for endpoint in self.endpoints()
            if endpoint.topic == topic and endpoint.kind == kind
        ]

    def topic_names_and_types(self, *, demangle: bool = True) -> dict[str, list[str]]:
        pairs = []
        for endpoint in self.endpoints():
            if not demangle:
                pairs.append((_raw_topic(endpoint), names.type_to_dds(endpoint.type_name)))
            elif _is_ros_topic(endpoint):
                pairs.append((endpoint.topic, endpoint.type_name))
        return _grouped(pairs)

    def service_names_and_types(self) -> dict[str, list[str]]:
        pairs = []
        for endpoint in self.endpoints():
            service = names.service_from_dds(endpoint.topic)
            if service is not None:
                pairs.append((service, names.service_type(endpoint.type_name)))
        return _grouped(pairs)

    def wait_for(self, predicate: Callable[[], bool], timeout_ns: int | None = None) -> bool:
        timeout = seconds_of(timeout_ns)
        deadline = None if timeout is None else time.monotonic() + timeout
        while True:
            seen = self._version
            if predicate():
                return True
            with self._lock_of_change:
                rest = None if deadline is None else deadline - time.monotonic()
                if (
                    not self._change.wait_for(lambda: self._ended or self._version != seen, rest)  # noqa: B023
                    or self._ended
                ):
                    break
        return predicate()

    def is_complete(self) -> bool:
        """Return True: without discovery there is nothing to wait for."""
        return True

    def hurry(self) -> None:
        """Do nothing: without discovery there is nothing to ask for."""

    def add_listener(self, on_change: Callable[[], None]) -> Callable[[], None]:
        with self._lock_of_change:
            self._listeners.append(on_change)

        def remove() -> None:
            with self._lock_of_change:
                if on_change in self._listeners:
                    self._listeners.remove(on_change)

        return remove

    def notify_changed(self) -> None:
        """Wake the waiting threads and call the listeners, on this thread."""
        with self._lock_of_change:
            self._version += 1
            self._change.notify_all()
            listeners = list(self._listeners)
        for listener in listeners:
            call_guarded(listener)

    def end_waits(self) -> None:
        """End all waits, now and in the future."""
        with self._lock_of_change:
            self._ended = True
            self._change.notify_all()


def _is_ros_topic(endpoint: EndpointInfo) -> bool:
    return endpoint.topic.startswith("/") and not endpoint.qos.avoid_ros_namespace_conventions


def _raw_topic(endpoint: EndpointInfo) -> str:
    return names.topic_to_dds(endpoint.topic) if _is_ros_topic(endpoint) else endpoint.topic


def _grouped(pairs: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    types: dict[str, set[str]] = {}
    for name, type_name in pairs:
        types.setdefault(name, set()).add(type_name)
    return {name: sorted(types[name]) for name in sorted(types)}


def with_best_available(qos: QoS, topic: str, kind: str, context: Context) -> QoS:
    """Choose the best-available policies of a new ``"publisher"`` or ``"subscription"``.

    They follow the endpoints that the graph knows now.
    """
    if not qos.has_best_available:
        return qos
    other_kind = "subscription" if kind == "publisher" else "publisher"
    others = [endpoint.qos for endpoint in context.graph.endpoints_of(topic, other_kind)]
    return fit_publisher(qos, others) if kind == "publisher" else fit_subscription(qos, others)
