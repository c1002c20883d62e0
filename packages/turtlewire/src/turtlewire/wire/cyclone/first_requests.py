"""Asks clients on Fast DDS for requests that they sent before they were discovered.

A client sends its first request as soon as it has found the server, which may not have found the
client yet. Cyclone drops that request, and reads a volatile writer only from the sample after those
that its first heartbeat lists. The first heartbeat of a new client lists this request. (A client on
Cyclone waits for that heartbeat before it sends anything.)

So the server sends itself two heartbeats in the name of the new client before the client's own: the
first lists no sample, the second lists one, which Cyclone then requests. Fast DDS sends it again if
it exists and was meant for this server; otherwise it sends nothing. Native code sends the
heartbeats, because it does not wait for the GIL: the client's own heartbeat arrives within
milliseconds.
"""

from __future__ import annotations

import socket

from turtlewire.wire.loopback import ports_of_sockets

from . import library as dds
from .native import address_of
from .ports import unicast_ports_of

_ELSEWHERE = ("192.0.2.1", 9)  # an address of no computer (RFC 5737)
_KEEP_STATUS = False  # else the reader thread would not see that something has matched


class FirstRequests:
    """Asks each new client of a service for its first request.

    Native code uses it until `close`, so it must be kept until then.

    Args:
        handle: The reader of requests.
        reader: Its GUID.
        targets: What `receiving_addresses` returns.
    """

    def __init__(self, handle: int, reader: bytes, targets: list[tuple[int, int]]) -> None:
        from turtlewire._native import CycloneFirstRequests

        functions = [address_of(dds.matched_publication_data), address_of(dds.free_endpoint)]
        self._handle = handle
        self._native = CycloneFirstRequests(functions, reader, targets)
        callback, argument = self._native.listener()
        listener = dds.create_listener(None)
        dds.lset_subscription_matched(listener, callback, argument, _KEEP_STATUS)
        dds.check(dds.set_listener(handle, listener), "listen for clients")
        dds.delete_listener(listener)

    def close(self) -> None:
        """Ask no more clients; wait for the end of a call of native code."""
        dds.set_listener(self._handle, None)
        self._native.close()


def receiving_addresses(domain_id: int) -> list[tuple[int, int]]:
    """Return the IPv4 addresses, as numbers, and ports at which this process receives.

    It looks at all open files, so call it once for each context.
    """
    ports = ports_of_sockets(unicast_ports_of(domain_id))
    return [(address, port) for port in ports for address in _own_addresses()]


def _own_addresses() -> set[int]:
    """Return the loopback address, and the one from which other computers are reached."""
    found = {"127.0.0.1"}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as route:
        try:
            route.connect(_ELSEWHERE)  # sends nothing
            found.add(route.getsockname()[0])
        except OSError:  # this computer has no other address
            pass
    return {int.from_bytes(socket.inet_aton(address), "big") for address in found}
