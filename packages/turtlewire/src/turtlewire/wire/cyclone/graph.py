"""This participant's view of the graph.

It comes from Cyclone's builtin topics and the ``ros_discovery_info`` of other participants.
"""

from __future__ import annotations

import ctypes
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from turtlewire.errors import CdrError
from turtlewire.wire import names
from turtlewire.wire.base import EndpointInfo, ForeignServer, NodeInfo
from turtlewire.wire.conflicts import EndpointTypes, NodeNames, as_compared
from turtlewire.wire.graph import (
    DISCOVERY_TOPIC,
    DISCOVERY_TYPE,
    GraphView,
    NodeEndpoints,
    parse_user_data,
    unpack_discovery_info,
)
from turtlewire.wire.qos import INFINITE_NS, Durability, History, QoS
from turtlewire.wire.report import warn_once

from . import library as dds
from .endpoint import EndpointSpec
from .ports import process_of, processes_on_host
from .qos import read_qos, read_user_data
from .servers import foreign_middleware, is_fast_dds, middleware_of
from .silent_peers import PATIENCE_NS, Questions, SilentPeers
from .subscription import CycloneSubscription

if TYPE_CHECKING:
    from .announcer import Announcer
    from .participant import Participant
    from .reader import CycloneReaderThread

S = TypeVar("S", bound=ctypes.Structure)

_BATCH = 64


class _Endpoint(NamedTuple):
    kind: str
    dds_topic: str
    dds_type: str
    user_data: dict[str, str]
    qos: QoS


class _BuiltinReader:
    """Reads one of Cyclone's builtin topics."""

    def __init__(self, participant: int, topic: int) -> None:
        self._reader = dds.check(
            dds.create_reader(participant, topic, None, None), "watch the graph"
        )
        self.condition = dds.check(
            dds.create_read_condition(self._reader, dds.ANY_STATE), "watch the graph"
        )

    def take(self, sample: type[S]) -> Iterator[tuple[bool, S]]:
        """Yield new samples, each after True if it is alive; else only its key is valid."""
        pointers, infos = (ctypes.c_void_p * _BATCH)(), (dds.SampleInfo * _BATCH)()
        count = _BATCH
        while count == _BATCH:
            # A null pointer makes Cyclone lend its samples instead of copying them.
            pointers[0] = None
            count = dds.take_samples(self._reader, pointers, infos, _BATCH, _BATCH)
            if count <= 0:
                return
            try:
                for index in range(count):
                    alive = (
                        infos[index].valid_data
                        and infos[index].instance_state == dds.INSTANCE_ALIVE
                    )
                    yield alive, ctypes.cast(pointers[index] or 0, ctypes.POINTER(sample)).contents
            finally:
                dds.return_loan(self._reader, pointers, count)


