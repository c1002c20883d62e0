"""Datagrams to and from a multicast group."""

from __future__ import annotations

import errno
import ipaddress
import socket
import sys
from argparse import ArgumentTypeError
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from types import TracebackType

from ros2cli.arguments import argument

# ROS 2's group and port.
DEFAULT_GROUP = "225.0.0.1"
DEFAULT_PORT = 49150

_LONGEST = 4096
#: What Linux says, and what others say, when the system finds no interface for a group.
_NO_ROUTE = (errno.ENODEV, errno.EADDRNOTAVAIL)


class MulticastSocket:
    """Sends to a group and receives from it; a context manager.

    Without a route to the group, the datagrams stay on this host, and one line says so.

    Args:
        group: Address of the group.
        port: UDP port.
        ttl: How many routers a datagram may pass; None leaves it to the system.
    """

    def __init__(self, group: str, port: int, ttl: int | None = None) -> None:
        self._target = (group, port)
        self._ttl = ttl

    def __enter__(self) -> MulticastSocket:  # noqa: PYI034  Self is not in Python 3.10
        """Open the sockets; receivers share the port."""
        group, port = self._target
        self._sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP)
        self._receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP)
        try:
            if self._ttl is not None:
                self._sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, self._ttl)
            self._receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self._receiver.bind(("", port))
            self._join(socket.inet_aton(group))
        except OSError:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(
        self,
        _type: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: TracebackType | None,
    ) -> None:
        """Leave the group."""
        self._sender.close()
        self._receiver.close()

    def _join(self, group: bytes) -> None:
        chosen_by_system = socket.inet_aton("0.0.0.0")  # noqa: S104  no address to bind to
        loopback = socket.inet_aton("127.0.0.1")
        join = (socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP)
        try:
            self._receiver.setsockopt(*join, group + chosen_by_system)
        except OSError as error:
            if error.errno not in _NO_ROUTE:
                raise
            _tell_of_missing_route(self._target[0])
            self._receiver.setsockopt(*join, group + loopback)
            self._sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, loopback)

    def send(self, data: bytes) -> None:
        """Send a datagram to the group."""
        self._sender.sendto(data, self._target)

    def receive(self, timeout: float | None = None) -> tuple[bytes, tuple[str, int]]:
        """Wait for a datagram; return its bytes and the address of its sender.

        Args:
            timeout: Seconds to wait; None waits without a limit.

        Raises:
            TimeoutError: No datagram arrived in time.
        """
        self._receiver.settimeout(timeout)
        return self._receiver.recvfrom(_LONGEST)

    def received(self) -> Iterator[tuple[bytes, tuple[str, int]]]:
        """Yield the datagrams that have arrived."""
        self._receiver.setblocking(False)
        with suppress(BlockingIOError):
            while True:
                yield self._receiver.recvfrom(_LONGEST)


@cache  # a program may open several sockets
def _tell_of_missing_route(group: str) -> None:
    print(f"no route leads to the group {group}: the datagrams stay on this host", file=sys.stderr)


def receive(
    *, group: str = DEFAULT_GROUP, port: int = DEFAULT_PORT, timeout: float | None = None
) -> tuple[bytes, tuple[str, int]]:
    """Wait for a datagram; return its bytes, and host and port of its sender.

    Args:
        group: Address of the group.
        port: UDP port.
        timeout: Seconds to wait; None waits without a limit.

    Raises:
        TimeoutError: No datagram arrived in time.
    """
    with MulticastSocket(group, port) as multicast:
        return multicast.receive(timeout)


def send(
    data: bytes, *, group: str = DEFAULT_GROUP, port: int = DEFAULT_PORT, ttl: int | None = None
) -> None:
    """Send a datagram.

    Args:
        data: Its bytes.
        group: Address of the group.
        port: UDP port.
        ttl: How many routers it may pass; None leaves it to the system.
    """
    with MulticastSocket(group, port, ttl) as multicast:
        multicast.send(data)


def _group(text: str) -> str:
    try:
        is_group = ipaddress.IPv4Address(text).is_multicast
    except ValueError:
        is_group = False
    if not is_group:
        raise ArgumentTypeError(
            f"'{text}' is not an IPv4 multicast group, 224.0.0.0 to 239.255.255.255"
        )
    return text


def _port(text: str) -> int:
    try:
        port = int(text)
    except ValueError:
        port = 0
    if not 0 < port < 1 << 16:
        raise ArgumentTypeError(f"'{text}' is not a UDP port, 1 to 65535")
    return port


#: What sender and receiver have to agree on.
GROUP_ARGUMENTS = (
    argument(
        "--group",
        type=_group,
        default=DEFAULT_GROUP,
        help=f"Multicast group (default: {DEFAULT_GROUP})",
    ),
    argument(
        "--port", type=_port, default=DEFAULT_PORT, help=f"UDP port (default: {DEFAULT_PORT})"
    ),
)
