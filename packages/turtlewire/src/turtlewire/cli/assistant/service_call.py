"""A request to a service, and its response."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import anyio

from turtlewire import msg
from turtlewire.cli.assistant.permissions import RefusedCallError
from turtlewire.wake_up import LoopWakeUp
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable

if TYPE_CHECKING:
    from turtlewire.cli.assistant.network import Network
    from turtlewire.wire.base import Client

__all__ = ["call"]


async def call(
    network: Network, service: str, type_name: str, request: msg.Message, limit_s: float
) -> msg.Message:
    """Return the response of a service.

    Args:
        network: Where the service is.
        service: Its full name.
        type_name: Its type.
        request: What it is asked.
        limit_s: How long to wait, for the service and for its response.

    Raises:
        RefusedCallError: The service did not answer in time.
        UncallableServiceError: Its server would misread the request.
    """
    require_callable(network.graph, service)
    request_type, response_type = (
        TypeId(name, msg.type_hash(name))
        for name in (f"{type_name}_Request", f"{type_name}_Response")
    )
    types = ServiceTypes(type_name, request_type, response_type, msg.type_hash)
    client = network.node.create_client(service, types, QoS())
    try:
        with anyio.move_on_after(limit_s):
            await network.until(client.is_ready, limit_s)
            number = client.send_request(msg.serialize(request))
            data = await _response(network, client, number)
            return msg.deserialize(msg.get_message(f"{type_name}_Response"), data)
    finally:
        client.close()
    raise RefusedCallError(
        f"{service} did not answer within {limit_s:g} s. It may still do what it was asked; "
        "timeout_s sets how long to wait."
    )


async def _response(network: Network, client: Client, number: int) -> bytes:
    ready = LoopWakeUp(asyncio.get_running_loop())
    while True:
        for found, data in client.take():
            if found == number:
                return data
        stop = network.context.call_when_ready(client, ready.set)
        try:
            await ready.wait()
        finally:
            stop()
