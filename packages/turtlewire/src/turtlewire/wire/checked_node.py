"""The common base of the middlewares' nodes: checks names and that the node is open."""

from __future__ import annotations

import os
import threading
from abc import abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from turtlewire.errors import WireError

from .base import Node
from .names import NameFault, validate_full_topic_name

if TYPE_CHECKING:
    from .base import (
        Client,
        MessageInfo,
        Publisher,
        Service,
        ServiceTypes,
        Sink,
        Subscription,
        TypeId,
    )
    from .qos import QoS


class CheckedNode(Node):
    """Creates endpoints until it is closed; subclasses define the ``_create`` methods."""

    def __init__(self) -> None:
        # Held while an endpoint is made, so that none is made on a node that closes meanwhile. A
        # finalizer of the thread that makes one may close the node.
        self._making = threading.RLock()
        self._closed = False
        self._process = os.getpid()

    def create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        with self._checked("publisher", topic, bare=qos.avoid_ros_namespace_conventions):
            return self._create_publisher(topic, type_id, qos)

    def create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None = None,
        sink: Sink | None = None,
    ) -> Subscription:
        with self._checked("subscription", topic, bare=qos.avoid_ros_namespace_conventions):
            return self._create_subscription(topic, type_id, qos, on_message, sink)

    def create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        with self._checked("client", service):
            return self._create_client(service, types, qos)

    def create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        with self._checked("service", service):
            return self._create_service(service, types, qos)

    @contextmanager
    def _checked(self, kind: str, name: str, *, bare: bool = False) -> Iterator[None]:
        """Check the name and the node, and keep the node open within the block.

        Args:
            kind: The endpoint to create, for the error.
            name: Name of the topic or service.
            bare: True for a DDS name, which ROS's rules do not restrict.

        Raises:
            WireError: The name is invalid, or the node is closed.
        """
        fault = _fault_of_bare(name) if bare else validate_full_topic_name(name)
        if fault is not None:
            raise WireError(f"create {kind} {name!r}: {fault.message}")
        with self._making:
            if self._closed:
                raise WireError(f"create {kind} {name}: the node is closed")
            yield

    def close(self) -> None:
        if self._process != os.getpid():  # see `Entity.close`
            return
        with self._making:
            if self._closed:
                return
            self._closed = True
        self._close()

    @abstractmethod
    def _create_publisher(self, topic: str, type_id: TypeId, qos: QoS) -> Publisher:
        """Create a publisher of a valid topic."""

    @abstractmethod
    def _create_subscription(
        self,
        topic: str,
        type_id: TypeId,
        qos: QoS,
        on_message: Callable[[bytes, MessageInfo], None] | None,
        sink: Sink | None,
    ) -> Subscription:
        """Create a subscription of a valid topic."""

    @abstractmethod
    def _create_client(self, service: str, types: ServiceTypes, qos: QoS) -> Client:
        """Create a client of a valid service."""

    @abstractmethod
    def _create_service(self, service: str, types: ServiceTypes, qos: QoS) -> Service:
        """Create a server of a valid service."""

    @abstractmethod
    def _close(self) -> None:
        """Close the endpoints, and leave the graph."""


def _fault_of_bare(name: str) -> NameFault | None:
    """Check a DDS name for characters that a C string or UTF-8 cannot hold."""
    if name and name.isprintable():
        return None
    return NameFault("topic name must not be empty or contain unprintable characters", 0)
