"""The texts and bytes of rmw_zenoh_cpp's protocol: liveliness tokens and attachments.

Tokens announce nodes and endpoints, with their QoS. An attachment accompanies each message, request
and response.

The notation of a QoS is
``<reliability>:<durability>:<history>,<depth>:<deadline>:<lifespan>:<liveliness>,<lease>`` with
numbers of rmw, durations as ``<s>,<ns>``, and nothing where a value is rmw_zenoh's default.
"""

from __future__ import annotations

from struct import Struct
from typing import NamedTuple

from turtlewire.wire.qos import (
    INFINITE_NS,
    Durability,
    History,
    Liveliness,
    QoS,
    Reliability,
)

#: rmw_zenoh's own default, and what a depth of 0 means there.
_DEFAULT_DEPTH = 42

_SECOND = 1_000_000_000
_FOREVER = divmod(INFINITE_NS, _SECOND)
_PARTS = 6


def adapted(qos: QoS) -> QoS:
    """Return a QoS with rmw_zenoh's defaults in place of system defaults and a depth of 0.

    Best-available policies stay, as in rmw_zenoh: every QoS matches there, so there is nothing to
    choose. They act like best effort and volatile.
    """
    return qos._replace(
        history=qos.history or History.KEEP_LAST,
        depth=qos.depth or _DEFAULT_DEPTH,
        reliability=qos.reliability or Reliability.RELIABLE,
        durability=qos.durability or Durability.VOLATILE,
        liveliness=qos.liveliness or Liveliness.AUTOMATIC,
    )


def format_qos(qos: QoS) -> str:
    """Return the text of an adapted QoS in a token."""
    history = _number(qos.history, History.KEEP_LAST)
    liveliness = _number(qos.liveliness, Liveliness.AUTOMATIC)
    return ":".join(
        (
            _number(qos.reliability, Reliability.RELIABLE),
            _number(qos.durability, Durability.VOLATILE),
            f"{history},{_number(qos.depth, _DEFAULT_DEPTH)}",
            _duration(qos.deadline_ns),
            _duration(qos.lifespan_ns),
            f"{liveliness},{_duration(qos.liveliness_lease_ns)}",
        )
    )


def _number(value: int, default: int) -> str:
    return "" if value == default else str(int(value))


def _duration(nanoseconds: int) -> str:
    parts = divmod(nanoseconds or INFINITE_NS, _SECOND)
    return ",".join(_number(part, default) for part, default in zip(parts, _FOREVER, strict=True))


def parse_qos(text: str) -> QoS:
    """Read the text of a QoS in a token.

    Raises:
        ValueError: ``text`` is not a QoS string of a token.
    """
    parts = [part.split(",") for part in text.split(":")]
    if len(parts) < _PARTS:
        raise ValueError(f"a QoS has {_PARTS} parts, this one {len(parts)}: {text!r}")
    [reliability], [durability], [history, depth], deadline, lifespan, liveliness = parts[:_PARTS]
    return QoS(
        history=History(_value(history, History.KEEP_LAST)),
        depth=_value(depth, _DEFAULT_DEPTH),
        reliability=Reliability(_value(reliability, Reliability.RELIABLE)),
        durability=Durability(_value(durability, Durability.VOLATILE)),
        deadline_ns=_nanoseconds(deadline),
        lifespan_ns=_nanoseconds(lifespan),
        liveliness=Liveliness(_value(liveliness[0], Liveliness.AUTOMATIC)),
        liveliness_lease_ns=_nanoseconds(liveliness[1:]),
    )


def _value(text: str, default: int) -> int:
    return int(text) if text else default


def _nanoseconds(parts: list[str]) -> int:
    seconds, nanoseconds = (
        _value(part, default) for part, default in zip(parts, _FOREVER, strict=True)
    )
    return seconds * _SECOND + nanoseconds


NODE = "NN"
PUBLISHER = "MP"
SUBSCRIPTION = "MS"
SERVICE = "SS"
CLIENT = "SC"

_SPACE = "@ros2_lv"
_ENDPOINTS = (PUBLISHER, SUBSCRIPTION, SERVICE, CLIENT)
_NODE_FIELDS, _ENDPOINT_FIELDS = 9, 13


