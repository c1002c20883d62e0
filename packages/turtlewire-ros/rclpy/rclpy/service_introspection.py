"""Service introspection: clients and servers publish what they send and receive.

The events go to ``<service>/_service_event``; an action has three such topics.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.msg import serialize, type_name

from ._execution.entity import ClosingEntity, EntityHost
from .type_support import type_id

if TYPE_CHECKING:
    from turtlewire.wire import base

    from ._node.state import NodeState
    from .clock import Clock
    from .qos import QoSProfile

_GID_SIZE = 16


class ServiceIntrospectionState(IntEnum):
    """The amount of introspection: nothing, metadata, or metadata with contents."""

    OFF = 0
    METADATA = 1
    CONTENTS = 2


class EventType(IntEnum):
    """The kinds of events, as in ``service_msgs/msg/ServiceEventInfo``."""

    REQUEST_SENT = 0
    REQUEST_RECEIVED = 1
    RESPONSE_SENT = 2
    RESPONSE_RECEIVED = 3


class IntrospectedEndpoint(ClosingEntity):
    """The common base of clients and services: an endpoint with introspection events.

    Args:
        wire: Its side on the wire.
        core: The core of the node that owns it and publishes the events.
        srv_type: The service class.
        on_destroy: Called with the endpoint when it was destroyed.
    """

    srv_type: Any

    def __init__(
        self,
        wire: base.Client | base.Service,
        core: NodeState,
        srv_type: Any,
        on_destroy: Callable[[Any], None] | None,
    ) -> None:
        super().__init__(None)
        self._on_destroy = on_destroy
        self.srv_type = srv_type
        self._wire: Any = wire
        self._core = core
        self._logger = core.logger
        self._events: _EventPublisher | None = None

    @property
    def logger_name(self) -> str:
        """Name of the logger of its node."""
        return self._logger.name

    @property
    def service_name(self) -> str:
        """Fully qualified name of the service."""
        self._check_usable()
        return str(self._wire.service)

    def configure_introspection(
        self,
        clock: Clock,
        service_event_qos_profile: QoSProfile,
        introspection_state: ServiceIntrospectionState,
    ) -> None:
        """Publish requests and responses on ``<service>/_service_event``.

        Args:
            clock: Gives the stamps.
            service_event_qos_profile: Quality of service of the events.
            introspection_state: Whether nothing, only the metadata, or also the contents are
                published.
        """
        self._check_usable()
        # Unset before it is closed, because calls in other threads use it.
        former, self._events = self._events, None
        if former is not None:
            former.wire.close()
        if introspection_state != ServiceIntrospectionState.OFF:
            event_type = type_id(f"{type_name(self.srv_type)}_Event")
            topic = f"{self._wire.service}/_service_event"
            wire = self._core.wire.create_publisher(
                topic, event_type, service_event_qos_profile.to_wire()
            )
            self._events = _EventPublisher(
                wire,
                self.srv_type,
                clock,
                introspection_state == ServiceIntrospectionState.CONTENTS,
            )

    def _attach(self, host: EntityHost) -> None:
        host.wait.watch(self._wire, self)

    def _detach(self, host: EntityHost) -> None:
        host.wait.unwatch(self._wire)

    def _close(self) -> None:
        if self._events is not None:
            self._events.wire.close()
        self._wire.close()


class IntrospectedAction:
    """An action client or server.

    Attributes:
        _services: Its ends of the services of goals, cancellations and results.
    """

    _services: tuple[IntrospectedEndpoint, ...]

    def configure_introspection(
        self,
        clock: Clock,
        service_event_qos_profile: QoSProfile,
        introspection_state: ServiceIntrospectionState,
    ) -> None:
        """Publish the requests and responses that are sent and received.

        The events of goals, cancellations and results go to ``_service_event`` below
        ``<action>/_action/send_goal``, ``cancel_goal`` and ``get_result``.

        Args:
            clock: Gives the stamps.
            service_event_qos_profile: Quality of service of the events.
            introspection_state: Publish nothing, only the metadata, or the contents as well.

        Raises:
            InvalidHandle: The client or server was destroyed.
        """
        for service in self._services:
            service.configure_introspection(clock, service_event_qos_profile, introspection_state)


class _EventPublisher(NamedTuple):
    """The events of one client or server."""

    wire: base.Publisher
    srv_type: Any
    clock: Clock
    with_contents: bool

    def publish(
        self, event_type: EventType, client_id: int, sequence_number: int, **content: Any
    ) -> None:
        """Publish what happened to a client's request of this number.

        ``content`` is the message that passed: ``request=`` or ``response=``.
        """
        if self.wire.subscription_count() == 0:
            return
        event = self.srv_type.Event()
        event.info.event_type = int(event_type)
        event.info.stamp = self.clock.now().to_msg()
        event.info.client_gid = list(client_id.to_bytes(_GID_SIZE, "little"))
        event.info.sequence_number = sequence_number
        if self.with_contents:
            for part, message in content.items():
                # Both fields are sequences, which stay empty without contents.
                setattr(event, part, [message])
        self.wire.publish(serialize(event))
