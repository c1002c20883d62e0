"""One client: its requests, one method for each."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any

from turtlewire.distro import current_distro
from turtlewire.errors import WireError
from turtlewire_view.foxglove import protocol
from turtlewire_view.foxglove.assets import AssetError, read_asset
from turtlewire_view.foxglove.caller import ServiceCallError
from turtlewire_view.foxglove.protocol import (
    ERROR,
    WARNING,
    ClientMessage,
    ProtocolError,
    integer,
    items,
    names,
    required_text,
    text_or_none,
)
from turtlewire_view.foxglove.publishing import Publishing

if TYPE_CHECKING:
    from turtlewire_view.foxglove.bridge import Bridge
    from turtlewire_view.foxglove.outbox import Outbox
    from turtlewire_view.foxglove.protocol import ServiceRequest

__all__ = ["FoxgloveSession"]

#: How many calls, parameters and files a client may wait for.
_MOST_TASKS = 100
#: How many parameters a client may follow by name.
_MOST_NAMES = 10_000


class FoxgloveSession:
    """The subscriptions and requests of one client. For the loop's thread.

    A wrong request is answered by a status and changes nothing.

    Args:
        bridge: What it may use.
        outbox: What the client has yet to receive.
        name: Who it is, for log lines.
        session_id: Of the server; a client that comes back sees whether it is another one.

    Attributes:
        outbox: What the client has yet to receive.
        wants_connections: Whether it follows the connections.
    """

    def __init__(self, bridge: Bridge, outbox: Outbox, name: str, session_id: str) -> None:
        self.outbox = outbox
        self.wants_connections = False
        self._bridge = bridge
        self._name = name
        self._subscriptions: dict[int, int] = {}  # the client's number to that of the channel
        self._followed: set[str] = set()
        self._follows_all = False
        self._tasks: set[asyncio.Task[None]] = set()
        self._has_room = asyncio.Event()
        self._fetching = asyncio.Lock()
        self._capabilities = bridge.capabilities
        allowed = bridge.options.patterns("client_topic_whitelist")
        self._publishing = Publishing(bridge.node, bridge.graph, allowed)
        self._assets = bridge.options.patterns("asset_uri_allowlist")
        self._requests = self._operations()
        self._greet(session_id)
        bridge.add(self)

    def receive(self, frame: str | bytes) -> None:
        """Do what a frame of the client asks for."""
        try:
            if isinstance(frame, str):
                self._receive_text(frame)
            else:
                self._receive_binary(frame)
        except ProtocolError as error:
            self.tell(ERROR, str(error))
        except WireError as error:
            self.tell(ERROR, f"{error} {error.hint}".rstrip())

    def frame_taken(self) -> None:
        """A frame is about to be sent."""
        if not self.outbox.is_crowded:
            self._has_room.set()

    async def room(self) -> None:
        """Wait until the client has read most of its answers."""
        while self.outbox.is_crowded:
            self._has_room.clear()
            await self._has_room.wait()

    def tell(self, level: int, message: str) -> None:
        """Show the client's user a line."""
        self.outbox.send(protocol.status(level, message))

    def tell_loss(self, subscription_id: int) -> None:
        """Say that the client is too slow for a topic."""
        channel = self._bridge.offers.channels.get(self._subscriptions.get(subscription_id, 0))
        if channel is None:
            return
        limit = self._bridge.options.send_buffer_limit
        message = (
            f"messages of {channel.topic} are lost: this connection is too slow for it "
            f"(send_buffer_limit: {limit} bytes)"
        )
        self.tell(WARNING, message)
        self._bridge.log.warning(f"client {self._name}: {message}")

    def channels_gone(self, numbers: set[int]) -> None:
        """Forget channels that the bridge has closed."""
        for subscription_id, number in list(self._subscriptions.items()):
            if number in numbers:
                del self._subscriptions[subscription_id]

    @property
    def follows_parameters(self) -> bool:
        """True if the client follows any parameter."""
        return self._follows_all or bool(self._followed)

    def wants_parameter(self, name: str) -> bool:
        """Return True if the client follows this parameter."""
        return self._follows_all or name in self._followed

    def close(self) -> None:
        """The client has left: close everything that only this client used."""
        self._bridge.remove(self)
        for number in self._subscriptions.values():
            self._bridge.offers.channels[number].remove(self.outbox)
        self._subscriptions.clear()
        self.outbox.close()
        self._publishing.close()
        for task in self._tasks:
            task.cancel()
        self._bridge.follow_parameters()

    # -- frames

    def _operations(self) -> dict[str, tuple[str, Callable[[dict[str, Any]], None]]]:
        """Return the operations of text frames, each with the capability that it needs."""
        return {
            "subscribe": ("", self._subscribe),
            "unsubscribe": ("", self._unsubscribe),
            "advertise": ("clientPublish", self._advertise),
            "unadvertise": ("clientPublish", self._unadvertise),
            "getParameters": ("parameters", self._get_parameters),
            "setParameters": ("parameters", self._set_parameters),
            "subscribeParameterUpdates": ("parametersSubscribe", self._follow_parameters),
            "unsubscribeParameterUpdates": ("parametersSubscribe", self._unfollow_parameters),
            "subscribeConnectionGraph": ("connectionGraph", self._follow_connections),
            "unsubscribeConnectionGraph": ("connectionGraph", self._unfollow_connections),
            "fetchAsset": ("assets", self._fetch_asset),
        }

    def _greet(self, session_id: str) -> None:
        takes_messages = {"clientPublish", "services"} & {*self._capabilities}
        self.outbox.send(
            protocol.text(
                "serverInfo",
                name="turtlewire",
                capabilities=self._capabilities,
                supportedEncodings=list(protocol.ENCODINGS) if takes_messages else None,
                metadata={"ROS_DISTRO": str(current_distro())},
                sessionId=session_id,
            )
        )

    def _receive_text(self, frame: str) -> None:
        request = protocol.parse_text(frame)
        op = request["op"]
        if op not in self._requests:
            raise ProtocolError(f"there is no operation {op!r}")
        capability, act = self._requests[op]
        self._require(capability, op)
        act(request)

    def _receive_binary(self, frame: bytes) -> None:
        parsed = protocol.parse_binary(frame)
        if isinstance(parsed, ClientMessage):
            self._require("clientPublish", "publishing")
            self._publishing.publish(parsed.channel_id, parsed.payload)
        else:
            self._require("services", "calling services")
            self._call_service(parsed)

    def _require(self, capability: str, what: str) -> None:
        if capability and capability not in self._capabilities:
            raise ProtocolError(
                f"{what} is not supported: the server does not have the capability {capability}"
            )

    # -- subscriptions

    def _subscribe(self, request: dict[str, Any]) -> None:
        for item in items(request, "subscriptions"):
            subscription_id, number = integer(item, "id"), integer(item, "channelId")
            channel = self._bridge.offers.channels.get(number)
            if channel is None:
                self.tell(WARNING, f"there is no channel {number}")
            elif subscription_id in self._subscriptions:
                self.tell(ERROR, f"there is a subscription {subscription_id} already")
            elif number in self._subscriptions.values():
                self.tell(WARNING, f"{channel.topic} is subscribed to already")
            else:
                self._subscriptions[subscription_id] = number
                try:
                    channel.add(self.outbox, subscription_id)
                except WireError:
                    del self._subscriptions[subscription_id]
                    raise

    def _unsubscribe(self, request: dict[str, Any]) -> None:
        for subscription_id in items(request, "subscriptionIds", int):
            number = self._subscriptions.pop(subscription_id, None)
            if number is None:
                self.tell(WARNING, f"there is no subscription {subscription_id}")
            else:
                self._bridge.offers.channels[number].remove(self.outbox)

    # -- publishing

    def _advertise(self, request: dict[str, Any]) -> None:
        for item in items(request, "channels"):
            channel_id = integer(item, "id")
            topic, encoding, schema_name = (
                required_text(item, field) for field in ("topic", "encoding", "schemaName")
            )
            try:
                self._publishing.advertise(channel_id, topic, encoding, schema_name)
            except ProtocolError as error:
                self.tell(ERROR, str(error))
            else:
                self._bridge.log.info(f"client {self._name} publishes {topic} ({schema_name})")

    def _unadvertise(self, request: dict[str, Any]) -> None:
        for channel_id in items(request, "channelIds", int):
            if not self._publishing.unadvertise(channel_id):
                self.tell(WARNING, f"there is no channel {channel_id}")

    # -- services

    def _call_service(self, request: ServiceRequest) -> None:
        service = self._bridge.offers.services.get(request.service_id)

        def fail(message: str) -> None:
            ids = {"serviceId": request.service_id, "callId": request.call_id}
            self.outbox.send(protocol.text("serviceCallFailure", **ids, message=message))

        async def call() -> None:
            if service is None:
                fail(f"there is no service {request.service_id}")
                return
            try:
                response = await service.call(
                    self._bridge.caller, request.encoding, request.payload
                )
            except (ServiceCallError, WireError) as error:
                fail(str(error))
            else:
                self.outbox.send(
                    protocol.service_response(
                        request.service_id, request.call_id, request.encoding, response
                    )
                )

        self._start(call(), fail)

    # -- parameters

    def _get_parameters(self, request: dict[str, Any]) -> None:
        wanted, request_id = names(request), text_or_none(request, "id")
        self._start(self._send_parameters(wanted, request_id))

    def _set_parameters(self, request: dict[str, Any]) -> None:
        wanted = items(request, "parameters")
        for each in wanted:
            required_text(each, "name")
            text_or_none(each, "type")
        request_id = text_or_none(request, "id")

        async def write() -> None:
            for problem in await self._bridge.parameters.write(wanted):
                self.tell(ERROR, problem)
            if request_id is not None:
                await self._send_parameters([each["name"] for each in wanted], request_id)

        self._start(write())

    async def _send_parameters(self, wanted: list[str], request_id: str | None) -> None:
        values, problems = await self._bridge.parameters.read(wanted)
        for problem in problems:
            self.tell(WARNING, problem)
        self.outbox.send(protocol.text("parameterValues", parameters=values, id=request_id))

    def _follow_parameters(self, request: dict[str, Any]) -> None:
        wanted = names(request)
        if len(self._followed) + len(wanted) > _MOST_NAMES:
            raise ProtocolError(f"a client follows at most {_MOST_NAMES} parameters by name")
        self._followed.update(wanted)
        self._follows_all |= not wanted
        self._bridge.follow_parameters()

    def _unfollow_parameters(self, request: dict[str, Any]) -> None:
        unwanted = names(request)
        self._followed.difference_update(unwanted)
        if not unwanted:
            self._followed.clear()
            self._follows_all = False
        self._bridge.follow_parameters()

    # -- connections and files

    def _follow_connections(self, _request: dict[str, Any]) -> None:
        if not self.wants_connections:
            self.wants_connections = True
            self._bridge.show_connections(self)

    def _unfollow_connections(self, _request: dict[str, Any]) -> None:
        self.wants_connections = False

    def _fetch_asset(self, request: dict[str, Any]) -> None:
        uri, request_id = required_text(request, "uri"), integer(request, "requestId")

        def fail(message: str) -> None:
            self.outbox.send(protocol.asset_error(request_id, message))

        async def fetch() -> None:
            find_share = self._bridge.find_share
            async with self._fetching:  # one large file at a time waits in memory
                await self.room()
                try:
                    content = await asyncio.to_thread(read_asset, uri, self._assets, find_share)
                except AssetError as error:
                    fail(str(error))
                else:
                    self.outbox.send(protocol.asset(request_id, content))

        self._start(fetch(), fail)

    def _start(
        self, work: Coroutine[Any, Any, None], fail: Callable[[str], None] | None = None
    ) -> None:
        """Run a call while further requests are served."""
        if len(self._tasks) >= _MOST_TASKS:
            work.close()
            message = f"{_MOST_TASKS} requests wait for their answers already"
            (fail or (lambda text: self.tell(ERROR, text)))(message)
            return
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._finish)

    def _finish(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self._bridge.log.warning(f"client {self._name}: a request failed: {error!r}")
            self.tell(ERROR, f"the request failed: {error!r}")
