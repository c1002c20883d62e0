"""The announcements of DDS participants: reads their packets, and writes queries to them.

A participant names the addresses at which it receives, each with its kind of transport (SPDP of
DDSI-RTPS, 8.5.3 and 9.6.3). Cyclone DDS does not pass them on.
"""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Participant", "Question", "read_participants"]

_MAGIC, _VERSION, _VENDOR = b"RTPS", b"\x02\x02", b"\x00\x00"
_HEADER_SIZE = 20
_DATA = 0x15
_LITTLE, _INLINE_QOS, _PAYLOAD, _KEY = 1, 2, 4, 8
_READER = b"\x00\x01\x00\xc7"
_WRITER = b"\x00\x01\x00\xc2"
_PARTICIPANT = b"\x00\x00\x01\xc1"
#: The byte order of the parameters, by the first two bytes of the payload.
_ORDERS = {b"\x00\x02": ">", b"\x00\x03": "<"}
_SENTINEL = 0x0001
_LEASE, _PROTOCOL, _VENDOR_ID, _DEFAULT_UNICAST, _METATRAFFIC_UNICAST = 2, 0x15, 0x16, 0x31, 0x32
_GUID, _ENDPOINTS, _PROPERTIES, _NAME, _KEY_HASH, _STATUS = 0x50, 0x58, 0x59, 0x62, 0x70, 0x71
_DOMAIN_TAG = 0x4014
_IS_GONE = b"\x00\x00\x00\x03"
#: A participant only answers endpoints that read announcements.
_READS_ANNOUNCEMENTS = 2
_LEASE_S = 5
_OWN_NAME = b"turtlewire doctor\x00"

_TRANSPORTS = {1: "UDPv4", 2: "UDPv6", 4: "TCPv4", 8: "TCPv6"}
#: Fast DDS 3 also sets other bits.
_SHARED_MEMORY = 16


class Participant(NamedTuple):
    """The announcement of a participant.

    Attributes:
        prefix: The first 12 bytes of the gids of all its endpoints.
        transports: How it receives messages, such as ``"UDPv4"``; empty if it does not say.
        process: The number of its process; empty if it does not say.
        address: Where the announcement came from; empty for this host.
    """

    prefix: bytes
    transports: tuple[str, ...]
    process: str
    address: str


def read_participants(datagram: bytes, address: str = "") -> list[Participant]:
    """Return the participants that a datagram announces; none if it is anything else.

    Args:
        datagram: Its bytes, whatever they are.
        address: The host that sent it; empty for this one.
    """
    if datagram[:4] != _MAGIC:
        return []
    found = []
    for kind, flags, body in _submessages(datagram):
        # Announcements have no inline QoS; a participant that leaves sends some.
        if kind == _DATA and flags & (_INLINE_QOS | _PAYLOAD) == _PAYLOAD:
            order = _ORDERS.get(body[20:22])
            if body[8:12] == _WRITER and order:
                transports, process = _announced(body[24:], order)
                prefix = datagram[8:_HEADER_SIZE]
                found.append(Participant(prefix, transports, process, address))
    return found


def _submessages(datagram: bytes) -> Iterator[tuple[int, int, bytes]]:
    at = _HEADER_SIZE
    while at + 4 <= len(datagram):
        kind, flags = datagram[at : at + 2]
        size = int.from_bytes(datagram[at + 2 : at + 4], "little" if flags & _LITTLE else "big")
        end = at + 4 + size if size else len(datagram)  # 0: the last one, to the end
        yield kind, flags, datagram[at + 4 : end]
        at = end


def _parameters(data: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    head, at = Struct(f"{order}HH"), 0
    while at + head.size <= len(data):
        number, size = head.unpack_from(data, at)
        if number == _SENTINEL:
            return
        at += head.size
        yield number, data[at : at + size]
        at += size


def _announced(data: bytes, order: str) -> tuple[tuple[str, ...], str]:
    """Return the transports and the process."""
    kinds, properties = [], {}
    for number, value in _parameters(data, order):
        if number == _DEFAULT_UNICAST:
            kinds.append(_transport(value, order))
        elif number == _PROPERTIES:
            properties = _properties(value, order)
    return tuple(dict.fromkeys(kinds)), properties.get("fastdds.physical_data.process", "")


def _transport(locator: bytes, order: str) -> str:
    kind = int.from_bytes(locator[:4], "little" if order == "<" else "big")
    if kind & ~0xF == _SHARED_MEMORY:
        return "shared memory"
    return _TRANSPORTS.get(kind, f"transport {kind}")


def _properties(data: bytes, order: str) -> dict[str, str]:
    """Read pairs of texts, as far as they go."""
    size = Struct(f"{order}I")
    texts: list[str] = []
    at = 4
    while at + 4 <= len(data):
        (length,) = size.unpack_from(data, at)
        text = data[at + 4 : at + 4 + length]
        texts.append(text.rstrip(b"\x00").decode("utf-8", "replace"))
        at += 4 + length + -length % 4
    return dict(zip(texts[::2], texts[1::2], strict=False))


class Question(NamedTuple):
    """An announcement that Fast DDS answers at once with its own, and that Cyclone DDS ignores.

    Cyclone ignores participants of another domain tag, which Fast DDS does not know.

    Attributes:
        prefix: The first 12 bytes of the gid of the asking participant.
        address: The IPv4 address that the answers are sent to, in 4 bytes.
        port: The UDP port that they are sent to.
    """

    prefix: bytes
    address: bytes
    port: int

    def packet(self) -> bytes:
        """Return the datagram that asks."""
        locator = Struct("<iI").pack(1, self.port) + bytes(12) + self.address
        name = Struct("<I").pack(len(_OWN_NAME)) + _OWN_NAME
        parameters = {
            _PROTOCOL: _VERSION + bytes(2),
            _VENDOR_ID: _VENDOR + bytes(2),
            _GUID: self.prefix + _PARTICIPANT,
            _METATRAFFIC_UNICAST: locator,
            _DEFAULT_UNICAST: locator,
            _LEASE: Struct("<iI").pack(_LEASE_S, 0),
            _ENDPOINTS: Struct("<I").pack(_READS_ANNOUNCEMENTS),
            _NAME: name,
            _DOMAIN_TAG: name,
        }
        return self._data(1, _PAYLOAD, b"\x00\x03\x00\x00" + _list_of(parameters))

    def withdrawal(self) -> bytes:
        """Return the datagram after which the others forget that they were asked."""
        key = {_GUID: self.prefix + _PARTICIPANT}
        inline = {_KEY_HASH: self.prefix + _PARTICIPANT, _STATUS: _IS_GONE}
        payload = _list_of(inline) + b"\x00\x03\x00\x00" + _list_of(key)
        return self._data(2, _INLINE_QOS | _KEY, payload)

    def _data(self, number: int, flags: int, payload: bytes) -> bytes:
        body = Struct("<HH4s4siI").pack(0, 16, _READER, _WRITER, 0, number) + payload
        header = _MAGIC + _VERSION + _VENDOR + self.prefix
        return header + Struct("<BBH").pack(_DATA, flags | _LITTLE, len(body)) + body


def _list_of(parameters: dict[int, bytes]) -> bytes:
    padded = {number: value + bytes(-len(value) % 4) for number, value in parameters.items()}
    parts = [Struct("<HH").pack(number, len(value)) + value for number, value in padded.items()]
    return b"".join(parts) + Struct("<HH").pack(_SENTINEL, 0)