class Token(NamedTuple):
    """A node or an endpoint, as its liveliness token describes it.

    Attributes:
        domain_id: The domain.
        session: Id of the Zenoh session, in hexadecimal digits.
        node_id: Number of the node within the session.
        entity_id: Number of the endpoint; of a node, its own.
        kind: One of `NODE`, `PUBLISHER`, `SUBSCRIPTION`, `SERVICE` and `CLIENT`.
        enclave: Enclave of the node.
        namespace: Namespace of the node.
        node: Name of the node.
        name: Fully qualified name of the topic or service; empty for nodes.
        dds_type: ``std_msgs::msg::dds_::String_``; of a service, its own type.
        type_hash: ``RIHS01_`` and 64 digits.
        qos: See `format_qos`.
    """

    domain_id: int
    session: str
    node_id: str
    entity_id: str
    kind: str
    enclave: str
    namespace: str
    node: str
    name: str = ""
    dds_type: str = ""
    type_hash: str = ""
    qos: str = ""

    @property
    def text(self) -> str:
        """The key of the token."""
        mangled = [self.enclave, self.namespace, self.node]
        if self.kind != NODE:
            mangled += [self.name, self.dds_type, self.type_hash]
        fields = [_SPACE, str(self.domain_id), self.session, self.node_id, self.entity_id]
        fields += [self.kind, *(field.replace("/", "%") for field in mangled)]
        if self.kind != NODE:
            fields.append(self.qos)
        return "/".join(fields)

    @property
    def data_key(self) -> str:
        """The key that the messages, or requests and responses, of an endpoint have."""
        return f"{self.domain_id}/{self.name.strip('/')}/{self.dds_type}/{self.type_hash}"

    @property
    def gid(self) -> bytes:
        """16 bytes that anyone with the text can compute: XXH3 of it, low half first."""
        from xxhash import xxh3_128_digest

        return xxh3_128_digest(self.text.encode())[::-1]

    @classmethod
    def parse(cls, text: str) -> Token | None:
        """Read a token; None if the text is not a token or has an unknown kind.

        Newer versions may add fields at the end.
        """
        fields = text.split("/")
        if len(fields) < _NODE_FIELDS or fields[0] != _SPACE or "" in fields:
            return None
        _, domain_id, session, node_id, entity_id, kind, *mangled = fields
        if not domain_id.isdecimal():
            return None
        names = [field.replace("%", "/") for field in mangled]
        enclave, namespace, node, *rest = names
        token = cls(int(domain_id), session, node_id, entity_id, kind, enclave, namespace, node)
        if kind == NODE:
            return token
        if kind in _ENDPOINTS and len(fields) >= _ENDPOINT_FIELDS:
            name, dds_type, type_hash, qos = rest[:4]
            return token._replace(name=name, dds_type=dds_type, type_hash=type_hash, qos=qos)
        return None


def graph_key(domain_id: int) -> str:
    """Return the expression that all tokens of a domain meet."""
    return f"{_SPACE}/{domain_id}/**"


_GID_SIZE = 16
_LAYOUT = Struct(f"<qqB{_GID_SIZE}s")
#: rmw_zenoh_cpp 0.2.0 to 0.2.3 wrote the name of each value in front of it.
_NAMED_LAYOUT = Struct(f"<16xq17xq11xB{_GID_SIZE}s")


class Attachment(NamedTuple):
    """Origin of a message.

    Attributes:
        sequence_number: Counted by the publisher or client from 1.
        source_timestamp_ns: When it was written, system time.
        gid: 16 bytes, of the publisher; beside requests and their responses, of the client.
    """

    sequence_number: int
    source_timestamp_ns: int
    gid: bytes

    @classmethod
    def unpack(cls, data: bytes) -> Attachment:
        """Read either layout.

        Raises:
            ValueError: The bytes have neither layout.
        """
        for layout in (_LAYOUT, _NAMED_LAYOUT):
            if len(data) == layout.size:
                sequence_number, source_timestamp_ns, size, gid = layout.unpack(data)
                if size == _GID_SIZE:
                    return cls(sequence_number, source_timestamp_ns, gid)
        raise ValueError(f"an attachment of {len(data)} bytes is not one of rmw_zenoh_cpp")


def pack_attachment(sequence_number: int, source_timestamp_ns: int, gid: bytes) -> bytes:
    """Return the 33 bytes of an `Attachment`, as ROS 2 Jazzy (0.2.4) and later write them."""
    return _LAYOUT.pack(sequence_number, source_timestamp_ns, _GID_SIZE, gid)
