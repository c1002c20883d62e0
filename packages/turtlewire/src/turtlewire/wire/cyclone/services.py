"""Services in the layout of rmw_cyclonedds and in that of Fast DDS.

On rmw_cyclonedds, the user data of endpoints links the reader and the writer of a service.
"""

from __future__ import annotations

import ctypes
import threading
import time
from collections.abc import Callable
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
from .fast_dds import FAST_DDS, FirstRequests, guid_of_client, split_identity
from .ports import is_cyclone, process_of
from .servers import (
    MatchedEndpoint,
    Servers,
    is_fast_dds,
    matched_endpoints,
    middleware_of,
    refusal,
)
from .subscription import is_identified

if TYPE_CHECKING:
    from turtlewire.wire.base import RequestId

    from .publisher import CyclonePublisher
    from .reader import CycloneReaderThread
    from .subscription import CycloneSubscription

#: How long a response waits until the client's end of the reply topic is discovered, which takes
#: seconds on a busy machine.
_PATIENCE_NS = 10_000_000_000
_KNOWN_CLIENTS = 1000
#: The bit of the last byte of a GUID that distinguishes readers from writers.
_READER = 4


def format_service_id(participant_gid: bytes, number: int) -> str:
    """``clientid`` or ``serviceid`` of an endpoint pair, as in rmw_cyclonedds (` 1.10.a8.…`)."""
    first, *rest = participant_gid[:12] + number.to_bytes(4, "big")
    return f"{first:2x}." + ".".join(f"{byte:x}" for byte in rest)


class IdentifiedRequests:
    """Sends requests with their identity in the inline QoS.

    Args:
        requests: A separate writer, which Fast DDS matches. It does not match the writer of
            requests in Cyclone's layout, so it can never receive one of those.
        reader: The GUID of the reader of replies.
        refuse: Raises if one of the servers that match would misread a request.
    """

    def __init__(
        self,
        requests: CyclonePublisher,
        reader: bytes,
        refuse: Callable[[list[MatchedEndpoint]], None],
    ) -> None:
        self.requests = requests
        self.servers = Servers(requests.handle)
        self._reader = reader
        self._refuse = refuse
        self._lock = threading.Lock()
        self._sent = 0

    def send(self, cdr: bytes) -> int | None:
        """Send a request, unless servers on Cyclone have just replaced the ones on Fast DDS.

        Returns:
            The sequence number that the reply will carry; None if nothing was sent.
        """
        from turtlewire._native import NUMBER_OF_SAMPLE

        with self._lock:
            servers = self.servers.now()
            self._refuse(servers)
            if not all(is_fast_dds(server.gid) for server in servers):
                return None
            # Without its identity, the request would still be valid: the reply would name the
            # writer.
            self.requests.publish_identified(cdr, self._reader, NUMBER_OF_SAMPLE)
            # DDS numbers the samples of a writer in the same way: this is the sample's number.
            self._sent += 1
            return self._sent

    def is_ours(self, guid: bytes) -> bool:
        """Return True if a reply with this GUID answers one of the requests."""
        return guid in {self._reader, self.requests.gid}


class CycloneClient(TopicClient):
    """A client: a writer of requests and a reader of replies.

    Args:
        service: Name of the service.
        requests: Writer in the layout of rmw_cyclonedds.
        replies: Reader of all replies.
        open_requests: Makes a writer of requests to Fast DDS; called when such a server appears.
    """

    requests: CyclonePublisher
    replies: CycloneSubscription

    def __init__(
        self,
        service: str,
        requests: CyclonePublisher,
        replies: CycloneSubscription,
        open_requests: Callable[[], CyclonePublisher],
    ) -> None:
        handle = ctypes.c_uint64()
        dds.check(dds.get_instance_handle(requests.handle, handle), f"create a client of {service}")
        super().__init__(service, handle.value, requests, replies)
        self._servers = Servers(requests.handle)
        self._open_requests = open_requests
        self._lock = threading.Lock()
        self._closed = False
        self._identified: IdentifiedRequests | None = None
        self._is_prepared = FAST_DDS.prepare(replies)
        # Before others learn of the match: they may ask whether the service is ready then.
        requests.on_matched.insert(0, self._servers_changed)
        self._servers_changed()

    def _servers_changed(self) -> None:
        """Open a writer of requests to Fast DDS once a server there is matched."""
        if self._identified is not None or not any(map(_on_fast_dds, self._servers.now())):
            return
        if FAST_DDS.obstacle or not self._is_prepared:
            FAST_DDS.say_obstacle()
            return
        with self._lock:
            if self._closed or self._identified is not None:
                return
            try:
                requests = self._open_requests()
                if not FAST_DDS.prepare(requests):
                    self._is_prepared = False
                    requests.close()
                    return
            except WireError as error:
                if not self.requests.closed:  # else another thread has closed the node
                    warn_once(f"requests {self.service}", str(error))
                return
            self._identified = IdentifiedRequests(requests, self.replies.gid, self._refuse)

    def _refuse(self, servers: list[MatchedEndpoint]) -> None:
        why = refusal(self.service, servers)
        if why is not None:
            raise why

    def send_request(self, cdr: bytes) -> int:
        servers = self._servers.now()
        self._refuse(servers)
        if any(map(_on_fast_dds, servers)):
            self._servers_changed()
            if self._identified is None:
                raise not_callable(self.service, middleware_of(servers[0].gid))
            if (number := self._identified.send(cdr)) is not None:
                return number
        return super().send_request(cdr)

    def take(self, limit: int = 32) -> list[tuple[int, bytes]]:
        responses = []
        for payload, info in self.replies.take(limit):
            if (identified := split_identity(payload)) is not None:
                (client_id, number), cdr = identified
                if self._identified and self._identified.is_ours(guid_of_client(client_id)):
                    responses.append((number, cdr))
            elif not is_fast_dds(info.publisher_gid):  # from there, it is for another client
                responses += self.own_response(payload)
        return responses

    def is_ready(self) -> bool:
        """Return True once a server is matched in both directions.

        One and the same server reads our requests and writes replies to us.
        """
        servers = self._servers.now()
        if refusal(self.service, servers) is not None:
            return False
        replies = self.replies.handle
        matched = matched_handles(replies, dds.matched_publications)
        writers = matched_endpoints(replies, matched, dds.matched_publication_data)
        if any(map(_on_fast_dds, servers)):  # which announce no serviceid
            replying = {process_of(writer.gid) for writer in writers}
            found = [] if self._identified is None else self._identified.servers.now()
            return any(process_of(server.gid) in replying for server in found)
        serving = {writer.ids.get("serviceid") for writer in writers}
        return any(server.ids["serviceid"] in serving for server in servers)

    def close(self) -> None:
        if self.requests.is_inherited:
            return
        with self._lock:
            self._closed = True
            identified = self._identified
        if identified is not None:
            identified.requests.close()
        super().close()


