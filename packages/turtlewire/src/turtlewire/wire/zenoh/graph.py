"""The graph: nodes and endpoints, from the liveliness tokens of all sessions of a domain."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from typing import TYPE_CHECKING, Protocol, TypeVar

from zenoh import SampleKind

from turtlewire.wire import names
from turtlewire.wire.base import EndpointInfo, NodeInfo
from turtlewire.wire.conflicts import EndpointTypes, NodeNames
from turtlewire.wire.graph import GraphView
from turtlewire.wire.qos import QoS
from turtlewire.wire.report import warn_once

from .protocol import CLIENT, NODE, PUBLISHER, SERVICE, SUBSCRIPTION, Token, graph_key, parse_qos

if TYPE_CHECKING:
    import zenoh

    from turtlewire.wire.reader_thread import ReaderThread

    from .callback_threads import CallbackThreads

#: Peers on this host answer within a hundredth of it.
_DISCOVERY_NS = 200_000_000

_TOPIC_KINDS = {PUBLISHER: "publisher", SUBSCRIPTION: "subscription"}
_KINDS = {**_TOPIC_KINDS, SERVICE: "service", CLIENT: "client"}
_PARTNER = {PUBLISHER: SUBSCRIPTION, SUBSCRIPTION: PUBLISHER, CLIENT: SERVICE, SERVICE: CLIENT}


class Matching(Protocol):
    """An endpoint that wants to know its partners. Both methods are called with the lock held."""

    token: Token

    def meet(self, partner: Token) -> None:
        """Match an endpoint of the other kind and the same key."""

    def part(self, partner: Token) -> None:
        """Forget a partner that has left."""


class ZenohGraph(GraphView):
    """Collects tokens, and notifies this context's endpoints of matches.

    Attributes:
        lock: Guards all of it.
    """

    def __init__(self, domain_id: int, reader: ReaderThread) -> None:
        super().__init__()
        self.lock = threading.RLock()
        self._domain_id = domain_id
        self._reader = reader
        self._session_id = ""
        self._tokens: dict[str, Token] = {}
        self._by_topic: dict[str, dict[str, Token]] = {}
        self._infos: dict[str, list[EndpointInfo]] = {}  # by token, made at the first query
        self._own: dict[tuple[str, str], dict[Matching, None]] = {}
        self._by_key: dict[tuple[str, str], dict[str, Token]] = {}
        self._types = EndpointTypes()
        self._node_names = NodeNames(domain_id)
        self._is_complete = False

    def start(self, session: zenoh.Session, threads: CallbackThreads) -> None:
        """Collect existing and future tokens."""
        self._session_id = str(session.zid())
        liveliness, key = session.liveliness(), graph_key(self._domain_id)
        self._subscriber = threads.declare(
            self._on_token,
            lambda handler: liveliness.declare_subscriber(key, handler, history=True),
        )
        self._reader.submit_after(_DISCOVERY_NS, self._completed)

    def _completed(self) -> None:
        self._is_complete = True
        self.notify_changed()

    def is_complete(self) -> bool:
        """Return True after a short time: the number of sessions is unknown."""
        return self._is_complete

    def _on_token(self, sample: zenoh.Sample) -> None:
        """Add or remove a token, on the thread of tokens."""
        text = str(sample.key_expr)
        token = Token.parse(text)
        if token is None:
            warn_once("token", f"ignored a liveliness token that is not one of ROS 2: {text}")
        elif token.session != self._session_id:  # our own tokens are known without the wire
            (self.remove if sample.kind == SampleKind.DELETE else self.add)(token)

    def add(self, token: Token) -> None:
        """Add a node or endpoint. Thread-safe; call without locks held."""
        with self.lock:
            if token.text in self._tokens:
                return
            self._tokens[token.text] = token
            if token.kind == NODE:
                self._compare_nodes(token)
            else:
                self._by_key.setdefault((token.kind, token.data_key), {})[token.text] = token
                for topic in _topics(token):
                    self._by_topic.setdefault(topic, {})[token.text] = token
                self._compare_types(token, add=True)
                for endpoint in self._partners(token):
                    endpoint.meet(token)
        self._reader.submit(self.notify_changed)

    def remove(self, token: Token) -> None:
        """A node or endpoint has gone. Thread-safe; not with locks held."""
        with self.lock:
            if self._tokens.pop(token.text, None) is None:
                return
            if token.kind == NODE:
                self._compare_nodes(token)
            else:
                _remove(self._by_key, (token.kind, token.data_key), token)
                for topic in _topics(token):
                    _remove(self._by_topic, topic, token)
                self._infos.pop(token.text, None)
                self._compare_types(token, add=False)
                for endpoint in self._partners(token):
                    endpoint.part(token)
        self._reader.submit(self.notify_changed)

    def watch(self, endpoint: Matching) -> None:
        """Tell an endpoint of this context its partners, those that are there first."""
        token = endpoint.token
        with self.lock:
            self._own.setdefault((token.kind, token.data_key), {})[endpoint] = None
            partners = self._by_key.get((_PARTNER[token.kind], token.data_key), {})
            for partner in list(partners.values()):
                endpoint.meet(partner)

    def unwatch(self, endpoint: Matching) -> None:
        """Stop notifying it."""
        token = endpoint.token
        with self.lock:
            same = self._own.get((token.kind, token.data_key), {})
            same.pop(endpoint, None)
            if not same:
                self._own.pop((token.kind, token.data_key), None)

    def _partners(self, token: Token) -> list[Matching]:
        return list(self._own.get((_PARTNER[token.kind], token.data_key), ()))

    def _compare_types(self, token: Token, *, add: bool) -> None:
        change = self._types.add if add else self._types.remove
        type_name = names.type_from_dds(token.dds_type)
        own = token.session == self._session_id
        change(token.name, _KINDS[token.kind], type_name, own=own)

    def _compare_nodes(self, token: Token) -> None:
        """Warn if another session has a node of the name of one of ours."""
        if token.session == self._session_id:
            self._node_names.own(names.fully_qualified_node_name(token.node, token.namespace))
            return
        theirs = _full_names(self._nodes_of(token.session))
        own = _full_names(self._nodes_of(self._session_id))
        self._node_names.others(token.session.encode(), theirs, own)

    def _nodes_of(self, session: str) -> list[Token]:
        return [
            token
            for token in self._tokens.values()
            if token.kind == NODE and token.session == session
        ]

    def nodes(self) -> list[NodeInfo]:
        with self.lock:
            return [_node_info(token) for token in self._tokens.values() if token.kind == NODE]

    def endpoints(self) -> list[EndpointInfo]:
        with self.lock:
            return [
                info
                for text, token in self._tokens.items()
                if token.kind != NODE
                for info in self._infos_of(text, token)
            ]

    def endpoints_of(self, topic: str, kind: str) -> list[EndpointInfo]:
        with self.lock:
            return [
                info
                for text, token in self._by_topic.get(topic, {}).items()
                for info in self._infos_of(text, token)
                if info.topic == topic and info.kind == kind
            ]

    def _infos_of(self, text: str, token: Token) -> list[EndpointInfo]:
        """Return what the graph shows of an endpoint; with the lock held."""
        infos = self._infos.get(text)
        if infos is None:
            infos = self._infos[text] = _endpoint_infos(token)
        return infos


def _topics(token: Token) -> tuple[str, ...]:
    """Return the topics of an endpoint: of a service, the two that it has on DDS."""
    if token.kind in _TOPIC_KINDS:
        return (token.name,)
    return names.request_topic(token.name), names.reply_topic(token.name)


_Key = TypeVar("_Key")


def _remove(index: dict[_Key, dict[str, Token]], key: _Key, token: Token) -> None:
    """Remove a token from an index, and its row with the last one."""
    same = index[key]
    del same[token.text]
    if not same:
        del index[key]


def _full_names(nodes: Iterable[Token]) -> list[str]:
    return [names.fully_qualified_node_name(node.node, node.namespace) for node in nodes]


def _node_info(token: Token) -> NodeInfo:
    return NodeInfo(token.node, token.namespace, token.enclave)


def _endpoint_infos(token: Token) -> list[EndpointInfo]:
    """Return an endpoint's entries in the graph: a service has two topics, as on DDS."""
    try:
        qos = parse_qos(token.qos)
    except ValueError as error:
        warn_once(f"qos {token.qos}", f"a peer announced {token.name} with a strange QoS: {error}")
        qos = QoS()
    node, gid, type_hash = _node_info(token), token.gid, token.type_hash
    type_name = names.type_from_dds(token.dds_type)
    kind = _TOPIC_KINDS.get(token.kind)
    if kind is not None:
        return [EndpointInfo(kind, token.name, type_name, type_hash, node, gid, qos)]
    kinds = ("subscription", "publisher")
    request, reply = kinds if token.kind == SERVICE else reversed(kinds)
    request_topic, reply_topic = _topics(token)
    topics = (
        (request, request_topic, f"{type_name}_Request"),
        (reply, reply_topic, f"{type_name}_Response"),
    )
    # a token has the hash of the service, not of its messages
    return [EndpointInfo(*topic, type_hash, node, gid, qos, type_hash) for topic in topics]
