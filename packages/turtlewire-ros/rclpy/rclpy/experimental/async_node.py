"""Nodes for asyncio."""

from __future__ import annotations

import asyncio
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from types import TracebackType
from typing import TYPE_CHECKING, Any, Literal, overload

from rclpy._execution.asyncio_loop import loops_of_nodes, running_loop
from rclpy._execution.handle import closed_on_error
from rclpy._node.base import BaseNode
from rclpy._node.checks import check_callable, validate_qos
from rclpy._node.declarations import name_alone_text
from rclpy.clock_type import ClockType
from rclpy.constants import S_TO_NS
from rclpy.impl.hints import with_hint
from rclpy.qos import qos_profile_services_default

from ._async_entity import AsyncEntity, TaskGroup
from .async_client import AsyncClient, wait_for_graph
from .async_clock import AsyncClock
from .async_publisher import AsyncPublisher
from .async_service import AsyncService
from .async_subscription import AsyncSubscription
from .async_timer import AsyncTimer

if TYPE_CHECKING:
    from typing_extensions import Self

    from rcl_interfaces.msg import ParameterDescriptor
    from rclpy._typing import MsgT, SrvT
    from rclpy.parameter import Parameter
    from rclpy.qos import QoSProfile
    from rclpy.subscription import MessageInfo
    from rclpy.subscription_content_filter_options import ContentFilterOptions

_NOT_IN_ASYNCIO = (
    "An AsyncNode has no executor and no callback groups, and so no actions, rates, guard "
    "conditions and waitables: use an rclpy.node.Node and an executor for these"
)