def _on_fast_dds(server: MatchedEndpoint) -> bool:
    return is_fast_dds(server.gid)


class _Reply(NamedTuple):
    """A reply, with the GUID and the number of its inline QoS; no GUID for rmw_cyclonedds."""

    payload: bytes
    guid: bytes = b""
    number: int = 0


class _Waiting(NamedTuple):
    client: str | bytes
    deadline_ns: int
    reply: _Reply


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
        addresses: list[tuple[int, int]],
    ) -> None:
        super().__init__(service, requests, replies)
        self._reader = reader
        self._lock = threading.Lock()
        self._clients: dict[int, str] = {}
        self._reachable: set[str | bytes | None] = set()
        self._waiting: list[_Waiting] = []
        if FAST_DDS.prepare(replies):  # else no request is understood, so that none is answered
            FAST_DDS.prepare(requests)
        # Before others learn of the match: they may take requests then.
        requests.on_matched.insert(0, requests.learn_publishers)
        if not FAST_DDS.obstacle:
            first_requests = FirstRequests(requests.handle, requests.gid, addresses)
            requests.on_closing.append(first_requests.close)

    def take(self, limit: int = 32) -> list[tuple[RequestId, bytes]]:
        requests = []
        for payload, info in self.requests.take(limit):
            identified = split_identity(payload)
            split = split_header(payload)
            if identified is not None and not FAST_DDS.obstacle:
                requests.append(identified)
            elif not is_identified(info.publisher_gid):
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
        """Warn that a request may have another layout; no client waits for the response."""
        warn_once(
            f"{self.service} request unidentified",
            f"dropped a request of service {self.service}: its client has left, before it was "
            "known on which middleware it runs",
        )

    def _warn_foreign(self, client: bytes) -> None:
        """Say that a request had another layout: ours would be read out of 16 wrong bytes."""
        middleware = middleware_of(client)
        if is_fast_dds(client):
            FAST_DDS.say_obstacle()
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
        client: str | bytes | None
        guid = guid_of_client(request_id.client_id)
        if guid:
            reply = _Reply(cdr, guid, request_id.sequence_number)
            # A client that named its writer says nothing about its reader.
            client = guid if guid[-1] & _READER else None
        else:
            reply = _Reply(join_header(request_id, cdr))
            client = self._clients.get(request_id.client_id)
        if client is not None and not self._can_reach(client):
            deadline = time.monotonic_ns() + _PATIENCE_NS
            with self._lock:
                self._waiting.append(_Waiting(client, deadline, reply))
            self._reader.call_at(deadline, self.send_waiting)
            if not self._can_reach(client):
                return
            self.send_waiting()
        else:
            self._send(reply)

    def _send(self, reply: _Reply) -> None:
        if reply.guid:
            self.replies.publish_identified(*reply)
        else:
            self.replies.publish(reply.payload)

    def _can_reach(self, client: str | bytes) -> bool:
        """Return True if the client's reply reader has matched.

        It stays known when it has left: a reply to it goes to nobody.
        """
        if client not in self._reachable:
            replies = self.replies.handle
            matched = matched_handles(replies, dds.matched_subscriptions)
            clients = matched_endpoints(replies, matched, dds.matched_subscription_data)
            self._reachable = {each.ids.get("clientid") for each in clients}
            self._reachable.update(each.gid for each in clients)
        return client in self._reachable

    def matched(self) -> None:
        """Handle a change of the reply topic's subscriptions; runs on the reader thread."""
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
                self._send(waiting.reply)
            except WireError as error:  # noqa: PERF203 - one client's trouble is not another's
                if not self.replies.closed:  # another thread may have closed the service
                    warn_once(f"reply {self.service}", str(error))
