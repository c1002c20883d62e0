"""Chooses the servers of a service that get requests, and explains the others.

rmw_cyclonedds writes 16 bytes in front of the fields of a request; the other middlewares carry them
elsewhere. A server on Fast DDS would read these bytes as fields: it interprets some of them as a
length, and allocates gigabytes or never answers again. So such a request must never reach it.

Two measures together prevent that:

- :class:`Servers` looks at all matching servers before each request.
- The writer of these requests is in the partition `ONLY_CYCLONE`, because a server may begin to
  match between the check and the request. Cyclone matches that partition with the default one, Fast
  DDS does not, and drops what comes from a writer that it does not match. Requests in the layout of
  Fast DDS come out of another writer (`services`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.wire.graph import parse_user_data
from turtlewire.wire.services import not_callable, served_twice

from . import library as dds
from .endpoint import matched_handles
from .fast_dds import FAST_DDS
from .ports import is_cyclone
from .qos import read_user_data

if TYPE_CHECKING:
    import ctypes

    from turtlewire.errors import UncallableServiceError

#: Cyclone compares patterns with the default partition, whose name is empty; Fast DDS does not.
ONLY_CYCLONE = "*"

_FAST_DDS = b"\x01\x0f"
_MIDDLEWARES = {
    b"\x01\x01": "Connext DDS (rmw_connextdds)",
    _FAST_DDS: "Fast DDS (rmw_fastrtps_cpp)",
    b"\x01\x10": "Cyclone DDS (rmw_cyclonedds_cpp)",
    b"\x01\x12": "RustDDS",
}


class MatchedEndpoint(NamedTuple):
    """A reader or writer at the other end.

    Attributes:
        gid: Its 16 bytes.
        ids: Its ``clientid`` or ``serviceid``, and what else it announces.
    """

    gid: bytes
    ids: dict[str, str]


def is_fast_dds(gid: bytes) -> bool:
    """Return True if the gid is one of Fast DDS, the default middleware of ROS 2."""
    return gid.startswith(_FAST_DDS)


def middleware_of(gid: bytes) -> str:
    """Return the middleware of an endpoint."""
    return _MIDDLEWARES.get(gid[:2], f"a DDS of vendor {gid[:2].hex('.')}")


def foreign_middleware(gid: bytes, ids: dict[str, str]) -> str:
    """Return the middleware of a server to which requests cannot be sent in the layout it reads.

    Empty for a server on rmw_cyclonedds, and on Fast DDS if services with it work here.

    Args:
        gid: The gid of the server's reader.
        ids: What the reader announces in its user data.
    """
    if is_cyclone(gid):
        return "" if "serviceid" in ids else "a middleware that announces no serviceid"
    if is_fast_dds(gid) and not FAST_DDS.obstacle:
        return ""
    return middleware_of(gid)


def matched_endpoints(
    handle: int,
    matched: list[int],
    read_matched: Callable[..., ctypes._Pointer[dds.BuiltinEndpoint]],
) -> list[MatchedEndpoint]:
    """Return the announcements of the matching readers or writers that are still there.

    Args:
        handle: Cyclone's handle of our endpoint.
        matched: Cyclone's handles of the others.
        read_matched: Cyclone's function that returns what one of them announces.
    """
    found = []
    for instance in matched:
        endpoint = read_matched(handle, instance)
        if endpoint:
            try:
                ids = parse_user_data(read_user_data(endpoint.contents.qos))
                found.append(MatchedEndpoint(bytes(endpoint.contents.key), ids))
            finally:
                dds.free_endpoint(endpoint)
    return found


class Servers:
    """The servers that match a client's writer of requests.

    Args:
        writer: Cyclone's handle of the writer.
    """

    def __init__(self, writer: int) -> None:
        self._writer = writer
        #: Cyclone's handles of the matching readers, and what they announced. Cyclone gives no
        #: handle twice, so equal handles are the same readers.
        self._known: tuple[list[int], list[MatchedEndpoint]] = ([], [])

    def now(self) -> list[MatchedEndpoint]:
        """Return the endpoints that match now."""
        handles = matched_handles(self._writer, dds.matched_subscriptions)
        known, servers = self._known
        if handles != known:
            servers = matched_endpoints(self._writer, handles, dds.matched_subscription_data)
            self._known = (handles, servers)
        return servers


def refusal(service: str, servers: list[MatchedEndpoint]) -> UncallableServiceError | None:
    """Return why a service with these servers is not called; None if it can be."""
    foreign = next(filter(None, (foreign_middleware(*server) for server in servers)), "")
    if foreign:
        return not_callable(service, foreign)
    middlewares = {middleware_of(server.gid) for server in servers}
    return served_twice(service, middlewares) if len(middlewares) > 1 else None
