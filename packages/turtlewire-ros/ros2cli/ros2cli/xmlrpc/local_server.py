"""A server that only answers this host."""

from __future__ import annotations

import sys
from typing import Any
from xmlrpc.server import SimpleXMLRPCServer

from turtlewire.web.lan import interface_addresses as get_local_ipaddrs

__all__ = ["LocalXMLRPCServer", "get_local_ipaddrs"]


class LocalXMLRPCServer(SimpleXMLRPCServer):
    """A server of remote calls that refuses requests of other hosts."""

    # So that a server can follow another one at once. On Windows two servers would share the port,
    # and the second would never be asked.
    allow_reuse_address = sys.platform != "win32"

    def verify_request(self, request: Any, client_address: Any) -> bool:  # noqa: ARG002
        """Return True if a request comes from this host."""
        host = client_address[0]
        return host.startswith("127.") or host in get_local_ipaddrs()
