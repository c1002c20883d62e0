"""Contexts and their nodes."""

from __future__ import annotations

import atexit
import ctypes
import os
import threading
from collections.abc import Callable
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING, ClassVar
from weakref import WeakSet

import zenoh

from turtlewire.errors import WireError
from turtlewire.wire.base import Context, EventKind, NodeInfo
from turtlewire.wire.checked_node import CheckedNode
from turtlewire.wire.loopback import ANY_PORT, bind_to_loopback, open_sockets
from turtlewire.wire.queue_wait_set import QueueWaitSet, call_when_queued
from turtlewire.wire.reader_thread import ReaderThread

from .configuration import SharedMemory, session_configuration, stays_on_loopback
from .context_state import ZenohContextState
from .graph import ZenohGraph
from .inlet import ZenohSinkSubscription, ZenohSubscription
from .library import reason_of
from .protocol import NODE, Token
from .publisher import ZenohPublisher
from .router import wait_for_router
from .services import ZenohClient, ZenohService

if TYPE_CHECKING:
    from turtlewire.wire.base import (
        Client,
        Entity,
        MessageInfo,
        Publisher,
        Service,
        ServiceTypes,
        Sink,
        Subscription,
        TypeId,
        Waitable,
        WaitSet,
    )
    from turtlewire.wire.qos import QoS


class ZenohNode(CheckedNode):
    """A node of a context.

    Args:
        context: The context that makes it.
        core: What it shares with its endpoints.
        info: Name, namespace and enclave.
        on_closed: Called when it is closed.
    """

    def __init__(
        self,
        context: Context,
        core: ZenohContextState,
        info: NodeInfo,
        on_closed: Callable[[ZenohNode], None],
    ) -> None:
        super().__init__()
        self.context = context
        self.name, self.namespace = info.name, info.namespace
        number = core.next_number()
        self.token = Token(
            core.domain_id,
            core.session_id,
            number,
            number,
            NODE,
            info.enclave,
            info.namespace,
            info.name,
        )
        self._core = core
        self._on_closed = on_closed
        self._endpoints: dict[Entity, None] = {}
        with core.declaring(f"create node {self.name}"), core.calls:
            self._liveliness = core.session.liveliness().declare_token(self.token.text)
        core.graph.add(self.token)

    def adopt(self, endpoint: Entity) -> None:
        """Own an endpoint until it closes."""
        with self._core.lock:
            self._endpoints[endpoint] = None

    def forget(self, endpoint: Entity) -> None:
        """An endpoint was closed."""
        with self._core.lock:
            self._endpoints.pop(endpoint, None)

    def _create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        with self._core.declaring(f"create publisher {topic}"):
            return ZenohPublisher(self._core, self, topic, type_id, qos)

    def _create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None,
        sink: Sink | None,
    ) -> Subscription:
        with self._core.declaring(f"create subscription {topic}"):
            if sink is None:
                return ZenohSubscription(self._core, self, topic, type_id, qos, on_message)
            return ZenohSinkSubscription(self._core, self, topic, type_id, qos, on_message, sink)

    def _create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        with self._core.declaring(f"create client {service}"):
            return ZenohClient(self._core, self, service, types.service_id(), qos)

    def _create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        with self._core.declaring(f"create service {service}"):
            return ZenohService(self._core, self, service, types.service_id(), qos)

    def _close(self) -> None:
        with self._core.lock:
            endpoints = list(self._endpoints)
        for endpoint in endpoints:
            endpoint.close()
        if not self._core.closing:
            with suppress(WireError), self._core.calls:
                self._liveliness.undeclare()  # type: ignore[no-untyped-call]
        self._core.graph.remove(self.token)
        self._on_closed(self)


_FORK_FIRST = (
    "Start processes with subprocess or multiprocessing's 'spawn', or fork before the first "
    "context."
)
#: How long the interpreter's end waits for a thread that closes a context [s].
_LONGEST_CLOSE_S = 10.0
_contexts: WeakSet[ZenohContext] = WeakSet()


def _keep_in_child() -> None:
    """Never free the contexts that a forked child has inherited.

    Freeing a session, or what was declared with it, waits for threads that the child does not have.
    """
    for context in _contexts:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(context))


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_keep_in_child)


