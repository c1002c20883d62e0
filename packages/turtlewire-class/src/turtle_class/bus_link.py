"""Links the ``local`` buses of two processes: nodes of one reach topics and services of the other.

The grader's end is the hub: every message of the other process passes the hub's bus, with its
faults, and comes back to the subscriptions in that process. Each end mirrors the nodes and
endpoints of the other. The ends exchange updates as JSON objects (`News`).
"""

from __future__ import annotations

import base64
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from turtlewire.wire.base import MessageInfo, NodeInfo, TypeId
from turtlewire.wire.local.bus import LocalEndpointSpec
from turtlewire.wire.local.context import LocalNodeState, LocalPublisher, LocalSubscription
from turtlewire.wire.qos import Durability, History, Liveliness, QoS, Reliability
from turtlewire.wire.reader_thread import ReaderThread

if TYPE_CHECKING:
    from turtlewire.wire.local.bus import Bus, LocalEndpoint, Message

__all__ = ["FarEnd", "Hub", "News"]

News = dict[str, Any]
"""An update from one end: ``nodes``, ``opened`` and ``closed`` endpoints, and ``messages``."""


class _End:
    """One end of a link: announces its nodes and endpoints, and mirrors the other end's.

    Args:
        bus: The bus of this process.
    """

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._told: dict[str, LocalEndpoint] = {}
        self._told_nodes: list[NodeInfo] = []
        self._mirrors: dict[str, LocalEndpoint] = {}
        self._mirrored_nodes: dict[NodeInfo, LocalNodeState] = {}
        self._messages: list[list[Any]] = []
        self._graph_changed = True
        bus.listeners.append(self._note_change)

    def _note_change(self) -> None:
        self._graph_changed = True

    def close(self) -> None:
        """Remove the mirrors."""
        self._bus.listeners.remove(self._note_change)
        for mirror in self._mirrors.values():
            mirror.close()
        for node in list(self._mirrored_nodes):
            self._remove_node(node)
        self._bus.changed()

    def take_news(self) -> News:
        """Return what the other end does not know yet; empty if there is nothing."""
        news: News = {}
        with self._bus.lock:
            if self._messages:
                news["messages"], self._messages = self._messages, []
            if self._graph_changed:
                self._graph_changed = False
                news.update(self._graph_news())
        return news

    def _graph_news(self) -> News:
        mirrors = {id(mirror) for mirror in self._mirrors.values()}
        publishers, subscriptions = self._bus.publishers(), self._bus.subscriptions()
        own = {
            endpoint.gid.hex(): endpoint
            for endpoint in publishers + subscriptions
            if id(endpoint) not in mirrors
        }
        shown = {id(core.info) for core in self._mirrored_nodes.values()}
        nodes = [node for node in self._bus.nodes if id(node) not in shown]
        opened = [_described(own[gid]) for gid in own if gid not in self._told]
        closed = [gid for gid in self._told if gid not in own]
        unchanged = not opened and not closed and nodes == self._told_nodes
        self._told, self._told_nodes = own, nodes
        return {} if unchanged else {"nodes": nodes, "opened": opened, "closed": closed}

    def apply(self, news: News) -> None:
        """Take over the other end's news.

        Raises:
            Exception: The bytes are not news: the other process sends something else.
        """
        with self._bus.lock:
            if "nodes" in news:
                self._apply_graph(news)
            for message in news.get("messages", ()):
                self._apply_message(*message)

    def _apply_graph(self, news: News) -> None:
        for gid in news["closed"]:
            self._mirrors.pop(gid).close()
        nodes = dict.fromkeys(NodeInfo(*map(str, node)) for node in news["nodes"])
        for node in [node for node in self._mirrored_nodes if node not in nodes]:
            self._remove_node(node)
        for node in nodes:
            if node not in self._mirrored_nodes:
                core = LocalNodeState(NodeInfo(*node), self._bus, ReaderThread())
                self._mirrored_nodes[node] = core
                self._bus.nodes.append(core.info)
        for described in news["opened"]:
            gid = described["gid"]
            if gid in self._mirrors or gid in self._told:
                raise ValueError(f"endpoint {gid} is there already")
            core = self._mirrored_nodes[NodeInfo(*described["node"])]
            mirror = self._mirror(described["kind"], gid, core, _spec_of(described))
            mirror.gid = bytes.fromhex(gid)
            self._mirrors[gid] = mirror
        self._bus.changed()

    def _remove_node(self, node: NodeInfo) -> None:
        info = self._mirrored_nodes.pop(node).info
        self._bus.nodes[:] = [other for other in self._bus.nodes if other is not info]

    def _mirror(
        self, kind: str, gid: str, core: LocalNodeState, spec: LocalEndpointSpec
    ) -> LocalEndpoint:
        if kind == "publisher":
            return LocalPublisher(core, spec)
        return _MirroredSubscription(core, spec, lambda message: self._heard(gid, message))

    def _heard(self, gid: str, message: Message) -> None:
        """A message has come for a subscription at the other end; called with the lock held."""
        raise NotImplementedError

    def _apply_message(self, gid: str, cdr: str, *info: Any) -> None:
        """Pass on a message of the other end; called with the lock held."""
        raise NotImplementedError


