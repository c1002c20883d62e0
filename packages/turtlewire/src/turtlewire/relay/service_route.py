"""One service in one direction: clients at the far end call a server at the near end."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire.qos import QoS
from turtlewire.wire.report import warn_once

if TYPE_CHECKING:
    from turtlewire.wire.base import Node, RequestId, Service, ServiceTypes

    from .side import Side

__all__ = ["ServiceRoute"]

#: Largest number of requests that wait for a response; beyond it, the oldest is dropped.
_MOST_PENDING = 1000


class ServiceRoute:
    """Carries the requests and responses of one service.

    Args:
        near: Where the server is.
        far: Where its clients are.
        name: The service at the near end.
        types: Its types.
    """

    def __init__(self, near: Side, far: Side, name: str, types: ServiceTypes) -> None:
        self._near, self._far = near, far
        self.types = types
        self._client = near.node.create_client(name, types, QoS())
        self._service: Service | None = None
        self.node: Node | None = None
        self._lock = threading.Lock()
        self._pending: dict[int, RequestId] = {}
        near.serve(self._client, self._carry_responses)

    def offer(self, name: str, node: Node) -> bool:
        """Offer the service at the far end once the server can be called.

        Returns:
            True if it is offered from now on.
        """
        if self._service is not None or not self._client.is_ready():
            return False
        self._service, self.node = node.create_service(name, self.types, QoS()), node
        service = self._service
        self._far.serve(service, lambda: self._carry_requests(service))
        return True

    def _carry_requests(self, service: Service) -> None:
        """Carry requests to the server; runs on the thread of the far end."""
        for request_id, cdr in service.take():
            self._call(request_id, cdr)

    def _call(self, request_id: RequestId, cdr: bytes) -> None:
        try:
            with self._lock:  # the response may arrive before the number is returned
                self._pending[self._client.send_request(cdr)] = request_id
                if len(self._pending) > _MOST_PENDING:
                    del self._pending[next(iter(self._pending))]
        except WireError as error:
            warn_once(f"relay {self._client.service}", error.in_one_line())

    def _carry_responses(self) -> None:
        """Carry responses back; runs on the thread of the near end."""
        for number, cdr in self._client.take():
            with self._lock:
                request_id = self._pending.pop(number, None)
            if request_id is not None and self._service is not None:
                self._service.send_response(request_id, cdr)

    def close(self) -> None:
        """Close both halves."""
        if self._service is not None:
            self._far.forget(self._service)
        self._near.forget(self._client)
