"""Asks the participants on Fast DDS at which addresses they receive messages.

A participant announces the addresses at which it receives, each with its kind of transport (SPDP of
DDSI-RTPS, 8.5.3 and 9.6.3). Cyclone DDS does not pass them on.
"""

from __future__ import annotations

import os
import selectors
import socket
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, suppress
from struct import Struct
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.doctor.network import GROUP, udp_ports
from turtlewire.wire.cyclone.ports import ports_of, unicast_ports_of

if TYPE_CHECKING:
    from typing_extensions import Self

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


_FAST_DDS = b"\x01\x0f"
_LOOPBACK = "127.0.0.1"
#: Answers came within 25 ms.
_PATIENCE_S = 0.1
_BUFFER = 4_194_304  # for the answers of a crowd, as far as the system lets it
_MOST_ANSWERS = 10_000
_LARGEST = 65_536


class FastDdsSearch:
    """A question to all participants on Fast DDS, and their answers.

    Args:
        domain_id: The domain.
        wide: Whether to ask other hosts as well.
    """

    def __init__(self, domain_id: int, *, wide: bool) -> None:
        self._ports = ports_of(domain_id), unicast_ports_of(domain_id)
        self._open = ExitStack()
        self._sockets: list[tuple[socket.socket, Question]] = []
        prefix = bytes(2) + os.urandom(10)
        for address in (_LOOPBACK, *([_own_address()] if wide else [])):
            with suppress(OSError):  # there is no such interface, or it may not be used
                self._add(prefix, address)
        self._asked = time.monotonic()
        for asking, question in self._sockets:
            self._send(asking, question.packet())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Withdraw the query, so that participants forget it."""
        for asking, question in self._sockets:
            self._send(asking, question.withdrawal())
        self._open.close()

    def _add(self, prefix: bytes, address: str) -> None:
        asking = self._open.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        own = socket.inet_aton(address)
        asking.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER)
        asking.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, own)
        asking.bind((address, 0))
        asking.setblocking(False)
        question = Question(prefix, own, asking.getsockname()[1])
        self._sockets.append((asking, question))

    def _send(self, asking: socket.socket, packet: bytes) -> None:
        all_of_domain, of_processes = self._ports
        targets = [(GROUP, all_of_domain.start)]
        if asking.getsockname()[0] == _LOOPBACK:
            # With the range LOCALHOST, they listen to no multicast.
            targets += [(_LOOPBACK, port) for port in udp_ports().intersection(of_processes)]
        for target in targets:
            with suppress(OSError):  # no route, or not permitted
                asking.sendto(packet, target)

    def answers(self) -> list[Participant]:
        """Return the participants on Fast DDS that have answered, in order of their prefixes."""
        questions = dict(self._sockets)
        found: dict[bytes, Participant] = {}
        end = self._asked + _PATIENCE_S
        while ready := _readable(questions, end):
            for asking in ready:
                for datagram, address in _received(asking):
                    is_here = address in (_LOOPBACK, socket.inet_ntoa(questions[asking].address))
                    for participant in read_participants(datagram, "" if is_here else address):
                        if participant.prefix.startswith(_FAST_DDS):
                            found.setdefault(participant.prefix, participant)
            if time.monotonic() >= end:  # also if datagrams keep coming
                break
        return [found[prefix] for prefix in sorted(found)]


def _readable(sockets: Iterable[socket.socket], end: float) -> list[socket.socket]:
    """Return the sockets with datagrams, waiting for the first one until a time."""
    with selectors.DefaultSelector() as selector:
        for each in sockets:
            selector.register(each, selectors.EVENT_READ)
        events = selector.select(max(0.0, end - time.monotonic()))
    return [each for each in sockets if any(key.fileobj is each for key, _ in events)]


def _received(asking: socket.socket) -> Iterator[tuple[bytes, str]]:
    """Yield the datagrams that have arrived, and the addresses of their hosts."""
    for _ in range(_MOST_ANSWERS):
        try:
            datagram, (address, _) = asking.recvfrom(_LARGEST)
        except BlockingIOError:
            return
        except OSError:  # on Windows, if a query did not reach any process
            continue
        yield datagram, address


def _own_address() -> str:
    """Return the address of this host on the network that multicast takes; empty if none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as route:
        try:
            route.connect((GROUP, 7400))  # sends nothing
        except OSError:
            return ""
        return str(route.getsockname()[0])