class CycloneGraph(GraphView):
    """Collects what Cyclone discovers.

    Started at its first use, because most processes never ask.
    """

    def __init__(
        self, participant: Participant, announcer: Announcer, reader: CycloneReaderThread
    ) -> None:
        super().__init__()
        self._announcer = announcer
        self._participant = participant
        self._participant_gid = participant.gid
        self._domain_id = participant.domain_id
        self._lock = threading.RLock()
        self._enclaves: dict[bytes, str] = {}
        self._endpoints: dict[bytes, _Endpoint] = {}
        self._announced: dict[bytes, list[NodeEndpoints]] = {}
        self._types = EndpointTypes()
        self._node_names = NodeNames(participant.domain_id)
        self._reader = reader
        self._hurries = False
        self._asks_soon = False
        self._silent_peers = SilentPeers(participant, self._renew_infos)
        self._infos = self._subscribe_to_infos()
        self._participants = _BuiltinReader(participant.handle, dds.BUILTIN_TOPIC_PARTICIPANT)
        self._publications = _BuiltinReader(participant.handle, dds.BUILTIN_TOPIC_PUBLICATION)
        self._subscriptions = _BuiltinReader(participant.handle, dds.BUILTIN_TOPIC_SUBSCRIPTION)
        self._update()
        for source in (self._participants, self._publications, self._subscriptions):
            reader.watch(source.condition, self._on_news)
        reader.watch(self._infos.condition(), self._on_news)

    def _subscribe_to_infos(self) -> CycloneSubscription:
        qos = QoS(history=History.KEEP_ALL, durability=Durability.TRANSIENT_LOCAL)
        spec = EndpointSpec(DISCOVERY_TOPIC, DISCOVERY_TOPIC, DISCOVERY_TYPE, qos)
        # Our own nodes are known without the wire.
        return CycloneSubscription(self._participant, spec, ignore_local=True)

    def _renew_infos(self) -> None:
        """Replace the reader of node names, so that every participant sends its nodes again."""
        old, self._infos = self._infos, self._subscribe_to_infos()
        self._reader.unwatch(old.condition())
        for cdr in old.take_bytes():
            self._update_nodes(cdr)
        old.close()
        self._reader.watch(self._infos.condition(), self._on_news)

    def _on_news(self) -> None:
        self._update()
        self.notify_changed()

    def _look_first(self) -> None:
        """Take over what Cyclone knows already, before a question is answered.

        The reader thread may not have received an endpoint yet that the calling thread has just
        created or closed. What is taken here does not wake it any more, so it is asked to notify
        the listeners.
        """
        if self._update():
            self._reader.call_soon(self.notify_changed)

    def _update(self) -> bool:
        """Apply all pending changes; return True if there were any.

        Announcements are taken first and kept only from participants that are known after that, so
        that a late announcement of a participant that has left does not add its nodes again.
        """
        with self._lock:
            infos = self._infos.take_bytes()
            news = [
                self._update_participants(),
                self._update_endpoints("publisher", self._publications),
                self._update_endpoints("subscription", self._subscriptions),
            ]
            for cdr in infos:
                self._update_nodes(cdr)
            self._ask_soon()
        return bool(infos) or any(news)

    def hurry(self) -> None:
        with self._lock:
            self._hurries = True
            self._ask_soon()

    def _ask_soon(self) -> None:
        if self._hurries and not self._asks_soon and any(self._questions()):
            self._asks_soon = True
            self._reader.call_at(time.monotonic_ns() + PATIENCE_NS, self._ask)

    def _ask(self) -> None:
        with self._lock:
            self._asks_soon = False
            self._silent_peers.ask(self._questions())

    def _questions(self) -> Questions:
        announcers = (
            gid
            for gid, endpoint in self._endpoints.items()
            if endpoint.dds_topic == DISCOVERY_TOPIC and endpoint.kind == "publisher"
        )
        return self._silent_peers.to_ask(self._unannounced(), announcers)

    def _unannounced(self) -> set[bytes]:
        """Return the other ROS participants whose nodes are not known."""
        known = self._announced.keys() | {self._participant_gid}
        return {gid for gid, enclave in self._enclaves.items() if enclave} - known

    def _update_participants(self) -> bool:
        news = False
        for alive, sample in self._participants.take(dds.BuiltinParticipant):
            news = True
            gid = bytes(sample.key)
            if alive:
                self._enclaves[gid] = parse_user_data(read_user_data(sample.qos)).get("enclave", "")
            else:
                self._enclaves.pop(gid, None)
                self._announced.pop(gid, None)
                self._node_names.gone(gid)
                self._silent_peers.gone(gid)
        return news

    def _update_endpoints(self, kind: str, source: _BuiltinReader) -> bool:
        news = False
        for alive, sample in source.take(dds.BuiltinEndpoint):
            news = True
            gid = bytes(sample.key)
            if alive and sample.topic_name.startswith(b"DCPS"):
                continue  # Cyclone's own readers of this very information
            former = self._endpoints.pop(gid, None)
            if former is not None:
                self._compare_types(self._types.remove, gid, former)
            if alive:
                user_data = parse_user_data(read_user_data(sample.qos))
                topic, type_name = (
                    sample.topic_name.decode("utf-8", "replace"),
                    sample.type_name.decode("utf-8", "replace"),
                )
                qos = read_qos(sample.qos)
                if is_fast_dds(gid):  # it does not announce the history; Cyclone fills in a default
                    qos = qos._replace(history=History.UNKNOWN, depth=0)
                self._endpoints[gid] = endpoint = _Endpoint(kind, topic, type_name, user_data, qos)
                self._compare_types(self._types.add, gid, endpoint)
        return news

    def _compare_types(self, change: Callable[..., None], gid: bytes, endpoint: _Endpoint) -> None:
        type_name = names.type_from_dds(endpoint.dds_type)
        compared = as_compared(endpoint.dds_topic, endpoint.kind, type_name)
        if compared is not None:
            change(*compared, own=process_of(gid) == process_of(self._participant_gid))

    def compare_name(self, full_name: str) -> None:
        """Warn if another process has a node of the name that a new one of ours has."""
        with self._lock:
            self._node_names.own(full_name)

    def _update_nodes(self, cdr: bytes) -> None:
        try:
            participant, nodes = unpack_discovery_info(cdr)
        except CdrError as error:
            warn_once(
                "discovery_info", f"ignored a participant's announcement of its nodes: {error}"
            )
            return
        if participant in self._enclaves:
            self._announced[participant] = nodes
            if process_of(participant) != process_of(self._participant_gid):
                own = _full_names(self._announcer.nodes())
                self._node_names.others(participant, _full_names(nodes), own)

    def _all_nodes(self) -> list[tuple[NodeInfo, NodeEndpoints]]:
        announced = {self._participant_gid: self._announcer.nodes(), **self._announced}
        return [
            (NodeInfo(node.name, node.namespace, self._enclaves.get(participant, "")), node)
            for participant, nodes in announced.items()
            for node in nodes
        ]

    def is_complete(self) -> bool:
        """Return True once all announced endpoints are known.

        Each ROS participant has announced its nodes, and each endpoint of theirs is known.
        """
        # A process that has bound a port of the domain will be discovered soon.
        on_host = processes_on_host(self._domain_id)
        self._look_first()
        with self._lock:
            if on_host is not None and len({process_of(gid) for gid in self._enclaves}) < on_host:
                return False
            gids = (
                gid
                for nodes in self._announced.values()
                for node in nodes
                for gid in (*node.readers, *node.writers)
            )
            return not self._unannounced() and all(gid in self._endpoints for gid in gids)

    def nodes(self) -> list[NodeInfo]:
        self._look_first()
        with self._lock:
            return [info for info, _ in self._all_nodes()]

    def endpoints(self) -> list[EndpointInfo]:
        self._look_first()
        with self._lock:
            owners = {
                gid: info
                for info, node in self._all_nodes()
                for gid in (*node.readers, *node.writers)
            }
            return [
                _endpoint_info(gid, endpoint, owners.get(gid))
                for gid, endpoint in self._endpoints.items()
            ]

    def foreign_servers(self) -> list[ForeignServer]:
        self._look_first()
        with self._lock:
            readers = [
                (service, gid, endpoint.user_data)
                for gid, endpoint in self._endpoints.items()
                if endpoint.kind == "subscription"
                and (service := names.service_of_requests(endpoint.dds_topic)) is not None
            ]
            foreign = {
                gid: (service, middleware, False)
                for service, gid, ids in readers
                if (middleware := foreign_middleware(gid, ids))
            }
            twice = _served_twice((service, gid) for service, gid, _ in readers)
            for service, gid, _ in readers:
                if service in twice:
                    foreign.setdefault(gid, (service, middleware_of(gid), True))
            if not foreign:  # nearly always; avoids the search for the owners
                return []
            owners = {endpoint.gid: endpoint.node for endpoint in self.endpoints()}
            return [
                ForeignServer(service, owners[gid], middleware, is_rival)
                for gid, (service, middleware, is_rival) in foreign.items()
                if gid in owners  # it may have left by now
            ]

    def middlewares(self) -> dict[str, int]:
        self._look_first()
        with self._lock:
            own = process_of(self._participant_gid)
            others = [
                gid for gid, enclave in self._enclaves.items() if enclave and process_of(gid) != own
            ]
        return dict(Counter(map(middleware_of, others)))

    def end_waits(self) -> None:
        """End all waits, and take back what was asked."""
        super().end_waits()
        self._silent_peers.close()


