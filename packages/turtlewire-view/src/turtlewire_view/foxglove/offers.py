"""The topics and services that clients may use, as the graph has them."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.errors import CdrError, InterfaceError, WireError
from turtlewire.msg import deserialize, get_message, type_hash
from turtlewire.msg.json_messages import cdr_from_json, json_from_message
from turtlewire.wire import names
from turtlewire.wire.base import TypeId
from turtlewire.wire.encapsulation import is_message
from turtlewire_view.foxglove.caller import ServiceCallError
from turtlewire_view.foxglove.channel import FoxgloveChannel
from turtlewire_view.foxglove.protocol import ENCODINGS
from turtlewire_view.foxglove.schemas import ENCODING, schema

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Node
    from turtlewire_view.foxglove.caller import Caller
    from turtlewire_view.foxglove.options import BridgeOptions

__all__ = ["Offers"]

_Change = dict[str, list[Any]]
"""The fields of the frames ``advertise``, ``unadvertise`` and the same of services, by their op."""


class Offers:
    """Keeps channels and services in step with the graph. For the loop's thread.

    Args:
        node: Whose subscriptions the channels make.
        options: What of it is offered.
        now_ns: The simulation's time; 0 without one.
        warn: Takes a line about a topic or service that cannot be offered.

    Attributes:
        channels: By their numbers.
        services: By their numbers.
        service_names: The names of all services of the graph.
    """

    def __init__(
        self,
        node: Node,
        options: BridgeOptions,
        now_ns: Callable[[], int],
        warn: Callable[[str], None],
    ) -> None:
        self._node = node
        self._now_ns = now_ns
        self._warn = warn
        self._hidden = options.include_hidden
        self._topics_allowed = options.patterns("topic_whitelist")
        self._services_allowed = options.patterns("service_whitelist")
        self._has_services = "services" in options.capabilities
        self._numbers = itertools.count(1)
        self._refused: set[tuple[str, str]] = set()
        self._channels: dict[tuple[str, str], FoxgloveChannel] = {}
        self._services: dict[tuple[str, str], _OfferedService] = {}
        self.channels: dict[int, FoxgloveChannel] = {}
        self.services: dict[int, _OfferedService] = {}
        self.service_names: set[str] = set()

    def refresh(self, endpoints: list[EndpointInfo]) -> _Change:
        """Take over the graph's present state; what clients have to learn."""
        topics = self._topics(endpoints)
        services = _servers(endpoints)
        self.service_names = {name for name, _ in services}
        wanted = {
            (name, type_name)
            for name, type_name in services
            if self._has_services and self._offers(name) and self._services_allowed.match(name)
        }
        change = {
            "unadvertise": self._drop_channels(topics.keys()),
            "unadvertiseServices": self._drop_services(wanted),
            "advertise": self._add_channels(topics),
            "advertiseServices": self._add_services(wanted),
        }
        self._refused &= {*topics, *wanted}
        return {op: items for op, items in change.items() if items}

    def close(self) -> None:
        """Leave the wire."""
        for channel in self.channels.values():
            channel.close()

    def _topics(self, endpoints: list[EndpointInfo]) -> dict[tuple[str, str], list[EndpointInfo]]:
        """Publishers by topic and type; our own subscriptions make no topic."""
        found: dict[tuple[str, str], list[EndpointInfo]] = {}
        for end in endpoints:
            if not end.topic.startswith("/") or end.qos.avoid_ros_namespace_conventions:
                continue
            is_publisher = end.kind == "publisher"
            if not is_publisher and end.node is not None and self._is_ours(end.node):
                continue
            if self._offers(end.topic) and self._topics_allowed.match(end.topic):
                publishers = found.setdefault((end.topic, end.type_name), [])
                if is_publisher:
                    publishers.append(end)
        return found

    def _is_ours(self, node: Any) -> bool:
        return (node.name, node.namespace) == (self._node.name, self._node.namespace)

    def _offers(self, name: str) -> bool:
        return self._hidden or not names.is_hidden(name)

    def _drop_channels(self, topics: Any) -> list[int]:
        gone = [self._channels.pop(key) for key in self._channels.keys() - topics]
        for channel in gone:
            del self.channels[channel.number]
            channel.close()
        return sorted(channel.number for channel in gone)

    def _drop_services(self, wanted: set[tuple[str, str]]) -> list[int]:
        gone = [self._services.pop(key) for key in self._services.keys() - wanted]
        for service in gone:
            del self.services[service.number]
        return sorted(service.number for service in gone)

    def _add_channels(self, topics: dict[tuple[str, str], list[EndpointInfo]]) -> list[Any]:
        new = []
        for key, publishers in sorted(topics.items()):
            channel = self._channels.get(key)
            if channel is None and key not in self._refused:
                channel = self._make_channel(*key, publishers)
                if channel is not None:
                    self._channels[key] = self.channels[channel.number] = channel
                    new.append(channel.advertisement())
            if channel is not None:
                try:
                    channel.fit(publishers)
                except WireError as error:
                    self._warn(f"topic {key[0]} cannot be subscribed to: {error}")
        return new

    def _make_channel(
        self, topic: str, type_name: str, publishers: list[EndpointInfo]
    ) -> FoxgloveChannel | None:
        try:
            definition, known_hash = schema(type_name), type_hash(type_name)
        except InterfaceError as error:
            reason = f"its type {type_name} is not installed here ({error})"
            self._refuse("topic", (topic, type_name), reason)
            return None
        their_hash = next((end.type_hash for end in publishers if end.type_hash), known_hash)
        if their_hash != known_hash:  # clients would read other values than were sent
            reason = f"its publisher has another definition of {type_name} than this installation"
            self._refuse("topic", (topic, type_name), reason)
            return None
        type_id = TypeId(type_name, known_hash)
        return FoxgloveChannel(
            next(self._numbers), topic, type_id, definition, self._node, self._now_ns
        )

    def _add_services(self, wanted: set[tuple[str, str]]) -> list[Any]:
        new = []
        for key in sorted(wanted - self._services.keys() - self._refused):
            try:
                service = _offered_service(next(self._numbers), *key)
            except InterfaceError as error:
                reason = f"its type {key[1]} is not installed here ({error})"
                self._refuse("service", key, reason)
                continue
            self._services[key] = self.services[service.number] = service
            new.append(service.advertisement())
        return new

    def _refuse(self, what: str, key: tuple[str, str], reason: str) -> None:
        self._refused.add(key)
        self._warn(f"{what} {key[0]} is not offered: {reason}")