class AsyncNode(BaseNode):
    """A node whose callbacks run in asyncio: there is no executor, and nothing spins.

    ``async with node:`` serves it, ``await node.run()`` does so until it is destroyed. Callbacks
    are ``def`` or ``async def``. The task of each subscription, service, client and timer belongs
    to a task group of the node: an exception in a callback cancels the other callbacks and the
    block, and ``async with`` raises it in an ``ExceptionGroup``.

    Like asyncio itself, it is used in the thread of the loop. Only the shutdown of its context may
    come from other threads.

    Args:
        node_name: Base name. :class:`rclpy.node.Node` describes all arguments in detail.
        context: Its context.
        cli_args: Command line of this node alone.
        namespace: Its namespace.
        use_global_arguments: Whether the command line of the context applies.
        enable_rosout: Whether what it logs is published on ``/rosout``.
        rosout_qos_profile: Quality of service of ``/rosout``; an int is a depth.
        start_parameter_services: Whether other nodes can read and set its parameters.
        parameter_overrides: Values that take precedence over the command line's.
        allow_undeclared_parameters: Whether parameters can be set and read without being declared.
        automatically_declare_parameters_from_overrides: Whether all overrides are declared at once.
        enable_logger_service: Whether other nodes can set its log levels.
    """

    _clock: AsyncClock

    __loop: asyncio.AbstractEventLoop | None = None
    __in_main_thread = False
    __group: TaskGroup | None = None
    __is_destroyed = False
    __end: asyncio.Event | None = None

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError, with a hint for attributes of ordinary nodes."""
            error = AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            raise with_hint(error, _NOT_IN_ASYNCIO if name in _other_attributes() else "")

    def _rclpy_end_with_context(self) -> None:
        self._context.on_shutdown(self._rclpy_on_shutdown)

    def _rclpy_make_clock(self) -> AsyncClock:
        return AsyncClock(clock_type=ClockType.ROS_TIME)

    def get_clock(self) -> AsyncClock:
        """Return its clock.

        ROS time, which follows ``/clock`` when the parameter ``use_sim_time`` is true.
        """
        return self._clock

    # Running and ending

    async def __aenter__(self) -> Self:
        """Serve it in the running loop.

        Raises:
            RuntimeError: The node runs already, or was destroyed.
        """
        if self.__is_destroyed:
            raise RuntimeError("Node has been destroyed and cannot be reentered")
        if self.__group is not None:
            raise RuntimeError("Node is already running")
        self.__loop = asyncio.get_running_loop()
        loops_of_nodes.add(self.__loop)
        self.__in_main_thread = threading.current_thread() is threading.main_thread()
        self.__end = asyncio.Event()
        self.__group = group = TaskGroup()
        await group.__aenter__()
        if not self._context.ok():  # a signal came since it was made
            self.__loop.call_soon(self.destroy_node)
        for entity in self._rclpy_endpoints.entities():
            if isinstance(entity, AsyncEntity):
                entity._start(group)
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> bool | None:
        """Destroy it and wait for its callbacks, which are cancelled."""
        assert self.__group is not None
        self.destroy_node()
        is_handled: bool | None = await self.__group.__aexit__(kind, error, trace)
        return is_handled

    async def run(self) -> None:
        """Serve it until it is destroyed, by a callback for example, or its context is shut down.

        Raises:
            RuntimeError: The node runs already, or was destroyed.
            ExceptionGroup: A callback raised an exception.
        """
        async with self:
            assert self.__end is not None
            await self.__end.wait()

    def destroy_node(self) -> None:
        """Leave the graph, close all endpoints and cancel all callbacks and sleeps. Idempotent.

        In a callback, the next ``await`` of this callback is cancelled as well.
        """
        if self.__is_destroyed:
            return
        self.__is_destroyed = True
        if self.__end is not None:
            self.__end.set()
        self._rclpy_endpoints.destroy_all()
        self._clock._destroy()
        self._rclpy_core.close()

    def _rclpy_on_shutdown(self) -> None:
        """Destroy the node, in its own thread; any thread calls this at the end of the context."""
        loop, signum = self.__loop, self._context.signal
        if signum is None and (loop is None or loop.is_closed() or running_loop() is loop):
            self.destroy_node()
        # After SIGINT, KeyboardInterrupt ends the loop of the main thread, and the node with it.
        elif loop is not None and not (signum == signal.SIGINT and self.__in_main_thread):
            with suppress(RuntimeError):  # the loop has just been closed
                loop.call_soon_threadsafe(self.destroy_node)

    async def wait_for_node(
        self,
        fully_qualified_node_name: str,
        *,
        check_interval: float = 0.1,  # noqa: ARG002 - nothing polls
    ) -> None:
        """Wait until another node is known; ``asyncio.timeout`` limits the time.

        Args:
            fully_qualified_node_name: Its name; the slash at the beginning may be missing.
            check_interval: Ignored, because nothing polls: changes of the graph end the wait.

        Raises:
            InvalidHandle: This node was destroyed.
        """
        graph = self._rclpy_graph
        await wait_for_graph(self._context, lambda: graph.has_node(fully_qualified_node_name))

    # Endpoints

    def create_publisher(
        self, msg_type: type[MsgT], topic: str, qos_profile: QoSProfile | int
    ) -> AsyncPublisher[MsgT]:
        """Announce a publisher.

        Args:
            msg_type: Class of its messages.
            topic: Name of the topic.
            qos_profile: Quality of service, or a history depth.

        Raises:
            RuntimeError: The node was destroyed.
            InvalidTopicNameException: The name breaks the rules.
        """
        self.__check_alive("publisher")
        profile = validate_qos(qos_profile)
        impl = self._rclpy_endpoints.announce("publisher", msg_type, topic, profile)
        return self._rclpy_endpoints.keep(AsyncPublisher(impl, msg_type, topic, profile, None))

    @overload
    def create_subscription(
        self,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[[MsgT], Any] | Callable[[MsgT, MessageInfo], Any] | None,
        qos_profile: QoSProfile | int,
        *,
        raw: Literal[False] = ...,
        concurrent: bool = False,
        content_filter_options: ContentFilterOptions | None = None,
    ) -> AsyncSubscription[MsgT]: ...

    @overload
    def create_subscription(
        self,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[[bytes], Any] | Callable[[bytes, MessageInfo], Any] | None,
        qos_profile: QoSProfile | int,
        *,
        raw: Literal[True],
        concurrent: bool = False,
        content_filter_options: ContentFilterOptions | None = None,
    ) -> AsyncSubscription[Any]: ...

    def create_subscription(
        self,
        msg_type: type[Any],
        topic: str,
        callback: Callable[[Any], Any] | Callable[[Any, MessageInfo], Any] | None,
        qos_profile: QoSProfile | int,
        *,
        raw: bool = False,
        concurrent: bool = False,
        content_filter_options: ContentFilterOptions | None = None,  # noqa: ARG002 - none filters
    ) -> AsyncSubscription[Any]:
        """Subscribe to a topic.

        Args:
            msg_type: Class of its messages.
            topic: Name of the topic.
            callback: Called with each message, and with the message info if it takes two
                arguments. None (not in ROS 2): the program iterates with ``async for``.
            qos_profile: Quality of service, or a history depth.
            raw: Whether messages are given as serialized bytes.
            concurrent: Whether a message may be handled while callbacks of former ones run.
            content_filter_options: Ignored: no middleware here filters by content.

        Raises:
            RuntimeError: The node was destroyed, or the callback takes other arguments.
            InvalidTopicNameException: The name breaks the rules.
        """
        self.__check_alive("subscription")
        profile = validate_qos(qos_profile)
        announced = self._rclpy_endpoints.announce("subscription", msg_type, topic, profile)
        with closed_on_error(announced) as impl:
            subscription = AsyncSubscription(
                impl, msg_type, topic, callback, profile, None, raw, concurrent, self.__group
            )
        return self._rclpy_endpoints.keep(subscription)

    def create_service(
        self,
        srv_type: type[SrvT],
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        concurrent: bool = False,
    ) -> AsyncService[SrvT]:
        """Offer a service.

        Args:
            srv_type: The service class.
            srv_name: Name of the service.
            callback: Called with a request and a response, which it fills in and returns.
            qos_profile: Quality of service of requests and responses.
            concurrent: Whether a request may be handled while callbacks of former ones run.

        Raises:
            RuntimeError: The node was destroyed.
            InvalidServiceNameException: The name breaks the rules.
        """
        self.__check_alive("service")
        check_callable(callback)
        impl = self._rclpy_endpoints.announce("service", srv_type, srv_name, qos_profile)
        return self._rclpy_endpoints.keep(
            AsyncService(
                impl, srv_type, srv_name, callback, qos_profile, None, concurrent, self.__group
            )
        )

    def create_client(
        self,
        srv_type: type[SrvT],
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
    ) -> AsyncClient[SrvT]:
        """Return a client of a service.

        Args:
            srv_type: The service class.
            srv_name: Name of the service.
            qos_profile: Quality of service of requests and responses.

        Raises:
            RuntimeError: The node was destroyed.
            InvalidServiceNameException: The name breaks the rules.
        """
        self.__check_alive("client")
        impl = self._rclpy_endpoints.announce("client", srv_type, srv_name, qos_profile)
        return self._rclpy_endpoints.keep(
            AsyncClient(self._context, impl, srv_type, srv_name, qos_profile, None, self.__group)
        )

    def create_timer(
        self, timer_period_sec: float, callback: Callable[..., Any], autostart: bool = True
    ) -> AsyncTimer:
        """Return a timer that follows the clock of the node.

        Args:
            timer_period_sec: Seconds between calls; 0 calls in each turn of the loop.
            callback: Called without arguments, or with a :class:`~rclpy.timer.TimerInfo` if it
                takes one.
            autostart: Whether it runs at once, or waits for :meth:`AsyncTimer.reset`.

        Raises:
            RuntimeError: The node was destroyed, or the callback takes other arguments.
        """
        self.__check_alive("timer")
        check_callable(callback)
        # Truncated, not rounded, as in ROS 2.
        period_ns = int(float(timer_period_sec) * S_TO_NS)
        return self._rclpy_endpoints.keep(
            AsyncTimer(
                period_ns, self._clock, self._context, callback, autostart, None, self.__group
            )
        )

    def __check_alive(self, what: str) -> None:
        if self.__is_destroyed:
            raise RuntimeError(f"Cannot create {what} on a destroyed node")

    # Parameters

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter; see :meth:`rclpy.node.Node.declare_parameter`.

        Raises:
            TypeError: Neither a value nor a type nor a descriptor is given.
        """
        if value is None and descriptor is None:
            raise TypeError(name_alone_text(name, "not allowed"))
        return super().declare_parameter(name, value, descriptor, ignore_override)

    def declare_parameters(
        self, namespace: str, parameters: list[Any], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare several parameters, each as ``(name, value or type[, descriptor])``.

        Raises:
            TypeError: A name stands alone.
        """
        for declaration in parameters:
            if len(declaration) == 1:
                raise TypeError(name_alone_text(declaration[0], "not allowed"))
        return super().declare_parameters(namespace, parameters, ignore_override)


def _other_attributes() -> set[str]:
    """Return the public attributes of ordinary nodes."""
    from rclpy.node import Node

    return {name for name in dir(Node) if not name.startswith("_")}
