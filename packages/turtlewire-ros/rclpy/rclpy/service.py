"""Service servers."""

from __future__ import annotations

from collections.abc import Callable
from types import CoroutineType
from typing import TYPE_CHECKING, Any, Generic

from turtlewire.distro import LYRICAL, since
from turtlewire.errors import CdrError, WireError
from turtlewire.msg import deserialize, serialize

from ._rclpy_pybind11 import InvalidHandle
from ._typing import RequestT as SrvTypeRequest
from ._typing import ResponseT as SrvTypeResponse
from ._typing import SrvT as SrvType
from ._typing import SrvT_co
from .impl.hints import described
from .service_introspection import EventType, IntrospectedEndpoint

if TYPE_CHECKING:
    from turtlewire.wire import base

    from ._execution.entity import Work
    from ._execution.handle import EndpointImpl
    from .callback_groups import CallbackGroup
    from .qos import QoSProfile

__all__ = ["BaseService", "Service", "SrvType", "SrvTypeRequest", "SrvTypeResponse"]


class BaseService(IntrospectedEndpoint, Generic[SrvT_co]):
    """Answers requests.

    The callback is called with a request and an empty response, and returns the response.

    Args:
        service_impl: The announced endpoint of the node.
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        callback: Called with each request and an empty response; returns the response.
        qos_profile: Quality of service of requests and responses.
        on_destroy: Called with the service after it has been destroyed.

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
        *,
        on_destroy: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(service_impl.wire, service_impl.core, srv_type, on_destroy)
        self.srv_name = srv_name
        self.callback = callback
        self.qos_profile = qos_profile
        self._context = service_impl.core.context

    def send_response(self, response: Any, header: base.RequestId) -> None:
        """Answer the request that ``header`` identifies.

        Raises:
            TypeError: ``response`` is not a ``srv_type.Response``.
        """
        self._check_usable()
        if not isinstance(response, self.srv_type.Response):
            raise self._wrong_response(response)
        self._wire.send_response(header, serialize(response))
        if self._events is not None:
            self._events.publish(
                EventType.RESPONSE_SENT, header.client_id, header.sequence_number, response=response
            )

    def _wrong_response(self, response: Any) -> TypeError:
        return TypeError(
            f"The callback of service '{self._wire.service}' has to return its second argument, "
            f"or another {self.srv_type.__name__}.Response; it returned {described(response)}"
        )

    def _serves(self, service: str) -> bool:
        return bool(self._wire.service == service)

    def _warn_of_self_wait(self) -> None:
        self._logger.warning(
            f"An async callback awaits, and service '{self._wire.service}', which was called, "
            "cannot run before it ends: both are in one callback group. If it awaits that service, "
            "this is a deadlock: give the service its own callback group"
        )

    def _take(self) -> Work | None:
        for header, cdr in self._wire.take(1):
            try:
                request = deserialize(self.srv_type.Request, cdr)
            except CdrError as error:
                # The client's mistake must not end the spin of this program.
                self._logger.error(  # noqa: TRY400 - a ROS logger
                    f"Ignoring a malformed request to service '{self._wire.service}': {error}",
                    throttle_duration_sec=5.0,
                )
                return None
            if self._events is not None:
                self._events.publish(
                    EventType.REQUEST_RECEIVED,
                    header.client_id,
                    header.sequence_number,
                    request=request,
                )
            return self._answer, (header, request)
        return None

    def _answer(self, header: base.RequestId, request: Any) -> Any:
        outcome = self.callback(request, self.srv_type.Response())
        if isinstance(outcome, CoroutineType):
            return self._answer_later(header, outcome)
        self._send_unless_destroyed(outcome, header)
        return None

    async def _answer_later(self, header: base.RequestId, outcome: Any) -> None:
        self._send_unless_destroyed(await outcome, header)

    def _send_unless_destroyed(self, response: Any, header: base.RequestId) -> None:
        """Send the response unless the service or the context is gone."""
        try:
            self.send_response(response, header)
        except (InvalidHandle, WireError):
            # Another thread may destroy the service, or shut the context down, during the callback.
            if not self._destroyed and self._context.is_open():
                raise


class Service(BaseService[SrvT_co]):
    """Answers requests; made by :meth:`Node.create_service <rclpy.node.Node.create_service>`.

    Args:
        service_impl: The announced endpoint of the node.
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        callback: Called with each request and an empty response; returns the response.
        qos_profile: Quality of service of requests and responses.
        callback_group: The group of the service. Up to Kilted, it comes before the quality of
            service.
        on_destroy: Called with the service after it has been destroyed.
    """

    _ORDER = 4

    def __init__(
        self,
        service_impl: EndpointImpl,
        srv_type: type[SrvT_co],
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        qos_profile: QoSProfile,
        *,
        on_destroy: Callable[[Any], None] | None = None,
        callback_group: CallbackGroup,
    ) -> None:
        super().__init__(
            service_impl, srv_type, srv_name, callback, qos_profile, on_destroy=on_destroy
        )
        self._enter(callback_group)

    if not (TYPE_CHECKING or since(LYRICAL)):
        __init = __init__

        def __init__(  # in the order of Jazzy and Kilted
            self,
            service_impl: EndpointImpl,
            srv_type: type[SrvT_co],
            srv_name: str,
            callback: Callable[[Any, Any], Any],
            callback_group: CallbackGroup,
            qos_profile: QoSProfile,
            *,
            on_destroy: Callable[[Any], None] | None = None,
        ) -> None:
            self.__init(
                service_impl,
                srv_type,
                srv_name,
                callback,
                qos_profile,
                on_destroy=on_destroy,
                callback_group=callback_group,
            )