def _full_names(nodes: Iterable[NodeEndpoints]) -> list[str]:
    return [names.fully_qualified_node_name(node.name, node.namespace) for node in nodes]


def _served_twice(readers: Iterable[tuple[str, bytes]]) -> set[str]:
    """Return the services with servers on Fast DDS and on another middleware."""
    fast_dds: set[str] = set()
    others: set[str] = set()
    for service, gid in readers:
        (fast_dds if is_fast_dds(gid) else others).add(service)
    return fast_dds & others


def _endpoint_info(gid: bytes, endpoint: _Endpoint, owner: NodeInfo | None) -> EndpointInfo:
    topic = names.topic_from_dds(endpoint.dds_topic)
    type_name = names.type_from_dds(endpoint.dds_type)
    type_hash = endpoint.user_data.get("typehash", "")
    # a lifespan is the writer's alone; ROS 2 shows readers with an infinite one
    qos = (
        endpoint.qos
        if endpoint.kind == "publisher"
        else endpoint.qos._replace(lifespan_ns=INFINITE_NS)
    )
    if topic is None:
        topic = endpoint.dds_topic
        qos = qos._replace(avoid_ros_namespace_conventions=names.service_from_dds(topic) is None)
    service_hash = endpoint.user_data.get("sertypehash", "")
    return EndpointInfo(endpoint.kind, topic, type_name, type_hash, owner, gid, qos, service_hash)
