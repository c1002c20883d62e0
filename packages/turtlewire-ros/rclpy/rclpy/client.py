"""Service clients."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, overload

from turtlewire.distro import KILTED, since
from turtlewire.errors import CdrError, UncallableServiceError, WireError
from turtlewire.msg import deserialize, serialize
from turtlewire.wire.services import require_callable

from ._execution.blocking import BlockingCall, limit_ns, wait_for_response
from ._node.checks import check_valid
from ._rclpy_pybind11 import RCLError
from ._typing import RequestT, ResponseT, SrvT_co, T
from ._typing import RequestT as SrvTypeRequest
from ._typing import ResponseT as SrvTypeResponse
from ._typing import SrvT as SrvType
from .impl.hints import described
from .service_introspection import EventType, IntrospectedEndpoint
from .task import Future

if TYPE_CHECKING:
    from turtlewire.msg import Service as ServiceClass
    from turtlewire.wire import base

    from ._execution.entity import Work
    from ._execution.handle import EndpointImpl
    from .callback_groups import CallbackGroup
    from .context import Context
    from .qos import QoSProfile

__all__ = ["BaseClient", "Client", "SrvType", "SrvTypeRequest", "SrvTypeResponse"]


class BaseClient(IntrospectedEndpoint, Generic[SrvT_co]):
    """Sends requests and takes their responses.

    Args:
        context: The context of the node.
        client_impl: The announced endpoint of the node.
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        qos_profile: Quality of service of requests and responses.
        on_destroy: Called with the client after it has been destroyed.

    Attributes:
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        qos_profile: Quality of service of requests and responses.
    """

    _wire: base.Client

    def __init__(
        self,
        context: Context,
        client_impl: EndpointImpl,
        srv_type: type[SrvT_co],
        srv_name: str,
        qos_profile: QoSProfile,
        *,
        on_destroy: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(client_impl.wire, client_impl.core, srv_type, on_destroy)
        self.srv_name = srv_name
        self.qos_profile = qos_profile
        self._context = context
        self._lock = threading.Lock()
        self._pending: dict[int, Future] = {}
        self._said_why_not_called = False

    def _request(self, request: Any) -> Future[Any]:
        """Send a request.

        Returns:
            A future of the response. It has an exception at once if a server of the service runs on
            a middleware that would misread the request.

        Raises:
            TypeError: ``request`` is not a ``srv_type.Request``.
            InvalidHandle: The client was destroyed, perhaps by another thread during the call.
            RCLError: The context was shut down.
        """
        self._check_usable()
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(
                f"A request of service '{self._wire.service}' is a "
                f"{self.srv_type.__name__}.Request(), not {described(request)}"
            )
        future = Future()
        try:
            # The response may arrive before `_send` returns, and has to find the future.
            with self._lock:
                sequence_number = self._send(serialize(request))
                self._pending[sequence_number] = future
        except UncallableServiceError as error:
            self._say_why_not_called(error)
            future.set_exception(error)
            return future
        if self._events is not None:
            self._events.publish(
                EventType.REQUEST_SENT, self._wire.client_id, sequence_number, request=request
            )
        # A future that the program cancels needs no response any more.
        future._add_waiter(lambda: self._pending.pop(sequence_number, None))
        return future

    def _send(self, cdr: bytes) -> int:
        try:
            return self._wire.send_request(cdr)
        except WireError:
            self._check_usable()  # raises if another thread has destroyed the client
            if self._context.is_open():
                raise
            raise RCLError("failed to send request: client's context is invalid") from None

    def _forget(self, future: Future) -> None:
        """Forget a request: its response will be ignored."""
        with self._lock:
            for sequence_number, pending in list(self._pending.items()):
                if pending is future:
                    del self._pending[sequence_number]
                    return

    def service_is_ready(self) -> bool:
        """Return True if a server is available.

        Raises:
            InvalidHandle: The client was destroyed.
            RCLError: The context was shut down.
        """
        self._check_usable()
        failure = "failed to check service availability"
        check_valid(self._context, failure)
        try:
            return self._wire.is_ready()
        except WireError:
            check_valid(self._context, failure)
            raise

    def _look_for_server(self) -> bool:
        """Return True if a server is available; logs once why an existing one is not called."""
        if self.service_is_ready():
            return True
        try:
            require_callable(self._context.wire.graph, self._wire.service)
        except UncallableServiceError as error:
            self._say_why_not_called(error)
        return False

    def _say_why_not_called(self, error: UncallableServiceError) -> None:
        if not self._said_why_not_called:
            self._said_why_not_called = True
            self._logger.warning(error.in_one_line())

    def _take(self) -> Work | None:
        for sequence_number, cdr in self._wire.take(1):
            with self._lock:
                future = self._pending.pop(sequence_number, None)
            if future is None:
                # The program has abandoned the request.
                return None
            try:
                response = deserialize(self.srv_type.Response, cdr)
            except CdrError as error:
                # The caller's future gets the error; raised here, it would end the spin.
                return future.set_exception, (error,)
            if self._events is not None:
                self._events.publish(
                    EventType.RESPONSE_RECEIVED,
                    self._wire.client_id,
                    sequence_number,
                    response=response,
                )
            future._set_executor(self._serving_host())
            return future.set_result, (response,)
        return None


class Client(BaseClient[SrvT_co]):
    """Calls a service; made by :meth:`Node.create_client <rclpy.node.Node.create_client>`.

    Thread-safe.

    Responses are handed to their futures whatever the callback group is doing: a callback that
    awaits a response, or blocks for it in :meth:`call` while another thread spins, never waits for
    itself.

    Args:
        context: The context of the node.
        client_impl: The announced endpoint of the node.
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        qos_profile: Quality of service of requests and responses.
        callback_group: The group of the client.
        on_destroy: Called with the client after it has been destroyed.
    """

    _ORDER = 3
    _GATED = False

    def __init__(
        self,
        context: Context,
        client_impl: EndpointImpl,
        srv_type: type[SrvT_co],
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
        *,
        on_destroy: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(
            context, client_impl, srv_type, srv_name, qos_profile, on_destroy=on_destroy
        )
        self._enter(callback_group)
        self._blocking: set[Future] = set()

    def call_async(
        self: Client[ServiceClass[RequestT, ResponseT]], request: RequestT
    ) -> Future[ResponseT]:
        """Send a request.

        Returns:
            A future of the response; spinning the node finishes it. It has an exception at once if
            a server of the service runs on a middleware that would misread the request.

        Raises:
            TypeError: ``request`` is not a ``srv_type.Request``.
            InvalidHandle: The client was destroyed, perhaps by another thread during the call.
            RCLError: The context was shut down.
        """
        return self._request(request)

    @overload
    def call(
        self: Client[ServiceClass[RequestT, ResponseT]], request: RequestT, timeout_sec: None = ...
    ) -> ResponseT: ...

    @overload
    def call(
        self: Client[ServiceClass[RequestT, ResponseT]], request: RequestT, timeout_sec: float
    ) -> ResponseT | None: ...

    def call(
        self: Client[ServiceClass[RequestT, ResponseT]],
        request: RequestT,
        timeout_sec: float | None = None,
    ) -> ResponseT | None:
        """Send a request and block until its response is here.

        Another thread may spin the node. In a callback of the executor itself, only responses are
        served during the call.

        Returns:
            The response; in Jazzy, None if none came within ``timeout_sec``.

        Raises:
            TimeoutError: None came within ``timeout_sec``; in Kilted and later.
            TypeError: ``request`` is not a ``srv_type.Request``.
            RuntimeError: The service is in the executor that is blocked by this call: it could
                never answer.
            InvalidHandle: Another thread destroyed the client during the call.
            ExternalShutdownException, ShutdownException: The context or the executor was shut down.
        """
        future = self.call_async(request)
        response = self._block_for(future, timeout_sec)
        if not future.done() and since(KILTED):
            raise TimeoutError
        return response

    def _block_for(self, future: Future[T], timeout_sec: float | None) -> T | None:
        """Block until ``future``, which follows from a request of this client, is done.

        Returns:
            Its result; None when the time was over before.
        """
        self._blocking.add(future)
        try:
            # After `add`: if the client is destroyed from here on, `_close` cancels the future.
            self._check_usable()
            call = BlockingCall(
                self._wire.service, self._context, self._logger, self._serving_host()
            )
            wait_for_response(future, call, timeout_sec)
        finally:
            self._blocking.discard(future)
            self._forget(future)
        if future.cancelled():
            self._check_usable()
        return future.result() if future.done() else None

    def _awaits(self, service: str) -> bool:
        return bool(self._pending) and self._wire.service == service

    def get_pending_request(self, sequence_number: int) -> Future[Any]:
        """Return the future of an unanswered request; raise KeyError for another number."""
        with self._lock:
            return self._pending[sequence_number]

    def remove_pending_request(self, future: Future) -> None:
        """Forget a request: its response will be ignored."""
        self._forget(future)

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Block until a server is available (no polling).

        A server on a middleware that would misread requests does not count; a warning in the log
        says so.

        Args:
            timeout_sec: None or infinite waits without a limit, 0 or negative does not wait.

        Returns:
            True if a server is available, False after the timeout.

        Raises:
            InvalidHandle: The client was destroyed, before or during the wait.
            RCLError: The context was shut down, before or during the wait.
        """
        return self._context.wait_for_graph(self._look_for_server, limit_ns(timeout_sec))

    def _close(self) -> None:
        super()._close()
        for future in list(self._blocking):
            future.cancel()
        self._context.wake_waits()  # for wait_for_service()
