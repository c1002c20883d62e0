"""Services of asynchronous nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._typing import SrvT_co
from rclpy.impl.hints import with_hint
from rclpy.service import BaseService

from ._async_entity import AsyncEndpoint

if TYPE_CHECKING:
    from rclpy._execution.handle import EndpointImpl
    from rclpy.qos import QoSProfile

    from ._async_entity import TaskGroup


class AsyncService(AsyncEndpoint, BaseService[SrvT_co]):
    """Answers requests; made by :meth:`AsyncNode.create_service`.

    The callback, ``def`` or ``async def``, is called with a request and an empty response, and
    returns the response. Requests wait until the callback of the former one has ended, unless the
    service is concurrent.

    Args:
        service_impl: The announced endpoint of the node.
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        callback: Called with each request and an empty response; returns the response.
        qos_profile: Quality of service of requests and responses.
        on_destroy: Called with the service after it has been destroyed.
        concurrent: Whether a request may be handled while callbacks of former ones run.
        tg: Its tasks handle the requests; None if the node does not run yet.

    Attributes:
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        callback: Called with each request and an empty response; returns the response.
        qos_profile: Quality of service of requests and responses.
    """

    def __init__(
        self,
        service_impl: EndpointImpl,
        srv_type: type[SrvT_co],
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        qos_profile: QoSProfile,
        on_destroy: Callable[[Any], None] | None,
        concurrent: bool = False,
        tg: TaskGroup | None = None,
    ) -> None:
        self._concurrent = concurrent
        super().__init__(
            service_impl, srv_type, srv_name, callback, qos_profile, on_destroy=on_destroy
        )
        self._start(tg)

    def _wrong_response(self, response: Any) -> TypeError:
        # As in ROS 2, without a text.
        return with_hint(TypeError(), str(super()._wrong_response(response)))