class ZenohContext(Context):
    """A Zenoh session."""

    events = frozenset({EventKind.MATCHED, EventKind.MESSAGE_LOST})
    _opener: ClassVar[int | None] = None
    """The process that opened the first session, and with it started the threads of Zenoh."""

    def __init__(self, domain_id: int, enclave: str) -> None:
        self._require_threads()
        self.domain_id = domain_id
        self._enclave = enclave
        configuration = session_configuration()
        session = _open(configuration)
        reader = ReaderThread()
        self._graph = ZenohGraph(domain_id, reader)
        self._nodes: dict[ZenohNode, None] = {}
        self._wait_sets: set[QueueWaitSet] = set()
        with ExitStack() as if_it_fails:
            if_it_fails.callback(session.close)
            memory = SharedMemory(configuration)
            self._core = ZenohContextState(session, domain_id, reader, self._graph, memory)
            self.gid = bytes.fromhex(self._core.session_id.zfill(32))
            self._graph.start(session, self._core.threads)
            if_it_fails.pop_all()
        _contexts.add(self)
        self._closed = threading.Event()
        atexit.register(self._close_at_exit)

    @property
    def graph(self) -> ZenohGraph:
        return self._graph

    def create_node(self, name: str, namespace: str = "/") -> ZenohNode:
        self._require_open(f"create node {name}")
        node = ZenohNode(self, self._core, NodeInfo(name, namespace, self._enclave), self._forget)
        with self._core.lock:
            self._nodes[node] = None
        return node

    def _forget(self, node: ZenohNode) -> None:
        """Forget a node that was closed."""
        with self._core.lock:
            self._nodes.pop(node, None)

    def create_wait_set(self) -> WaitSet:
        self._require_open("create a wait set")
        wait_set = QueueWaitSet(self._core.lock, self._wait_sets.discard)
        self._wait_sets.add(wait_set)
        return wait_set

    def call_when_ready(self, entity: Waitable, call: Callable[[], None]) -> Callable[[], None]:
        return call_when_queued(self._core.lock, entity, call)

    def call_soon(self, call: Callable[[], None]) -> None:
        if self._core.process == os.getpid():  # a forked child has no reader thread
            self._core.reader.submit(call)

    @classmethod
    def _require_threads(cls) -> None:
        """Raise a WireError in a forked child that has inherited Zenoh without its threads.

        They outlive the sessions, so a session that was closed before the fork counts, too: the
        child would wait for them forever.
        """
        if cls._opener is None:
            cls._opener = os.getpid()
        elif cls._opener != os.getpid():
            raise WireError(
                "open a context: this process was forked from one that had opened a context"
            ).with_hint(_FORK_FIRST)

    def _require_open(self, what: str) -> None:
        self._core.require_open(what)
        if self._core.process != os.getpid():
            error = WireError(f"{what}: the context was opened before this process was forked")
            raise error.with_hint(_FORK_FIRST)

    def close(self) -> None:
        if self._core.process != os.getpid():  # see `Entity.close`
            return
        with self._core.lock:
            if self._core.closing:
                return
            self._core.closing = True
            nodes = list(self._nodes)
        self._core.reader.close()
        self._core.calls.close()
        self._core.session.close()  # type: ignore[no-untyped-call]
        for node in nodes:
            node.close()
        for wait_set in list(self._wait_sets):
            wait_set.close()
        self._graph.end_waits()
        self._core.calls.join()
        self._core.memory.close()
        self._core.threads.join()
        self._closed.set()
        atexit.unregister(self._close_at_exit)

    def _close_at_exit(self) -> None:
        """Close it, or wait for the daemon thread that is about to.

        Python ends a daemon thread that comes back from Zenoh's library after the end of the
        interpreter. Within Rust code, that aborts the process.
        """
        if self._core.process == os.getpid():
            self.close()
            self._closed.wait(_LONGEST_CLOSE_S)


def _open(configuration: zenoh.Config) -> zenoh.Session:
    former = open_sockets()
    try:
        session = zenoh.open(configuration)
    except zenoh.ZError as error:
        from .diagnosis import fault_of

        fault = fault_of(configuration, reason_of(error))
        failed = WireError(f"cannot open a Zenoh session: {fault.text}")
        raise failed.with_hint(fault.remedy) from None
    try:
        if stays_on_loopback(configuration):
            bind_to_loopback(former, ANY_PORT)
        if "tls/" in configuration.get_json("connect/endpoints"):
            from .diagnosis import warn_of_faults

            warn_of_faults(configuration)
        wait_for_router(session)
    except BaseException:  # Ctrl-C during the wait
        session.close()  # type: ignore[no-untyped-call]
        raise
    return session