def _servers(endpoints: list[EndpointInfo]) -> set[tuple[str, str]]:
    """Names and types of services with a server; a client alone makes none."""
    return {
        (service, names.service_type(end.type_name))
        for end in endpoints
        if end.kind == "subscription"
        and (service := names.service_of_requests(end.topic)) is not None
    }


class _OfferedService(NamedTuple):
    """A service and the number by which clients call it.

    Attributes:
        number: No other service of the server ever has it.
        name: Fully qualified name.
        type_name: ``std_srvs/srv/SetBool``.
        request_schema: Definition of the requests.
        response_schema: Definition of the responses.
    """

    number: int
    name: str
    type_name: str
    request_schema: str
    response_schema: str

    def advertisement(self) -> dict[str, Any]:
        """Return the announcement for clients; the last two fields are for older ones."""
        return {
            "id": self.number,
            "name": self.name,
            "type": self.type_name,
            "request": self._part("Request", self.request_schema),
            "response": self._part("Response", self.response_schema),
            "requestSchema": self.request_schema,
            "responseSchema": self.response_schema,
        }

    async def call(self, caller: Caller, encoding: str, request: bytes) -> bytes:
        """Return the response, in the encoding of the request.

        Raises:
            ServiceCallError: The request is wrong, or the service cannot be called.
            WireError: The wire refuses the request.
        """
        if encoding not in ENCODINGS:
            raise ServiceCallError(
                f"there is no encoding {encoding!r}; choose from {', '.join(ENCODINGS)}"
            )
        if encoding == "cdr":
            if not is_message(request):
                raise ServiceCallError(
                    f"the request's {len(request)} bytes are not little-endian CDR "
                    "(00 01 00 00, then the fields)"
                )
            return await caller.call(self.name, self.type_name, request)
        try:
            cdr = cdr_from_json(f"{self.type_name}_Request", request)
        except CdrError as error:
            raise ServiceCallError(str(error)) from error
        response = await caller.call(self.name, self.type_name, cdr)
        try:
            return json_from_message(
                deserialize(get_message(f"{self.type_name}_Response"), response)
            )
        except CdrError as error:
            raise ServiceCallError(f"the response cannot be read: {error}") from error

    def _part(self, part: str, definition: str) -> dict[str, str]:
        return {
            "encoding": "cdr",
            "schemaName": f"{self.type_name}_{part}",
            "schemaEncoding": ENCODING,
            "schema": definition,
        }


def _offered_service(number: int, name: str, type_name: str) -> _OfferedService:
    """Return a service with the definitions of its type.

    Raises:
        InterfaceError: The type is not known.
    """
    return _OfferedService(
        number, name, type_name, schema(f"{type_name}_Request"), schema(f"{type_name}_Response")
    )
