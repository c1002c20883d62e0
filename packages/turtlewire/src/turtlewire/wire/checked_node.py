"""The common part of all middlewares' nodes: what they refuse."""

from __future__ import annotations

import threading
from abc import abstractmethod
from contextlib import contextmanager
from typing import TYPE_CHECKING

from turtlewire.errors import WireError

from .base import Node

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from .base import Client, MessageInfo, Publisher, Service, ServiceTypes, Sink, Subscription
    from .base import TypeId
    from .qos import QoS

__all__ = ["CheckedNode"]


class CheckedNode(Node):
    """Makes endpoints until it is closed; the subclass has the ``_create`` methods."""

    def __init__(self) -> None:
        # Held while an endpoint is made, so that none is made on a node that closes meanwhile. A
        # finalizer of the thread that makes one may close the node.
        self._making = threading.RLock()
        self._closed = False

    def create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        with self._open_for(f"create publisher {topic}"):
            return self._create_publisher(topic, type_id, qos)

    def create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
        sink: Sink | None = None,
    ) -> Subscription:
        with self._open_for(f"create subscription {topic}"):
            return self._create_subscription(topic, type_id, qos, on_message, sink)

    def create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        with self._open_for(f"create client {service}"):
            return self._create_client(service, types, qos)

    def create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        with self._open_for(f"create service {service}"):
            return self._create_service(service, types, qos)

    @contextmanager
    def _open_for(self, what: str) -> Iterator[None]:
        with self._making:
            if self._closed:
                raise WireError(f"{what}: the node is closed")
            yield

    def close(self) -> None:
        with self._making:
            if self._closed:
                return
            self._closed = True
        self._close()

    @abstractmethod
    def _create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        """Do what :meth:`create_publisher` says."""

    @abstractmethod
    def _create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None,
        sink: Sink | None,
    ) -> Subscription:
        """Do what :meth:`create_subscription` says."""

    @abstractmethod
    def _create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        """Do what :meth:`create_client` says."""

    @abstractmethod
    def _create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        """Do what :meth:`create_service` says."""

    @abstractmethod
    def _close(self) -> None:
        """Close the endpoints, and leave the graph."""
