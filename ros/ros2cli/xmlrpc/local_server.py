"""A server that answers to this host alone."""

from __future__ import annotations

import socket
import struct
import sys
from typing import Any
from xmlrpc.server import SimpleXMLRPCServer

__all__ = ["LocalXMLRPCServer", "get_local_ipaddrs"]

_SIOCGIFADDR = 0x8915  # <linux/sockios.h>


def get_local_ipaddrs() -> list[str]:
    """IPv4 addresses of the interfaces of this host."""
    if sys.platform != "linux":
        return socket.gethostbyname_ex(socket.gethostname())[2]
    import fcntl

    found = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        for _, name in socket.if_nameindex():
            request = struct.pack("256s", name.encode()[:15])
            try:  # an interface need not have an IPv4 address
                answer = fcntl.ioctl(asked.fileno(), _SIOCGIFADDR, request)
            except OSError:
                continue
            found.append(socket.inet_ntoa(answer[20:24]))
    return found


class LocalXMLRPCServer(SimpleXMLRPCServer):
    """A server of remote calls that refuses requests of other hosts."""

    # Two servers must not share a port: the second would seem to work, and never be asked.
    allow_reuse_address = False

    def verify_request(self, request: Any, client_address: Any) -> bool:  # noqa: ARG002
        """Whether a request comes from this host."""
        host = client_address[0]
        return host.startswith("127.") or host in get_local_ipaddrs()
