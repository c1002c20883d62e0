"""Calls of services on the wire, for asyncio."""

from __future__ import annotations

import asyncio
import threading
from typing import TYPE_CHECKING

from turtlewire.errors import UncallableServiceError, WireError
from turtlewire.msg import type_hash
from turtlewire.wire.base import Client, ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable

if TYPE_CHECKING:
    from turtlewire.web.loop_calls import LoopCalls
    from turtlewire.wire.base import Context, Node
    from turtlewire_view.foxglove.connections import GraphWatch

__all__ = ["Caller", "ServiceCallError"]

#: How long a call waits for the service to be found [s].
_PATIENCE = 5.0
#: How many requests a service has at a time: a server in ROS 2 keeps 10, and loses further ones.
_AT_ONCE = 8


class ServiceCallError(Exception):
    """A service was not called, or did not answer; the text says why."""


class _Connection:
    """The client of one service, and the calls that it waits for."""

    def __init__(self, client: Client) -> None:
        self.client = client
        self.pending: dict[int, asyncio.Future[bytes]] = {}
        self.turns = asyncio.Semaphore(_AT_ONCE)


class Caller:
    """Calls services; for the loop's thread. A separate thread waits for responses.

    Args:
        context: The participant.
        node: Whose clients it makes, one for each service that is called.
        calls: Of the loop.
        watch: Tells when services come.
    """

    def __init__(self, context: Context, node: Node, calls: LoopCalls, watch: GraphWatch) -> None:
        self._graph = context.graph
        self._node = node
        self._calls = calls
        self._watch = watch
        self._connections: dict[tuple[str, str], _Connection] = {}
        self._of_client: dict[Client, _Connection] = {}
        self._wait_set = context.create_wait_set()
        self._is_closed = False
        self._thread = threading.Thread(target=self._take, name="foxglove-replies", daemon=True)
        self._thread.start()

    async def call(
        self, service: str, type_name: str, request: bytes, limit_s: float | None = None
    ) -> bytes:
        """Return the response of a service, as CDR.

        Args:
            service: Fully qualified name.
            type_name: ``std_srvs/srv/SetBool``.
            request: As CDR.
            limit_s: How long the service may take [s]; None waits until the service goes.

        Raises:
            ServiceCallError: The service does not exist, would misread the request, disappeared, or
                did not answer in time.
            WireError: The wire refuses the request.
        """
        connection = self._connection(service, type_name)
        try:
            require_callable(self._graph, service)
        except UncallableServiceError as error:
            raise ServiceCallError(error.in_one_line()) from None
        if not await self._watch.wait_until(connection.client.is_ready, _PATIENCE):
            raise ServiceCallError(f"service {service} is not available")
        async with connection.turns:
            if connection.client not in self._of_client:
                raise ServiceCallError(f"service {service} went away")
            number = connection.client.send_request(request)
            future = asyncio.get_running_loop().create_future()
            connection.pending[number] = future
            try:
                return await asyncio.wait_for(future, limit_s)
            except asyncio.TimeoutError:
                text = f"service {service} did not answer within {limit_s:g} s"
                raise ServiceCallError(text) from None
            finally:
                connection.pending.pop(number, None)

    def forget_all_but(self, services: set[str]) -> None:
        """Close the clients of services that are gone; calls that wait for them fail."""
        for key in [key for key in self._connections if key[0] not in services]:
            connection = self._connections.pop(key)
            del self._of_client[connection.client]
            connection.client.close()
            for future in connection.pending.values():
                if not future.done():
                    future.set_exception(ServiceCallError(f"service {key[0]} went away"))

    def close(self) -> None:
        """Close all clients; calls that wait fail."""
        self._is_closed = True
        self._wait_set.wake()
        self._thread.join()
        self.forget_all_but(set())
        self._wait_set.close()

    def _connection(self, service: str, type_name: str) -> _Connection:
        key = (service, type_name)
        if key not in self._connections:
            request, response = _type_id(f"{type_name}_Request"), _type_id(f"{type_name}_Response")
            types = ServiceTypes(type_name, request, response, type_hash)
            connection = _Connection(self._node.create_client(service, types, QoS(depth=100)))
            self._connections[key] = self._of_client[connection.client] = connection
            self._wait_set.attach(connection.client)
        return self._connections[key]

    def _take(self) -> None:
        """Take responses; runs on the thread that waits for them."""
        while not self._is_closed:
            for client in self._wait_set.wait():
                if isinstance(client, Client):
                    try:
                        responses = client.take()
                    except WireError:  # the loop's thread has just closed it
                        continue
                    self._calls.soon(self._hand_out, client, responses)

    def _hand_out(self, client: Client, responses: list[tuple[int, bytes]]) -> None:
        connection = self._of_client.get(client)
        if connection is None:
            return
        for number, cdr in responses:
            future = connection.pending.get(number)
            if future is not None and not future.done():
                future.set_result(cdr)


def _type_id(name: str) -> TypeId:
    return TypeId(name, type_hash(name))
