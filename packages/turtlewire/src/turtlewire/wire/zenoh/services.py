"""Clients and servers: queriers and queryables on the service's key."""

from __future__ import annotations

import itertools
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

import zenoh
from zenoh.handlers import Callback as Handler

from turtlewire.errors import WireError
from turtlewire.wire.base import Client, RequestId, Service
from turtlewire.wire.qos import History
from turtlewire.wire.queue_wait_set import Queued
from turtlewire.wire.report import warn_once

from .endpoint import ZenohEndpoint
from .library import reason_of
from .protocol import CLIENT, SERVICE, Attachment, pack_attachment

if TYPE_CHECKING:
    from typing import Any

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS
    from turtlewire.wire.queue_wait_set import Watcher

    from .context_state import Owner, ZenohContextState
    from .protocol import Token

#: The result of an action is awaited without limit.
_NO_LIMIT_S = 1e9


class _QueuedEndpoint(ZenohEndpoint, Queued):
    """An end of a service: a queue of what has not been taken yet."""

    EVENTS = frozenset()

    def __init__(
        self, core: ZenohContextState, node: Owner, service: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(core, node, service, type_id, qos)
        self.service = service
        self.watchers: dict[Watcher, Callable[[], None]] = {}
        self._limit = None if qos.history == History.KEEP_ALL else self.qos.depth
        self._queue: deque[Any] = deque()

    def _append(self, item: Any) -> Any | None:
        """Queue something; returns the oldest if there are too many. With the lock held."""
        self._queue.append(item)
        self.tell_watchers()
        return (
            self._queue.popleft() if len(self._queue) > (self._limit or len(self._queue)) else None
        )

    def _close(self) -> None:
        super()._close()
        self.leave_watchers()
        with self._lock:
            self._queue.clear()


class ZenohClient(_QueuedEndpoint, Client):
    """Asks all servers of its service."""

    KIND = CLIENT

    def __init__(
        self, core: ZenohContextState, node: Owner, service: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(core, node, service, type_id, qos)
        self.client_id = int.from_bytes(self.gid, "little")
        self._numbers = itertools.count(1)
        with core.calls:
            self._querier = core.session.declare_querier(
                self.token.data_key,
                target=zenoh.QueryTarget.ALL_COMPLETE,
                consolidation=zenoh.ConsolidationMode.NONE,
                timeout=_NO_LIMIT_S if "/_action/get_result" in service else None,
            )
        self._handler = Handler(self._on_reply, indirect=False)
        self.announce(self._querier)

    def send_request(self, cdr: bytes) -> int:
        number = next(self._numbers)
        attachment = pack_attachment(number, time.time_ns(), self.gid)
        with self._sending:
            if self._closed:
                raise WireError(f"call {self.service}: the client is closed")
            try:
                with self._core.calls:
                    self._querier.get(self._handler, payload=cdr, attachment=attachment)
            except zenoh.ZError as error:
                raise WireError(f"call {self.service}: {reason_of(error)}") from error
        return number

    def _on_reply(self, reply: zenoh.Reply) -> None:
        """Queue the message; runs on a thread of Zenoh."""
        sample = reply.ok
        if sample is None or sample.attachment is None:
            return  # the timeout has passed, or the server has left: neither is an answer
        try:
            attachment = Attachment.unpack(bytes(sample.attachment))
        except ValueError as error:
            warn_once(f"reply {self.service}", f"a response of {self.service} was lost: {error}")
            return
        response = attachment.sequence_number, bytes(sample.payload)
        with self._lock:
            if not self._closed and self._append(response) is not None:
                _warn_full("client", self.service)

    def is_ready(self) -> bool:
        return bool(self.partners)


class ZenohService(_QueuedEndpoint, Service):
    """Answers the queries of its key."""

    KIND = SERVICE

    def __init__(
        self, core: ZenohContextState, node: Owner, service: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(core, node, service, type_id, qos)
        self._queries: dict[RequestId, zenoh.Query] = {}
        handler = Handler(self._on_query, indirect=False)
        with core.calls:
            queryable = core.session.declare_queryable(self.token.data_key, handler, complete=True)
        self.announce(queryable)

    def _on_query(self, query: zenoh.Query) -> None:
        """Queue the message; runs on a thread of Zenoh."""
        try:
            attachment = Attachment.unpack(bytes(query.attachment or b""))
        except ValueError as error:
            warn_once(f"query {self.service}", f"a request of {self.service} was lost: {error}")
            return
        request_id = RequestId(int.from_bytes(attachment.gid, "little"), attachment.sequence_number)
        request = request_id, bytes(query.payload or b"")
        with self._lock:
            if self._closed:
                return
            self._queries[request_id] = query
            oldest = self._append(request)
            forgotten = self._queries.pop(oldest[0], None) if oldest is not None else None
        if forgotten is not None:
            # Without the lock, because it calls Zenoh.
            forgotten.drop()  # type: ignore[no-untyped-call]
            _warn_full("server", self.service)

    def send_response(self, request_id: RequestId, cdr: bytes) -> None:
        gid = request_id.client_id.to_bytes(16, "little")
        attachment = pack_attachment(request_id.sequence_number, time.time_ns(), gid)
        with self._core.calls:  # when they end, nothing here refers to the query any more
            self._reply(request_id, cdr, attachment)

    def _reply(self, request_id: RequestId, cdr: bytes, attachment: bytes) -> None:
        with self._lock:
            query = self._queries.pop(request_id, None)
        if query is None:
            return
        try:
            query.reply(self.token.data_key, cdr, attachment=attachment)
        except zenoh.ZError as error:
            warn_once(
                f"reply {self.service}",
                f"a response of {self.service} was lost: {reason_of(error)}",
            )
        finally:
            query.drop()  # type: ignore[no-untyped-call]

    def part(self, partner: Token) -> None:
        super().part(partner)
        client_id = int.from_bytes(partner.gid, "little")
        unanswered = [request for request in self._queries if request.client_id == client_id]
        if unanswered:  # on the reader thread, because the lock is held, and it calls Zenoh
            self._core.reader.submit(lambda: self._forget(unanswered))

    def _close(self) -> None:
        super()._close()
        self._forget(list(self._queries))

    def _forget(self, requests: list[RequestId]) -> None:
        """Stop answering, because the server closes or the client has left."""
        with suppress(WireError), self._core.calls:
            self._drop_queries(requests)

    def _drop_queries(self, requests: list[RequestId]) -> None:
        with self._lock:
            queries = [self._queries.pop(request, None) for request in requests]
        for query in filter(None, queries):
            query.drop()  # type: ignore[no-untyped-call]


def _warn_full(who: str, service: str) -> None:
    warn_once(
        f"full {who} {service}",
        f"the queue of a {who} of {service} is full: the oldest was dropped "
        "(its QoS says how many are kept)",
    )
