"""Asks the participants on Fast DDS at which addresses they receive messages."""

from __future__ import annotations

import os
import selectors
import socket
import time
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING

from turtlewire.doctor.announcements import Participant, Question, read_participants
from turtlewire.doctor.network import GROUP, udp_ports
from turtlewire.wire.cyclone.ports import ports_of, unicast_ports_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from typing_extensions import Self

__all__ = ["FastDdsSearch"]

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
