"""Nodes."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire.checked_node import CheckedNode

from .inlet import ZenohSinkSubscription
from .publisher import ZenohPublisher
from .services import ZenohClient, ZenohService
from .subscription import ZenohSubscription
from .token import NODE, Token

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import (
        Client,
        Context,
        Entity,
        MessageInfo,
        NodeInfo,
        Publisher,
        Service,
        ServiceTypes,
        Sink,
        Subscription,
        TypeId,
    )
    from turtlewire.wire.qos import QoS

    from .context_state import ZenohContextState

__all__ = ["ZenohNode"]


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
