"""The tools that change something: only where ``--allow`` names the topic or service."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import anyio
import anyio.to_thread

from turtlewire import msg
from turtlewire.cli.assistant.permissions import (
    RefusedCallError,
    bounded_json,
    full_name,
    seconds_within,
)
from turtlewire.msg.json_messages import json_value, message_from_values
from turtlewire.tf.tf_topics import refuse_other_types
from turtlewire.wake_up import LoopWakeUp
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.names import validate_full_topic_name
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable

if TYPE_CHECKING:
    from turtlewire.cli.assistant.network import Network
    from turtlewire.cli.assistant.permissions import Permissions
    from turtlewire.wire.base import Client, Publisher

_TWIST, _TWIST_STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"
_PERIOD_S = 0.1
_LONGEST_DRIVE_S = 5.0
_LONGEST_CALL_S = 30.0
#: How long messages wait for subscriptions to be found, and then to be received [s].
_MATCHING_S, _DELIVERY_S = 2.0, 1.0


class Acting:
    """The tools; their docstrings are what an assistant reads.

    Args:
        network: Where they act.
        permissions: What they may use.
    """

    def __init__(self, network: Network, permissions: Permissions) -> None:
        self._network = network
        self._permissions = permissions
        self._driven: set[str] = set()

    async def publish(self, topic: str, message: dict[str, Any], type: str = "") -> str:  # noqa: A002
        """Publish one message on a topic that the server allows.

        Args:
            topic: Such as /chatter.
            message: Its fields, such as {"data": "hello"}; what is left out is zero or empty.
            type: Such as std_msgs/msg/String; needed only where nobody uses the topic yet.
        """
        name = full_name(topic)
        if name in await self._network.topics():
            name, type_name = await self._network.type_of_topic(name)
        else:
            type_name = self._type_of_new_topic(name, type)
        self._permissions.require(name, "publish to")
        if type_name in {_TWIST, _TWIST_STAMPED}:
            raise RefusedCallError(
                f"Refused to publish a single {type_name}, with which some robots drive on and on. "
                "The tool drive stops the robot at the end."
            )
        filled = message_from_values(type_name, message)
        with self._publisher(name, type_name) as publisher:
            await self._matched(publisher)
            publisher.publish(msg.serialize(filled))
            await _delivered(publisher)
            receivers = publisher.subscription_count()
        return bounded_json({"topic": name, "type": type_name, "subscriptions": receivers})

    async def drive(
        self, topic: str, linear_x: float = 0.0, angular_z: float = 0.0, duration_s: float = 1.0
    ) -> str:
        """Drive a robot with a constant velocity, then stop it.

        Args:
            topic: Of its velocity, such as /turtle1/cmd_vel; the server must allow it.
            linear_x: Forwards, in metres a second.
            angular_z: To the left, in radians a second.
            duration_s: At most 5.
        """
        limit_s = seconds_within(duration_s, "duration_s", _LONGEST_DRIVE_S)
        if not math.isfinite(linear_x) or not math.isfinite(angular_z):
            raise RefusedCallError("linear_x and angular_z must be finite numbers")
        name, type_name = await self._network.type_of_topic(topic)
        self._permissions.require(name, "drive on")
        if type_name not in {_TWIST, _TWIST_STAMPED}:
            raise RefusedCallError(f"{name} has the type {type_name}; drive needs {_TWIST}")
        if name in self._driven:
            raise RefusedCallError(f"Another drive on {name} has not ended; wait for its answer")
        self._driven.add(name)
        try:
            with self._publisher(name, type_name) as publisher:
                if not await self._matched(publisher):
                    raise RefusedCallError(f"Nobody receives {name}: is the robot running?")
                sent = await _drive(publisher, type_name, (linear_x, angular_z), limit_s)
        finally:
            self._driven.discard(name)
        return bounded_json({"topic": name, "twists": sent, "stopped": True})

    async def call_service(
        self, service: str, request: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> str:
        """Call a service that the server allows, and return its response.

        Args:
            service: Such as /spawn.
            request: Its fields, such as {"x": 1.0, "y": 2.0}; what is left out is zero or empty.
            timeout_s: How long to wait for the response, at most 30.
        """
        limit_s = seconds_within(timeout_s, "timeout_s", _LONGEST_CALL_S)
        name, type_name = await self._network.type_of_service(service)
        self._permissions.require(name, "call")
        filled = message_from_values(f"{type_name}_Request", request or {})
        response = await _call(self._network, name, type_name, filled, limit_s)
        return bounded_json({"service": name, "response": json_value(response)})

    def _type_of_new_topic(self, name: str, type_name: str) -> str:
        fault = validate_full_topic_name(name)
        if fault is not None:
            raise RefusedCallError(f"{name}: {fault.message}")
        if not type_name:
            raise RefusedCallError(
                f"Nobody uses the topic {name}; to publish there, also give its type. "
                "The tool list_topics shows the topics that are used."
            )
        return type_name

    @contextmanager
    def _publisher(self, topic: str, type_name: str) -> Iterator[Publisher]:
        refuse_other_types(topic, type_name)
        type_id = TypeId(type_name, msg.type_hash(type_name))
        publisher = self._network.node.create_publisher(topic, type_id, QoS())
        try:
            yield publisher
        finally:
            publisher.close()

    async def _matched(self, publisher: Publisher) -> bool:
        """Wait until the subscriptions that the graph knows are matched."""
        known = len(self._network.graph.endpoints_of(publisher.topic, "subscription"))
        await self._network.until(
            lambda: publisher.subscription_count() >= max(known, 1), _MATCHING_S
        )
        return publisher.subscription_count() > 0


async def _drive(
    publisher: Publisher, type_name: str, velocity: tuple[float, float], limit_s: float
) -> int:
    """Publish twists, and a zero twist at the end, also when the call is cancelled."""
    sent = 0
    begin = anyio.current_time()
    try:
        while (passed := anyio.current_time() - begin) < limit_s:
            publisher.publish(_twist(type_name, *velocity))
            sent += 1
            await anyio.sleep(min(sent * _PERIOD_S, limit_s) - passed)
    finally:
        publisher.publish(_twist(type_name, 0.0, 0.0))
        with anyio.CancelScope(shield=True):
            await _delivered(publisher)
    return sent


def _twist(type_name: str, linear_x: float, angular_z: float) -> bytes:
    message: Any = msg.get_message(type_name)()
    twist = message
    if type_name == _TWIST_STAMPED:
        stamp = message.header.stamp
        stamp.sec, stamp.nanosec = divmod(time.time_ns(), 10**9)
        twist = message.twist
    twist.linear.x, twist.angular.z = linear_x, angular_z
    return msg.serialize(message)


async def _delivered(publisher: Publisher) -> None:
    """Wait until the reliable subscriptions have what was published; not for long."""
    limit_ns = round(_DELIVERY_S * 1e9)
    await anyio.to_thread.run_sync(publisher.wait_for_acknowledgments, limit_ns)


async def _call(
    network: Network, service: str, type_name: str, request: msg.Message, limit_s: float
) -> Any:
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
