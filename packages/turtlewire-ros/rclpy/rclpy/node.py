"""The node: a named participant of the graph, with its endpoints, timers and parameters.

:class:`Node` itself holds no logic: each method hands over to the part that does the work.
``_node/base.py`` has what asynchronous nodes have as well, ``_node/endpoints.py`` makes and keeps
the endpoints, ``_node/graph.py`` answers questions about other nodes, ``_node/parameters.py`` keeps
the parameters.

Programs derive from it and add their own attributes. Therefore, all attributes that ROS 2's
class does not have (it has ``_logger``, ``_clock`` …) begin with two underscores, or with
``_rclpy`` if other modules need them.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Literal, overload

from ._node.base import BaseNode, component_arguments
from ._node.endpoints import QosOverrides
from ._rclpy_pybind11 import NodeNameNonExistentError
from .client import Client, SrvType, SrvTypeRequest, SrvTypeResponse
from .clock import Clock, ClockType
from .constants import S_TO_NS
from .guard_condition import GuardCondition
from .impl.reexports import reexports
from .parameter import PARAMETER_SEPARATOR_STRING
from .publisher import MsgType, Publisher
from .qos import qos_profile_services_default
from .service import Service
from .subscription import MessageInfo, Subscription
from .timer import Rate, Timer

if TYPE_CHECKING:
    from typing_extensions import Self

    from ._typing import MsgT, SrvT
    from .callback_groups import CallbackGroup
    from .executors import Executor
    from .qos import QoSProfile
    from .qos_overriding_options import QoSOverridingOptions
    from .subscription_content_filter_options import ContentFilterOptions
    from .waitable import Waitable

__all__ = [
    "HIDDEN_NODE_PREFIX",
    "PARAMETER_SEPARATOR_STRING",
    "S_TO_NS",
    "BaseNode",
    "MsgType",
    "Node",
    "NodeNameNonExistentError",
    "SrvType",
    "SrvTypeRequest",
    "SrvTypeResponse",
    "component_arguments",
]

__getattr__ = reexports(
    __name__,
    {
        "rcl_interfaces.msg": (
            "FloatingPointRange",
            "IntegerRange",
            "ListParametersResult",
            "ParameterDescriptor",
            "ParameterEvent",
            "ParameterType",
            "ParameterValue",
            "SetParametersResult",
        ),
        "rcl_interfaces.srv": ("ListParameters",),
        "rclpy.callback_groups": (
            "CallbackGroup",
            "MutuallyExclusiveCallbackGroup",
            "ReentrantCallbackGroup",
        ),
        "rclpy.clock": ("Clock", "ROSClock"),
        "rclpy.context": ("Context",),
        "rclpy.event_handler": ("PublisherEventCallbacks", "SubscriptionEventCallbacks"),
        "rclpy.exceptions": (
            "InvalidHandle",
            "InvalidParameterTypeException",
            "InvalidParameterValueException",
            "InvalidTopicNameException",
            "NotInitializedException",
            "ParameterAlreadyDeclaredException",
            "ParameterImmutableException",
            "ParameterNotDeclaredException",
            "ParameterUninitializedException",
        ),
        "rclpy.executors": ("Executor",),
        "rclpy.expand_topic_name": ("expand_topic_name",),
        "rclpy.logging": ("get_logger",),
        "rclpy.logging_service": ("LoggingService",),
        "rclpy.parameter": ("Parameter",),
        "rclpy.parameter_service": ("ParameterService",),
        "rclpy.qos": (
            "QoSProfile",
            "qos_profile_parameter_events",
            "qos_profile_rosout_default",
        ),
        "rclpy.qos_overriding_options": ("QoSOverridingOptions",),
        "rclpy.endpoint_info": ("TopicEndpointInfo",),
        "rclpy.time_source": ("TimeSource",),
        "rclpy.type_description_service": ("TypeDescriptionService",),
        "rclpy.type_support": ("check_is_valid_msg_type", "check_is_valid_srv_type"),
        "rclpy.utilities": ("get_default_context",),
        "rclpy.validate_full_topic_name": ("validate_full_topic_name",),
        "rclpy.validate_namespace": ("validate_namespace",),
        "rclpy.validate_node_name": ("validate_node_name",),
        "rclpy.validate_parameter_name": ("validate_parameter_name",),
        "rclpy.validate_topic_name": ("validate_topic_name",),
        "rclpy.waitable": ("Waitable",),
    },
)


#: Tools omit nodes whose names begin with it.
HIDDEN_NODE_PREFIX = "_"


class Node(BaseNode):
    """A node. Thread-safe.

    Args:
        node_name: Base name (no slashes); ``--ros-args -r __node:=…`` replaces it.
        context: None uses the default context.
        cli_args: Command line of this node alone; its ``--ros-args`` precede the ones of the
            context.
        namespace: None and "" mean "/"; ``--ros-args -r __ns:=…`` replaces it.
        use_global_arguments: Whether the command line of the context applies.
        enable_rosout: Whether what it logs is published on ``/rosout``.
        rosout_qos_profile: Quality of service of ``/rosout``; an int is a depth.
        start_parameter_services: Whether other nodes can read and set its parameters.
        parameter_overrides: Values that take precedence over the command line's.
        allow_undeclared_parameters: Whether parameters can be set and read without being declared.
        automatically_declare_parameters_from_overrides: Whether all overrides are declared at once.
        enable_logger_service: Whether other nodes can set its log levels.

    Raises:
        NotInitializedException: ``rclpy.init()`` was not called, or the context is shut down.
        InvalidNodeNameException, InvalidNamespaceException: A name breaks the rules.
    """

    _clock: Clock

    __executor: weakref.ref[Executor] | None = None

    def _rclpy_end_with_context(self) -> None:
        self._context.track_node(self)

    def _rclpy_make_clock(self) -> Clock:
        return Clock(clock_type=ClockType.ROS_TIME)

    def get_clock(self) -> Clock:
        """Return its clock.

        ROS time, which follows ``/clock`` when the parameter ``use_sim_time`` is true.
        """
        return self._clock

    def __enter__(self) -> Self:
        return self

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        self.destroy_node()

    @property
    def executor(self) -> Executor | None:
        """The last executor that served it; setting it moves the node there."""
        return None if self.__executor is None else self.__executor()

    @executor.setter
    def executor(self, new_executor: Executor | None) -> None:
        current = self.executor
        if new_executor is not None:
            new_executor.add_node(self)
        elif current is not None:
            current.remove_node(self)
            self.__executor = None

    def _rclpy_served_by(self, executor: Executor) -> None:
        """Note the executor that serves it."""
        self.__executor = weakref.ref(executor)

    @property
    def default_callback_group(self) -> CallbackGroup:
        """Mutually exclusive group of entities created without a group."""
        return self._rclpy_endpoints.default_callback_group

    @property
    def publishers(self) -> Iterator[Publisher[Any]]:
        """The publishers of the node."""
        yield from self._rclpy_endpoints.of(Publisher)

    @property
    def subscriptions(self) -> Iterator[Subscription[Any]]:
        """The subscriptions of the node."""
        yield from self._rclpy_endpoints.of(Subscription)

    @property
    def clients(self) -> Iterator[Client[Any]]:
        """The service clients of the node."""
        yield from self._rclpy_endpoints.of(Client)

    @property
    def services(self) -> Iterator[Service[Any]]:
        """The services of the node."""
        yield from self._rclpy_endpoints.of(Service)

    @property
    def timers(self) -> Iterator[Timer]:
        """The timers of the node."""
        yield from self._rclpy_endpoints.of(Timer)

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """The guard conditions of the node."""
        yield from self._rclpy_endpoints.of(GuardCondition)

    @property
    def waitables(self) -> Iterator[Waitable]:
        """The waitables of the node: actions, and waitables that programs add."""
        from .waitable import Waitable

        yield from self._rclpy_endpoints.of(Waitable)

    # Endpoints

    def create_publisher(
        self,
        msg_type: type[MsgT],
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        publisher_class: type[Publisher[Any]] = Publisher,
    ) -> Publisher[MsgT]:
        """Announce a publisher.

        Args:
            msg_type: Class of its messages.
            topic: Name of the topic.
            qos_profile: Quality of service, or a history depth.
            callback_group: For event callbacks; None uses the node's default.
            event_callbacks: Functions to call on events of the quality of service
                (:class:`rclpy.event_handler.PublisherEventCallbacks`).
            qos_overriding_options: Which policies parameters may override.
            publisher_class: Class to instantiate.

        Raises:
            InvalidTopicNameException: The name breaks the rules.
            TypeError: ``qos_profile`` is neither a profile nor a depth.
            ValueError: The depth is negative.
        """
        return self._rclpy_endpoints.create_publisher(
            msg_type,
            topic,
            qos_profile,
            callback_group,
            event_callbacks,
            publisher_class,
            QosOverrides(qos_overriding_options, self._parameters),
        )

    @overload
    def create_subscription(
        self,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[[MsgT], Any] | Callable[[MsgT, MessageInfo], Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: Literal[False] = ...,
        content_filter_options: ContentFilterOptions | None = None,
        acceptable_buffer_backends: str | None = None,
    ) -> Subscription[MsgT]: ...

    @overload
    def create_subscription(
        self,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[[bytes], Any] | Callable[[bytes, MessageInfo], Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: Literal[True],
        content_filter_options: ContentFilterOptions | None = None,
        acceptable_buffer_backends: str | None = None,
    ) -> Subscription[MsgT]: ...

    @overload
    def create_subscription(
        self,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool,
        content_filter_options: ContentFilterOptions | None = None,
        acceptable_buffer_backends: str | None = None,
    ) -> Subscription[MsgT]: ...

    def create_subscription(
        self,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
        content_filter_options: ContentFilterOptions | None = None,  # noqa: ARG002 - see below
        acceptable_buffer_backends: str | None = None,  # noqa: ARG002 - likewise
    ) -> Subscription[MsgT]:
        """Announce a subscription.

        Args:
            msg_type: Class of its messages.
            topic: Name of the topic.
            callback: Called with each message, and with a message info when it takes two arguments;
                may be ``async``.
            qos_profile: Quality of service, or a history depth.
            callback_group: None uses the node's default.
            event_callbacks: Functions to call on events of the quality of service
                (:class:`rclpy.event_handler.SubscriptionEventCallbacks`).
            qos_overriding_options: Which policies parameters may override.
            raw: Whether the callback gets the serialized bytes.
            content_filter_options: Without effect, as with any middleware that cannot filter;
                ``is_cft_enabled`` says so.
            acceptable_buffer_backends: Without effect, as there are no buffer backends: long fields
                of bytes are always plain arrays.

        Raises:
            InvalidTopicNameException: The name breaks the rules.
            TypeError: ``qos_profile`` is neither a profile nor a depth.
            ValueError: The depth is negative.
            RuntimeError: The callback takes neither one nor two arguments.
        """
        return self._rclpy_endpoints.create_subscription(
            msg_type,
            topic,
            callback,
            qos_profile,
            callback_group,
            event_callbacks,
            raw,
            QosOverrides(qos_overriding_options, self._parameters),
        )

    def create_client(
        self,
        srv_type: type[SrvT],
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client[SrvT]:
        """Announce a client of a service.

        Args:
            srv_type: The service class.
            srv_name: Name of the service.
            qos_profile: Quality of service of requests and responses.
            callback_group: None uses the node's default.

        Raises:
            InvalidServiceNameException: The name breaks the rules.
        """
        return self._rclpy_endpoints.keep(
            self._rclpy_endpoints.make_client(srv_type, srv_name, qos_profile, callback_group)
        )

    def create_service(
        self,
        srv_type: type[SrvT],
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Service[SrvT]:
        """Offer a service.

        Args:
            srv_type: The service class.
            srv_name: Name of the service.
            callback: Called with a request and an empty response, returns the response; may be
                ``async``.
            qos_profile: Quality of service of requests and responses.
            callback_group: None uses the node's default.

        Raises:
            InvalidServiceNameException: The name breaks the rules.
        """
        return self._rclpy_endpoints.keep(
            self._rclpy_endpoints.make_service(
                srv_type, srv_name, callback, qos_profile, callback_group
            )
        )

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Call ``callback()`` periodically.

        Args:
            timer_period_sec: Seconds between calls.
            callback: Function to call; may be ``async``.
            callback_group: None uses the node's default.
            clock: None uses the node's clock.
            autostart: False: it starts with :meth:`Timer.reset <rclpy.timer.Timer.reset>`.
        """
        return self._rclpy_endpoints.create_timer(
            timer_period_sec, callback, callback_group, clock or self._clock, autostart
        )

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Return a rate whose ``sleep()`` keeps a loop at ``frequency`` Hz.

        Another thread has to spin the node.

        Raises:
            ValueError: ``frequency`` is not positive.
        """
        return self._rclpy_endpoints.create_rate(frequency, clock or self._clock)

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Return a guard condition whose ``trigger()`` calls ``callback()`` on the executor."""
        return self._rclpy_endpoints.create_guard_condition(callback, callback_group)

    def add_waitable(self, waitable: Waitable) -> None:
        """Add ``waitable`` to the executor."""
        self._rclpy_endpoints.add_waitable(waitable)

    def remove_waitable(self, waitable: Waitable) -> None:
        """Remove ``waitable`` from the executor."""
        self._rclpy_endpoints.remove_waitable(waitable)

    def destroy_publisher(self, publisher: Publisher[Any]) -> bool:
        """Close a publisher; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(Publisher, publisher)

    def destroy_subscription(self, subscription: Subscription[Any]) -> bool:
        """Close a subscription; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(Subscription, subscription)

    def destroy_client(self, client: Client[Any]) -> bool:
        """Close a client; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(Client, client)

    def destroy_service(self, service: Service[Any]) -> bool:
        """Close a service; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(Service, service)

    def destroy_timer(self, timer: Timer) -> bool:
        """End a timer; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(Timer, timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """End a guard condition; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(GuardCondition, guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """End a rate and its sleeps; False when it is not of this node."""
        return self._rclpy_endpoints.destroy(Timer, rate._timer)

    def destroy_node(self) -> None:
        """Leave the graph and close all endpoints. Idempotent; also works after a shutdown."""
        # First, so that the executor never waits for endpoints that are closed.
        executor = self.executor
        if executor is not None:
            executor.remove_node(self)
        self._context.untrack_node(self)
        self._rclpy_endpoints.destroy_all()
        self._rclpy_core.close()

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Block until a node exists, at most ``timeout`` seconds (infinite: no limit).

        Return True if it exists.
        """
        return self._rclpy_graph.wait_for_node(fully_qualified_node_name, timeout)
