"""Introspection of actions: of the three services of a client or server."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.clock import Clock
    from rclpy.qos import QoSProfile
    from rclpy.service_introspection import IntrospectedEndpoint, ServiceIntrospectionState


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
