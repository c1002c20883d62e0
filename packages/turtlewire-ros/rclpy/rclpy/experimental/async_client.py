"""Service clients of asynchronous nodes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._typing import RequestT, ResponseT, SrvT_co
from rclpy.client import BaseClient
from turtlewire.wake_up import LoopWakeUp

from ._async_entity import AsyncEndpoint

if TYPE_CHECKING:
    from rclpy._execution.handle import EndpointImpl
    from rclpy.context import Context
    from rclpy.qos import QoSProfile
    from turtlewire.msg import Service as ServiceClass

    from ._async_entity import TaskGroup


class AsyncClient(AsyncEndpoint, BaseClient[SrvT_co]):
    """Calls a service; made by :meth:`AsyncNode.create_client`.

    No method has its own timeout: use ``async with asyncio.timeout(…)``.

    Args:
        context: The context of the node.
        client_impl: The announced endpoint of the node.
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        qos_profile: Quality of service of requests and responses.
        on_destroy: Called with the client after it has been destroyed.
        tg: Its tasks handle the responses; None if the node does not run yet.

    Attributes:
        srv_type: The service class.
        srv_name: Name of the service, as it was given.
        qos_profile: Quality of service of requests and responses.
    """

    def __init__(
        self,
        context: Context,
        client_impl: EndpointImpl,
        srv_type: type[SrvT_co],
        srv_name: str,
        qos_profile: QoSProfile,
        on_destroy: Callable[[Any], None] | None,
        tg: TaskGroup | None = None,
    ) -> None:
        super().__init__(
            context, client_impl, srv_type, srv_name, qos_profile, on_destroy=on_destroy
        )
        self._start(tg)

    async def call(
        self: AsyncClient[ServiceClass[RequestT, ResponseT]], request: RequestT
    ) -> ResponseT:
        """Send a request and return its response, while the node runs.

        A cancelled call forgets its request: a late response is ignored. There may be several calls
        at a time.

        Raises:
            RuntimeError: The client was destroyed before.
            asyncio.CancelledError: The client was destroyed during the call.
            TypeError: ``request`` is not a ``srv_type.Request``.
            UncallableServiceError: A server of the service would misread the request.
        """
        if self._destroyed:
            raise RuntimeError("Calling a destroyed client is forbidden")
        future: Any = self._request(request)
        try:
            response: ResponseT = await future
        finally:
            self._forget(future)
        if future.cancelled():
            raise asyncio.CancelledError
        return response

    async def wait_for_service(self, *, check_interval: float = 0.1) -> None:  # noqa: ARG002
        """Wait until a server is available.

        Args:
            check_interval: Ignored, because nothing polls: changes of the graph end the wait.

        Raises:
            InvalidHandle: The client was destroyed, before or during the wait.
            RCLError: The context was shut down.
        """
        await wait_for_graph(self._context, self._look_for_server)

    def _close(self) -> None:
        super()._close()
        with self._lock:
            pending = list(self._pending.values())
        for future in pending:
            future.cancel()
        self._context.wake_waits()  # for wait_for_service()


async def wait_for_graph(context: Context, predicate: Callable[[], bool]) -> None:
    """Wait until ``predicate()`` is true, looking again after each change of the graph.

    It also looks after a shutdown: the predicate raises then.
    """
    changed = LoopWakeUp(asyncio.get_running_loop())
    with context.waking_at_changes(changed):
        while not predicate():
            await changed.wait()
