"""Sends the requests that a bag of service events holds to the services again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosbag2_transport.options import ServiceRequestsSource
from turtlewire.errors import InterfaceError, UncallableServiceError
from turtlewire.msg import deserialize, get_message, serialize, type_hash
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable

if TYPE_CHECKING:
    from collections.abc import Callable, Container

    from rclpy.node import Node
    from turtlewire.bag import TopicInfo
    from turtlewire.wire.base import Client

__all__ = ["ServiceRequests"]

_REQUEST_SENT, _REQUEST_RECEIVED = 0, 1


class ServiceRequests:
    """Clients of recorded services.

    Args:
        node: The node whose clients they are.
        source: Whose record of a request counts.
    """

    def __init__(self, node: Node, source: ServiceRequestsSource) -> None:
        self._node = node
        by_client = source is ServiceRequestsSource.CLIENT_INTROSPECTION
        self._kind = _REQUEST_SENT if by_client else _REQUEST_RECEIVED
        self._clients: list[Client] = []
        self._told: set[str] = set()

    def sender(self, topic: TopicInfo) -> Callable[[bytes], None]:
        """Return a function that sends the requests among a service's events."""
        service = self._node.resolve_service_name(topic.name.removesuffix("/_service_event"))
        type_name = topic.type.removesuffix("_Event")
        try:
            request, response = (
                TypeId(f"{type_name}_{part}", type_hash(f"{type_name}_{part}"))
                for part in ("Request", "Response")
            )
            types = ServiceTypes(type_name, request, response, type_hash)
        except InterfaceError as error:
            self._tell(service, f"no requests are sent to {service}: {error}")
            return lambda _event: None
        client = self._node._rclpy_wire.create_client(service, types, QoS())
        self._clients.append(client)
        return lambda event: self._send(client, topic.type, event)

    def are_matched(self, services: Container[str]) -> bool:
        """Return True if the clients of all services that exist can send."""
        return all(client.service not in services or client.is_ready() for client in self._clients)

    def _send(self, client: Client, event_type: str, data: bytes) -> None:
        client.take(1000)  # answers are discarded, because they must not accumulate
        if data[4] != self._kind:  # the event's kind is its first byte
            return
        event = deserialize(get_message(event_type), data)
        requests = event.request  # type: ignore[attr-defined]  # each event type has it
        if not requests:
            self._tell(
                client.service,
                f"the events of {client.service} do not contain the requests: record with the "
                "introspection state 'contents'",
            )
        elif not client.is_ready():
            self._tell(client.service, f"no request is sent: {self._why_not_ready(client)}")
        else:
            client.send_request(serialize(requests[0]))

    def _why_not_ready(self, client: Client) -> str:
        try:
            require_callable(self._node.context.wire.graph, client.service)
        except UncallableServiceError as error:
            return error.in_one_line()
        return f"{client.service} has no server"

    def _tell(self, service: str, text: str) -> None:
        if service not in self._told:
            self._told.add(service)
            self._node.get_logger().warning(text)

    def close(self) -> None:
        """Leave the graph."""
        for client in self._clients:
            client.close()
