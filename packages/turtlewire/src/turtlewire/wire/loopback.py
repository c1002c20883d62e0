"""Keeps out datagrams of other computers if a middleware uses only the loopback interface.

Cyclone and Zenoh bind their receiving sockets to all addresses, have no setting for that, and
accept any datagram. So one datagram from a computer of the same network could announce publishers
to Cyclone, or make Zenoh connect to that computer. Linux can bind a socket to an interface later.
"""

from __future__ import annotations

import os
import socket
import sys
from collections.abc import Container, Iterable
from contextlib import suppress

from turtlewire.wire.report import warn_once

ANY_PORT = range(1 << 16)
_FILES = "/proc/self/fd"
_MULTICAST = range(224, 240)  # the first number of these addresses
_ANY = "0.0.0.0"  # noqa: S104 - nothing is bound to it


def open_sockets() -> dict[str, int]:
    """Return the sockets of this process, by the names that Linux gives them, and their numbers.

    Empty on other systems.
    """
    found: dict[str, int] = {}
    if sys.platform != "linux":
        return found
    with suppress(FileNotFoundError):  # no /proc
        for number in os.listdir(_FILES):
            with suppress(FileNotFoundError):  # already closed, as the listing itself is
                name = os.readlink(os.path.join(_FILES, number))
                if name.startswith("socket:"):
                    found[name] = int(number)
    return found


def bind_to_loopback(former: Iterable[str], ports: Container[int]) -> None:
    """Bind the sockets at which a middleware receives to the loopback interface, on Linux.

    Nothing happens if it sends from another interface as well, which ``CYCLONEDDS_URI`` may say.

    Args:
        former: Names of the sockets that were open before.
        ports: Where the middleware may receive: another thread may open sockets at the same time.
    """
    receiving = []
    sockets = open_sockets()
    for name in sockets.keys() - set(former):
        address = _udp_address(sockets[name])
        if address is None:
            continue
        host, port = address
        if socket.inet_aton(host)[0] in _MULTICAST:
            continue  # Zenoh's: it only answers, and processes of wider ranges on this host ask it
        # Only these settings add interfaces; else the socket is one that another thread has opened.
        if host != _ANY and not host.startswith("127.") and "CYCLONEDDS_URI" in os.environ:
            return
        if host == _ANY and port in ports:
            receiving.append(sockets[name])
    for number in receiving:
        _bind(number)


def ports_of_sockets(ports: Container[int]) -> list[int]:
    """Return the ports at which UDP sockets of this process receive, among the given ones.

    Empty on other systems than Linux.
    """
    addresses = map(_udp_address, open_sockets().values())
    return sorted({address[1] for address in addresses if address and address[1] in ports})


def _udp_address(number: int) -> tuple[str, int] | None:
    """Return host and port of a UDP socket; None for any other socket."""
    if sys.platform != "linux":
        return None
    try:
        with socket.fromfd(number, socket.AF_INET, socket.SOCK_DGRAM) as copy:
            kind = copy.getsockopt(socket.SOL_SOCKET, socket.SO_TYPE)
            family = copy.getsockopt(socket.SOL_SOCKET, socket.SO_DOMAIN)
            if (family, kind) != (socket.AF_INET, socket.SOCK_DGRAM):
                return None
            host, port = copy.getsockname()
            return host, port
    except OSError:  # another thread has closed it
        return None


def _bind(number: int) -> None:
    if sys.platform != "linux":
        return
    with socket.fromfd(number, socket.AF_INET, socket.SOCK_DGRAM) as copy:
        try:
            copy.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, b"lo\0")
        except OSError as error:  # kernels before 5.7 let only root do that
            warn_once(
                "datagrams from other computers",
                "datagrams from other computers reach this process, although it communicates with "
                "this computer only: its sockets cannot be bound to the loopback interface "
                f"({error})",
            )