class Hub(_End):
    """The end through which all messages go."""

    def _heard(self, gid: str, message: Message) -> None:
        cdr, info = message
        stamps = info.source_timestamp_ns, info.received_timestamp_ns
        self._messages.append([gid, _text(cdr), *stamps, info.publisher_gid.hex()])

    def _apply_message(self, gid: str, cdr: str, *info: Any) -> None:
        if info:
            raise ValueError("the hub alone stamps messages")
        publisher = self._mirrors[gid]
        assert isinstance(publisher, LocalPublisher)
        publisher.publish(base64.b64decode(cdr))


class FarEnd(_End):
    """The other end: what its nodes publish goes to the hub and is not delivered here."""

    def __init__(self, bus: Bus) -> None:
        super().__init__(bus)
        bus.tamper = self._send

    def close(self) -> None:
        """Remove the mirrors, and deliver messages here again."""
        self._bus.tamper = None
        super().close()

    def _send(self, sender: Any, message: Message) -> None:
        """Take a message instead of its delivery; called with the lock held."""
        self._messages.append([sender.gid.hex(), _text(message[0])])

    def _heard(self, gid: str, message: Message) -> None:
        """Deliver nothing."""

    def _apply_message(self, gid: str, cdr: str, *info: Any) -> None:
        subscription = self._told.get(gid)
        if subscription is not None:  # another thread may have closed it
            sent, received, publisher = info
            about = MessageInfo(sent, received, bytes.fromhex(publisher))
            subscription.receive((base64.b64decode(cdr), about))


class _MirroredSubscription(LocalSubscription):
    """Passes each message on instead of keeping it."""

    def __init__(
        self, node: LocalNodeState, spec: LocalEndpointSpec, heard: Callable[[Message], None]
    ) -> None:
        self._heard = heard
        super().__init__(node, spec)

    def receive(self, message: Message) -> None:
        self._heard(message)


def _text(cdr: bytes) -> str:
    return base64.b64encode(cdr).decode("ascii")


def _described(endpoint: LocalEndpoint) -> dict[str, Any]:
    kind = "publisher" if isinstance(endpoint, LocalPublisher) else "subscription"
    return {
        "kind": kind,
        "gid": endpoint.gid.hex(),
        "name": endpoint.topic,
        "dds_topic": endpoint.dds_topic,
        "type": endpoint.type_id,
        "qos": endpoint.qos,
        "node": endpoint.info(kind).node,
    }


def _spec_of(described: dict[str, Any]) -> LocalEndpointSpec:
    history, depth, reliability, durability, deadline, lifespan, liveliness, lease, bare = (
        described["qos"]
    )
    qos = QoS(
        History(history),
        int(depth),
        Reliability(reliability),
        Durability(durability),
        int(deadline),
        int(lifespan),
        Liveliness(liveliness),
        int(lease),
        bool(bare),
    )
    name, type_hash = map(str, described["type"])
    return LocalEndpointSpec(
        str(described["name"]), str(described["dds_topic"]), TypeId(name, type_hash), qos
    )
