"""One service in one direction: clients at the far end call a server at the near end."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from turtlewire import msg
from turtlewire.errors import InterfaceError, WireError
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.report import warn_once

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.wire.base import EndpointInfo, Node, RequestId, Service

    from .side import Side

__all__ = ["ServiceRoute", "installed_hash", "service_types"]

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


def service_types(
    type_name: str, on_dds: Iterable[EndpointInfo], on_zenoh: Iterable[EndpointInfo]
) -> ServiceTypes:
    """Return the types of a service; a hash that is not known is empty.

    On DDS, the two halves of a service announce the hashes of their own types. On Zenoh, both
    announce the hash of the service, which cannot be computed from those. So the hash of a service
    without an installed definition is known only once an end on Zenoh has announced it.

    Args:
        type_name: Name of the type (``turtlesim/srv/Spawn``).
        on_dds: Its servers and clients on DDS.
        on_zenoh: Its servers and clients on Zenoh.
    """
    parts = f"{type_name}_Request", f"{type_name}_Response"
    announced = {each.type_name: each.type_hash for each in on_dds if each.type_hash}
    installed = {name: installed_hash(name) for name in (type_name, *parts)}
    is_another = any(announced.get(part, installed[part]) != installed[part] for part in parts)
    hashes = (each.type_hash for each in on_zenoh if each.type_name in parts)
    whole = next(hashes, "" if is_another else installed[type_name])
    request, response = (TypeId(part, announced.get(part, installed[part])) for part in parts)
    return ServiceTypes(type_name, request, response, lambda _: whole)


def installed_hash(type_name: str) -> str:
    """Return the hash of an installed definition; empty if it is not installed."""
    try:
        return msg.type_hash(type_name)
    except InterfaceError:
        return ""
