"""Services over two topics, as rmw_cyclonedds does them.

Requests and replies carry a 16-byte id in front of their fields.

The id is the client's number (``uint64``) and a sequence number (``int64``); the server sends it
back, and a client drops replies to others.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from struct import Struct
from typing import TYPE_CHECKING

from turtlewire.errors import UncallableServiceError

from .base import Client, RequestId, Service
from .report import warn_once

if TYPE_CHECKING:
    from .base import Graph, Publisher, Subscription

_ENCAPSULATION = 4
_HEADER = Struct("<Qq")
_BODY = _ENCAPSULATION + _HEADER.size

#: One counter per process, as rmw_cyclonedds has. Requests to Fast DDS bear the numbers of their
#: samples, which do not reach this one: replies of both kinds can come to one client.
_sequence = itertools.count(1 << 40)
#: Advice where servers of one service read requests in different layouts.
ONE_MIDDLEWARE = "Stop one of the servers, or start both with the same RMW_IMPLEMENTATION."


def join_header(request_id: RequestId, cdr: bytes) -> bytes:
    """Put the id between the encapsulation and the fields of a message."""
    return cdr[:_ENCAPSULATION] + _HEADER.pack(*request_id) + cdr[_ENCAPSULATION:]


def split_header(payload: bytes) -> tuple[RequestId, bytes] | None:
    """Take the id out again.

    None when the payload is too short to hold one (a peer on another middleware's service layout).
    """
    if len(payload) < _BODY:
        return None
    return RequestId(*_HEADER.unpack_from(payload, _ENCAPSULATION)), payload[
        :_ENCAPSULATION
    ] + payload[_BODY:]


def not_callable(service: str, middleware: str) -> UncallableServiceError:
    """Return the error that says why a service is not called.

    Args:
        service: Name of the service.
        middleware: Name of the middleware on which its server runs.
    """
    error = UncallableServiceError(
        f"service {service} is not called: its server runs on {middleware}, which would misread "
        "our requests"
    )
    error.with_hint(advice("server"))
    return error


def served_twice(service: str, middlewares: Iterable[str]) -> UncallableServiceError:
    """Return the error that says that servers of a service read requests in different layouts.

    Args:
        service: Name of the service.
        middlewares: Names of the middlewares on which the servers run.
    """
    error = UncallableServiceError(
        f"service {service} is not called: it has servers on {' and '.join(sorted(middlewares))}, "
        "and a request that one understands would be misread by the other"
    )
    error.with_hint(ONE_MIDDLEWARE)
    return error


def require_callable(graph: Graph, service: str) -> None:
    """Make sure that no server of a service would misread requests.

    Raises:
        UncallableServiceError: A server would.
    """
    servers = [server for server in graph.foreign_servers() if server.service == service]
    for server in servers:
        if not server.is_rival:
            raise not_callable(service, server.middleware)
    if servers:
        raise served_twice(service, {server.middleware for server in servers})


def advice(other: str) -> str:
    """Return advice on how the two ends of a service can understand each other.

    Args:
        other: The end on another middleware, for example ``server``.
    """
    return (
        f"Start the {other} with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp, or both ends with "
        "RMW_IMPLEMENTATION=rmw_zenoh_cpp."
    )


class TopicClient(Client):
    """A client made of a publisher of requests and a subscription of replies."""

    def __init__(
        self, service: str, client_id: int, requests: Publisher, replies: Subscription
    ) -> None:
        self.service = service
        self.client_id = client_id
        self.requests = requests
        self.replies = replies

    def send_request(self, cdr: bytes) -> int:
        sequence_number = next(_sequence)
        self.requests.publish(join_header(RequestId(self.client_id, sequence_number), cdr))
        return sequence_number

    def take(self, limit: int = 32) -> list[tuple[int, bytes]]:
        responses = []
        for payload, _ in self.replies.take(limit):
            responses += self.own_response(payload)
        return responses

    def own_response(self, payload: bytes) -> list[tuple[int, bytes]]:
        """Return number and fields of a reply; nothing if it is for another client."""
        split = split_header(payload)
        if split is None:
            _warn_short(self.service, "response")
        elif split[0].client_id == self.client_id:
            return [(split[0].sequence_number, split[1])]
        return []

    def is_ready(self) -> bool:
        return self.requests.subscription_count() > 0 and self.replies.publisher_count() > 0

    def close(self) -> None:
        self.requests.close()
        self.replies.close()


class TopicService(Service):
    """A server made of a subscription of requests and a publisher of replies."""

    def __init__(self, service: str, requests: Subscription, replies: Publisher) -> None:
        self.service = service
        self.requests = requests
        self.replies = replies

    def take(self, limit: int = 32) -> list[tuple[RequestId, bytes]]:
        requests = []
        for payload, _ in self.requests.take(limit):
            split = split_header(payload)
            if split is None:
                self.warn_short("request")
            else:
                requests.append(split)
        return requests

    def warn_short(self, what: str) -> None:
        """Say that a peer with another layout was here."""
        _warn_short(self.service, what)

    def send_response(self, request_id: RequestId, cdr: bytes) -> None:
        self.replies.publish(join_header(request_id, cdr))

    def close(self) -> None:
        self.requests.close()
        self.replies.close()


def _warn_short(service: str, what: str) -> None:
    warn_once(
        f"{service}/{what}",
        f"dropped a {what} of service {service} that is too short to carry its id; the peer's "
        "middleware is not rmw_cyclonedds_cpp",
    )
