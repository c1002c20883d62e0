"""Services as rmw_cyclonedds does them.

Which server belongs to which client is in the user data of their endpoints.
"""

from __future__ import annotations

import ctypes
import threading
import time
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import WireError
from turtlewire.wire.graph import parse_user_data
from turtlewire.wire.report import warn_once
from turtlewire.wire.services import (
    TopicClient,
    TopicService,
    advice,
    join_header,
    not_callable,
    split_header,
)

from . import library as dds
from .endpoint import matched_handles
from .ports import is_cyclone
from .servers import Servers, foreign_among, foreign_middleware, matched_endpoints
from .subscription import is_identified

if TYPE_CHECKING:
    from turtlewire.wire.base import RequestId

    from .publisher import CyclonePublisher
    from .reader import CycloneReaderThread
    from .subscription import CycloneSubscription

__all__ = ["CycloneClient", "CycloneService", "format_service_id"]

#: How long a response waits for the client's end of the reply topic to be discovered.
_PATIENCE_NS = 1_000_000_000
_KNOWN_CLIENTS = 1000


def format_service_id(participant_gid: bytes, number: int) -> str:
    """``clientid`` or ``serviceid`` of an endpoint pair, as in rmw_cyclonedds (` 1.10.a8.…`)."""
    first, *rest = participant_gid[:12] + number.to_bytes(4, "big")
    return f"{first:2x}." + ".".join(f"{byte:x}" for byte in rest)


class CycloneClient(TopicClient):
    """A client: a writer of requests and a reader of replies."""

    requests: CyclonePublisher
    replies: CycloneSubscription

    def __init__(
        self, service: str, requests: CyclonePublisher, replies: CycloneSubscription
    ) -> None:
        handle = ctypes.c_uint64()
        dds.check(dds.get_instance_handle(requests.handle, handle), f"create a client of {service}")
        super().__init__(service, handle.value, requests, replies)
        self._servers = Servers(requests.handle)

    def send_request(self, cdr: bytes) -> int:
        middleware = foreign_among(self._servers.now())
        if middleware:
            raise not_callable(self.service, middleware)
        return super().send_request(cdr)

    def is_ready(self) -> bool:
        """Return True once a server is matched in both directions.

        One and the same server reads our requests and writes replies to us.
        """
        servers = self._servers.now()
        if foreign_among(servers):
            return False
        replies = self.replies.handle
        matched = matched_handles(replies, dds.matched_publications)
        writers = matched_endpoints(replies, matched, dds.matched_publication_data)
        replying = {writer.ids.get("serviceid") for writer in writers}
        return any(server.ids["serviceid"] in replying for server in servers)


class _Waiting(NamedTuple):
    client: str
    deadline_ns: int
    payload: bytes


class CycloneService(TopicService):
    """A server: a reader of requests and a writer of replies.

    A client's request can arrive before its reply reader is discovered; a reply sent now would be
    lost. Such replies wait, on the reader thread, for the discovery.
    """

    requests: CycloneSubscription
    replies: CyclonePublisher

    def __init__(
        self,
        service: str,
        requests: CycloneSubscription,
        replies: CyclonePublisher,
        reader: CycloneReaderThread,
    ) -> None:
        super().__init__(service, requests, replies)
        self._reader = reader
        self._lock = threading.Lock()
        self._clients: dict[int, str] = {}
        self._reachable: set[str | None] = set()
        self._waiting: list[_Waiting] = []
        # Before others learn of the match: they may take requests then.
        requests.on_matched.insert(0, requests.learn_publishers)

    def take(self, limit: int = 32) -> list[tuple[RequestId, bytes]]:
        requests = []
        for payload, info in self.requests.take(limit):
            split = split_header(payload)
            if not is_identified(info.publisher_gid):
                self._warn_unidentified()
            elif not is_cyclone(info.publisher_gid):
                self._warn_foreign(info.publisher_gid)
            elif split is None:
                self.warn_short("request")
            else:
                self._remember(split[0].client_id, info.publisher_gid)
                requests.append(split)
        return requests

    def _warn_unidentified(self) -> None:
        """Say that a request may have another layout; nobody waits for its response."""
        warn_once(
            f"{self.service} request unidentified",
            f"dropped a request of service {self.service}: its client has left, before it was "
            "known on which middleware it runs",
        )

    def _warn_foreign(self, client: bytes) -> None:
        """Say that a request had another layout: ours would be read out of 16 wrong bytes."""
        middleware = foreign_middleware(client, {})
        warn_once(
            f"{self.service} request {middleware}",
            f"dropped a request of service {self.service}: its client runs on {middleware}, whose "
            f"requests have another layout. {advice('client')}",
        )

    def _remember(self, client_id: int, writer_gid: bytes) -> None:
        client = parse_user_data(self.requests.user_data_of(writer_gid)).get("clientid")
        if client is not None:
            if len(self._clients) >= _KNOWN_CLIENTS:
                self._clients.clear()
            self._clients[client_id] = client

    def send_response(self, request_id: RequestId, cdr: bytes) -> None:
        payload = join_header(request_id, cdr)
        client = self._clients.get(request_id.client_id)
        if client is not None and not self._can_reach(client):
            deadline = time.monotonic_ns() + _PATIENCE_NS
            with self._lock:
                self._waiting.append(_Waiting(client, deadline, payload))
            self._reader.call_at(deadline, self.send_waiting)
            if not self._can_reach(client):
                return
            self.send_waiting()
        else:
            self.replies.publish(payload)

    def _can_reach(self, client: str) -> bool:
        """Return True if the client's reply reader has matched.

        It stays known when it has left: a reply to it goes to nobody.
        """
        if client not in self._reachable:
            replies = self.replies.handle
            matched = matched_handles(replies, dds.matched_subscriptions)
            clients = matched_endpoints(replies, matched, dds.matched_subscription_data)
            self._reachable = {each.ids.get("clientid") for each in clients}
        return client in self._reachable

    def matched(self) -> None:
        """On the reader thread: the matching subscriptions of the reply topic are others now."""
        if self._waiting:
            self.send_waiting()

    def send_waiting(self) -> None:
        """Send the waiting replies that can arrive now.

        Those that waited long enough are dropped.
        """
        now = time.monotonic_ns()
        with self._lock:
            ready = [waiting for waiting in self._waiting if self._can_reach(waiting.client)]
            self._waiting = [
                waiting
                for waiting in self._waiting
                if waiting not in ready and waiting.deadline_ns > now
            ]
        for waiting in ready:
            try:
                self.replies.publish(waiting.payload)
            except WireError as error:  # noqa: PERF203 - one client's trouble is not another's
                if not self.replies.closed:  # another thread may close the service meanwhile
                    warn_once(f"reply {self.service}", str(error))
