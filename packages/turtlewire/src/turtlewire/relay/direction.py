"""Follows the graphs and keeps a route for each topic and service that is carried one way."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from turtlewire.tf.listener import TYPE_NAME
from turtlewire.wire import names
from turtlewire.wire.base import TypeId
from turtlewire.wire.report import warn_once

from .routes import ServiceRoute, TopicRoute, installed_hash, service_types

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Node

    from .side import Seen, Side

_Key = tuple[str, str]  # name at the near end, and type


class Ways:
    """Functions that change what is carried.

    Args:
        name: Returns the name at the far end; None if it is not carried.
        back: Returns the name at the near end; None if it is not carried.
        node: Returns the name that a node of the near end has at the far end.
        transforms: Changes messages of transforms; None leaves them as they are.
    """

    def __init__(
        self,
        name: Callable[[str], str | None],
        back: Callable[[str], str | None],
        node: Callable[[str], str],
        transforms: Callable[[bytes], bytes | None] | None,
    ) -> None:
        self.name, self.back, self.node = name, back, node
        self.transforms = transforms


class Direction:
    """Carries topics from the near end to the far one, and calls from the far end to the near one.

    Args:
        near: Where publishers and servers are.
        far: Where subscriptions and clients are.
        ways: Change what is carried.
        say: Gets a line for each topic and service that is carried.
    """

    def __init__(self, near: Side, far: Side, ways: Ways, say: Callable[[str], None]) -> None:
        self._near, self._far = near, far
        self._ways = ways
        self._say = say
        self._topics: dict[_Key, TopicRoute] = {}
        self._services: dict[_Key, ServiceRoute] = {}

    @property
    def nodes(self) -> set[Node]:
        """The nodes of the far end that own something."""
        owners = {route.node for route in self._services.values() if route.node is not None}
        return owners.union(*(route.nodes for route in self._topics.values()))

    def update(self, near: Seen, far: Seen) -> float | None:
        """Follow the graphs; return when to look again (monotonic seconds), or None."""

        def node_for(endpoint: EndpointInfo) -> Node:
            if endpoint.node is None:
                return self._far.node
            own = names.fully_qualified_node_name(endpoint.node.name, endpoint.node.namespace)
            return self._far.node_for(self._ways.node(own), far)

        self._update_services(near, far, node_for)
        return self._update_topics(near, far, node_for)

    def close(self) -> None:
        """Close everything that it carries."""
        while self._topics:
            self._topics.popitem()[1].close()
        while self._services:
            self._services.popitem()[1].close()

    # -- topics

    def _update_topics(
        self, near: Seen, far: Seen, node_for: Callable[[EndpointInfo], Node]
    ) -> float | None:
        publishers = _topics_of(near, "publisher")
        subscriptions = {
            (topic, type_name): ends
            for (far_topic, type_name), ends in _topics_of(far, "subscription").items()
            if (topic := self._ways.back(far_topic)) is not None
        }
        for key in publishers.keys() | subscriptions.keys() - self._topics.keys():
            known = (publishers.get(key) or subscriptions[key])[0]
            self._open_topic(key, known.type_hash)
        deadlines = []
        for key, route in list(self._topics.items()):
            deadlines.append(
                route.update(
                    publishers.get(key, []), subscriptions.get(key, []), near.relayed, node_for
                )
            )
            if route.is_empty:
                del self._topics[key]
        return min(filter(None, deadlines), default=None)

    def _open_topic(self, key: _Key, type_hash: str) -> None:
        topic, type_name = key
        far_topic = self._ways.name(topic)
        if key in self._topics or far_topic is None:
            return
        if _is_refused(topic, topic, far_topic):
            return
        type_id = TypeId(type_name, type_hash or installed_hash(type_name))
        if not type_id.type_hash and (self._near.end.is_zenoh or self._far.end.is_zenoh):
            warn_once(
                f"relay {topic}",
                f"{topic} is not carried: {type_name} is not installed, its publishers do not "
                "announce its hash, and Zenoh needs it",
            )
            return
        convert = self._ways.transforms if type_name == TYPE_NAME else None
        self._topics[key] = TopicRoute(self._near, self._far, (topic, far_topic), type_id, convert)
        self._say(self._line("topic", key, far_topic))

    # -- services

    def _update_services(
        self, near: Seen, far: Seen, node_for: Callable[[EndpointInfo], Node]
    ) -> None:
        servers = _servers_of(near)
        there = {name for name, _ in _servers_of(far)}
        wanted = {
            key: (server, far_name)
            for key, server in servers.items()
            if (far_name := self._ways.name(key[0])) is not None
            and far_name not in there
            and not _is_refused(f"service {key[0]}", key[0], far_name)
        }
        for key in self._services.keys() - wanted.keys():
            self._services.pop(key).close()
        for key, (server, far_name) in wanted.items():
            if key not in self._services and not self._open_service(key, far_name, near, far):
                continue
            if self._services[key].offer(far_name, node_for(server)):
                self._say(self._line("service", key, far_name))

    def _open_service(self, key: _Key, far_name: str, near: Seen, far: Seen) -> bool:
        name, type_name = key
        ends = {
            self._near: _ends_of_service(near, name),
            self._far: _ends_of_service(far, far_name),
        }
        on_zenoh = [end for side, ends in ends.items() if side.end.is_zenoh for end in ends]
        on_dds = [end for side, ends in ends.items() if not side.end.is_zenoh for end in ends]
        types = service_types(type_name, on_dds, on_zenoh)
        if not types.service_id().type_hash and any(side.end.is_zenoh for side in ends):
            warn_once(
                f"relay {name}",
                f"service {name} is not carried until a client on Zenoh appears: {type_name} is "
                "not installed, and only that client knows its hash",
            )
            return False
        self._services[key] = ServiceRoute(self._near, self._far, name, types)
        return True

    def _line(self, what: str, key: _Key, far_name: str) -> str:
        name, type_name = key
        return f"{what} [{type_name}]: {self._near.end} {name} -> {self._far.end} {far_name}"


def _is_refused(what: str, *full_names: str) -> bool:
    """Return True, after a warning, if ROS's rules do not allow one of the names at both ends.

    Programs without ROS announce any name.
    """
    fault = next(filter(None, map(names.validate_full_topic_name, full_names)), None)
    if fault is not None:
        warn_once(f"relay {what}", f"{what} is not carried: {fault.message}")
    return fault is not None


def _topics_of(seen: Seen, kind: str) -> dict[_Key, list[EndpointInfo]]:
    """Return the endpoints of all topics of ROS."""
    found: dict[_Key, list[EndpointInfo]] = {}
    for end in seen.real:
        is_topic = end.topic.startswith("/") and not end.qos.avoid_ros_namespace_conventions
        if is_topic and end.kind == kind:
            found.setdefault((end.topic, end.type_name), []).append(end)
    return found


def _servers_of(seen: Seen) -> dict[_Key, EndpointInfo]:
    """Return a server of each service; commands, which are hidden nodes, need not be called."""
    return {
        (service, names.service_type(end.type_name)): end
        for end in seen.real
        if end.kind == "subscription"
        and (service := names.service_of_requests(end.topic)) is not None
        and not (end.node is not None and names.is_hidden(end.node.name))
    }


def _ends_of_service(seen: Seen, service: str) -> Iterable[EndpointInfo]:
    return [end for end in seen.real if names.service_from_dds(end.topic) == service]
