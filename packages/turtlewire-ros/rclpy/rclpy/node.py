"""The node: a named participant of the graph, with its endpoints, timers and parameters.

:class:`Node` itself holds no logic: each method hands over to the part that does the work.
``_node/endpoints.py`` makes and keeps the endpoints, ``_node/graph.py`` answers questions about
other nodes, ``parameters.py`` keeps the parameters.

Programs derive from it and have attributes of their own: beside those that ROS 2's has
(``_logger``, ``_clock`` …), ours begin with two underscores, or with ``_rclpy`` where other modules
need them.
"""

from __future__ import annotations

import weakref
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, Literal, overload

from turtlewire.wire import names

from ._execution.handle import Handle
from ._node.endpoints import NodeEndpoints, QosOverrides
from ._node.graph import NodeGraph
from ._node.parameters import NodeParameters
from ._node.state import NodeState
from ._rclpy_pybind11 import NodeNameNonExistentError
from .client import Client, SrvType, SrvTypeRequest, SrvTypeResponse
from .clock import ROSClock
from .exceptions import InvalidNamespaceException, InvalidNodeNameException, NotInitializedException
from .guard_condition import GuardCondition
from .impl.hints import with_hint
from .parameter import PARAMETER_SEPARATOR_STRING
from .parameter_service import ParameterService
from .publisher import MsgType, Publisher
from .qos import qos_profile_parameter_events, qos_profile_services_default
from .service import Service
from .subscription import MessageInfo, Subscription
from .time_source import TimeSource
from .timer import Rate, Timer
from .type_description_service import TypeDescriptionService

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from typing_extensions import Self

    from rcl_interfaces.msg import ListParametersResult, ParameterDescriptor, SetParametersResult
    from turtlewire.wire import base

    from ._typing import MsgT, SrvT
    from .callback_groups import CallbackGroup
    from .clock import Clock
    from .context import Context
    from .executors import Executor
    from .impl.arguments import Arguments
    from .impl.rcutils_logger import RcutilsLogger
    from .parameter import Parameter
    from .qos import QoSProfile
    from .qos_overriding_options import QoSOverridingOptions
    from .subscription_content_filter_options import ContentFilterOptions
    from .topic_endpoint_info import TopicEndpointInfo
    from .waitable import Waitable

__all__ = [
    "HIDDEN_NODE_PREFIX",
    "PARAMETER_SEPARATOR_STRING",
    "MsgType",
    "Node",
    "NodeNameNonExistentError",
    "SrvType",
    "SrvTypeRequest",
    "SrvTypeResponse",
    "component_arguments",
]

#: Command line for the next node of this thread, whose class need not know that it is loaded as a
#: component.
component_arguments: ContextVar[list[str] | None] = ContextVar("component_arguments", default=None)

#: Tools leave nodes out whose names begin so.
HIDDEN_NODE_PREFIX = "_"


class _MadeByConstructor:
    """Stands for an attribute until the constructor sets it.

    For programs whose ``__init__`` forgets that of its base.

    Args:
        name: The attribute. Not from ``__set_name__``: up to Python 3.11, a Ctrl-C in it becomes a
            ``RuntimeError``.
    """

    def __init__(self, name: str) -> None:
        self._name = name

    def __get__(self, node: object, owner: type | None = None) -> Any:
        error = AttributeError(f"{type(node).__name__!r} object has no attribute {self._name!r}")
        raise with_hint(
            error, "A node is used before it was made: call super().__init__('name') first"
        )


class Node:
    """A node. Thread-safe.

    Args:
        node_name: Base name (no slashes); ``--ros-args -r __node:=…`` replaces it.
        context: None takes the default context.
        cli_args: Command line of this node alone; its ``--ros-args`` precede the ones of the
            context.
        namespace: None and "" mean "/"; ``--ros-args -r __ns:=…`` replaces it.
        use_global_arguments: Whether the command line of the context applies.
        enable_rosout: Whether what it logs is published on ``/rosout``.
        start_parameter_services: Whether other nodes can read and set its parameters.
        parameter_overrides: Values that take precedence over the command line's.
        allow_undeclared_parameters: Whether parameters can be set and read without being declared.
        automatically_declare_parameters_from_overrides: Whether all overrides are declared at once.
        enable_logger_service: Whether other nodes can set its log levels.

    Raises:
        NotInitializedException: ``rclpy.init()`` was not called, or the context is shut down.
        InvalidNodeNameException, InvalidNamespaceException: A name breaks the rules.
    """

    PARAM_REL_TOL = 1e-6

    if not TYPE_CHECKING:
        _clock = _MadeByConstructor("_clock")
        _logger = _MadeByConstructor("_logger")
        _parameters = _MadeByConstructor("_parameters")
        _rclpy_endpoints = _MadeByConstructor("_rclpy_endpoints")

    def __init__(
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: list[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: list[Parameter] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        self.__executor: weakref.ref[Executor] | None = None
        self._context = _usable_context(context)
        arguments = _arguments(self._context, cli_args, use_global_arguments=use_global_arguments)
        name, namespace = _names(node_name, namespace or "/", arguments)
        self.__core = core = NodeState(
            self._context, name, namespace, arguments, enable_rosout=enable_rosout
        )
        self._logger = core.logger
        self._clock = ROSClock()
        self._rclpy_endpoints = NodeEndpoints(core)
        self.__graph = NodeGraph(core)
        self._parameters = NodeParameters(
            node_fqn=core.full_name,
            overrides=arguments.parameter_overrides(core.full_name),
            constructor_overrides=parameter_overrides,
            allow_undeclared=allow_undeclared_parameters,
            now=self._clock.now,
            publish_event=self.__parameter_event_publisher().publish,
        )
        if automatically_declare_parameters_from_overrides:
            self._parameters.declare_overrides()
        self._time_source = TimeSource(node=self)
        self._time_source.attach_clock(self._clock)
        if start_parameter_services:
            self._parameter_service = ParameterService(self)
        self._type_description_service = TypeDescriptionService(self)
        if enable_logger_service:
            from .logging_service import LoggingService

            self.__logging_service = LoggingService(self)

    def __parameter_event_publisher(self) -> Publisher[Any]:
        from rcl_interfaces.msg import ParameterEvent

        return self._rclpy_endpoints.create_publisher(
            ParameterEvent, "/parameter_events", qos_profile_parameter_events
        )

    # What it is

    def get_name(self) -> str:
        """Base name, after remapping."""
        return self.__core.name

    def get_namespace(self) -> str:
        """Namespace, after remapping."""
        return self.__core.namespace

    def get_fully_qualified_name(self) -> str:
        """Namespace and name, for example ``/robot1/camera``."""
        return self.__core.full_name

    def get_clock(self) -> Clock:
        """Its clock.

        ROS time, which follows ``/clock`` when the parameter ``use_sim_time`` is true.
        """
        return self._clock

    def get_logger(self) -> RcutilsLogger:
        """Its logger, named like the node with dots for slashes."""
        return self._logger

    @property
    def context(self) -> Context:
        """Its context."""
        return self._context

    @property
    def _rclpy_wire(self) -> base.Node:
        """The middleware's side of it; raises ``InvalidHandle`` after :meth:`destroy_node`."""
        return self.__core.wire

    @property
    def handle(self) -> Handle:
        """Stands for the C object that it has in ROS 2.

        Raises ``InvalidHandle`` after :meth:`destroy_node`.
        """
        return Handle(self._rclpy_wire)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.destroy_node()

    @property
    def executor(self) -> Executor | None:
        """The executor that serves it; setting it moves the node there."""
        return None if self.__executor is None else self.__executor()

    @executor.setter
    def executor(self, new_executor: Executor | None) -> None:
        current = self.executor
        if current is new_executor:
            return
        if current is not None:
            current.remove_node(self)
        self.__executor = None if new_executor is None else weakref.ref(new_executor)
        if new_executor is not None:
            new_executor.add_node(self)

    @property
    def default_callback_group(self) -> CallbackGroup:
        """Mutually exclusive group of entities created without a group."""
        return self._rclpy_endpoints.default_callback_group

    @property
    def publishers(self) -> Iterator[Publisher[Any]]:
        """Its publishers."""
        yield from self._rclpy_endpoints.of(Publisher)

    @property
    def subscriptions(self) -> Iterator[Subscription[Any]]:
        """Its subscriptions."""
        yield from self._rclpy_endpoints.of(Subscription)

    @property
    def clients(self) -> Iterator[Client[Any]]:
        """Its service clients."""
        yield from self._rclpy_endpoints.of(Client)

    @property
    def services(self) -> Iterator[Service[Any]]:
        """Its services."""
        yield from self._rclpy_endpoints.of(Service)

    @property
    def timers(self) -> Iterator[Timer]:
        """Its timers."""
        yield from self._rclpy_endpoints.of(Timer)

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """Its guard conditions."""
        yield from self._rclpy_endpoints.of(GuardCondition)

    @property
    def waitables(self) -> Iterator[Waitable]:
        """Its waitables: actions, and what programs add."""
        from .waitable import Waitable

        yield from self._rclpy_endpoints.of(Waitable)

    # Names

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a topic, remapped unless ``only_expand``."""
        return self._rclpy_endpoints.names.resolve_topic(topic, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a service, remapped unless ``only_expand``."""
        return self._rclpy_endpoints.names.resolve_service(service, only_expand=only_expand)

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
            callback_group: For event callbacks; None takes the node's default.
            event_callbacks: What to call on events of the quality of service
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
    ) -> Subscription[MsgT]:
        """Announce a subscription.

        Args:
            msg_type: Class of its messages.
            topic: Name of the topic.
            callback: Called with each message, and with a message info when it takes two arguments;
                may be ``async``.
            qos_profile: Quality of service, or a history depth.
            callback_group: None takes the node's default.
            event_callbacks: What to call on events of the quality of service
                (:class:`rclpy.event_handler.SubscriptionEventCallbacks`).
            qos_overriding_options: Which policies parameters may override.
            raw: Whether the callback gets the serialized bytes.
            content_filter_options: Without effect, as with any middleware that cannot filter;
                ``is_cft_enabled`` says so.

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
            callback_group: None takes the node's default.

        Raises:
            InvalidServiceNameException: The name breaks the rules.
        """
        return self._rclpy_endpoints.create_client(srv_type, srv_name, qos_profile, callback_group)

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
            callback_group: None takes the node's default.

        Raises:
            InvalidServiceNameException: The name breaks the rules.
        """
        return self._rclpy_endpoints.create_service(
            srv_type, srv_name, callback, qos_profile, callback_group
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
            callback: What to call; may be ``async``.
            callback_group: None takes the node's default.
            clock: None takes the node's clock.
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
        """Something whose ``trigger()`` has ``callback()`` called on the executor."""
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
        """Leave the graph and close all endpoints. Idempotent; works after a shutdown too."""
        executor = self.executor
        if executor is not None:
            executor.remove_node(self)
        self._rclpy_endpoints.destroy_all()
        self.__core.close()

    # Parameters

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter.

        Args:
            name: Its name.
            value: Default value, or a :class:`Parameter.Type <rclpy.parameter.Parameter.Type>` for
                a parameter without one.
            descriptor: Description, ranges, whether it is read-only or may change its type.
            ignore_override: Whether ``value`` goes before what the command line says.

        Returns:
            The parameter, with the override as its value if there is one.

        Raises:
            ParameterAlreadyDeclaredException: The parameter is already declared.
            InvalidParameterException: The name is not valid.
            InvalidParameterTypeException: The override has another type.
            InvalidParameterValueException: A callback or the descriptor refuses the value.
        """
        return self._parameters.declare_parameter(name, value, descriptor, ignore_override)

    def declare_parameters(
        self, namespace: str, parameters: list[Any], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare several parameters, each as ``(name[, value or type[, descriptor]])``.

        Their names follow ``namespace`` and a dot.
        """
        return self._parameters.declare_parameters(namespace, parameters, ignore_override)

    def undeclare_parameter(self, name: str) -> None:
        """Forget a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared.
            ParameterImmutableException: The parameter is read-only.
        """
        self._parameters.undeclare_parameter(name)

    def has_parameter(self, name: str) -> bool:
        """Return True if a parameter is declared."""
        return self._parameters.has_parameter(name)

    def get_parameter(self, name: str) -> Parameter:
        """Return a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters
                are not allowed.
            ParameterUninitializedException: The parameter was declared only with a type, and has no
                value yet.
        """
        return self._parameters.get_parameter(name)

    def get_parameters(self, names: list[str]) -> list[Parameter]:
        """Several parameters; raises as :meth:`get_parameter`."""
        return self._parameters.get_parameters(names)

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        """Return a parameter, or ``alternative_value`` when it is not declared or not set."""
        return self._parameters.get_parameter_or(name, alternative_value)

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, by their names without it."""
        return self._parameters.get_parameters_by_prefix(prefix)

    def get_parameter_type(self, name: str) -> Any:
        """Return the type of a parameter."""
        return self._parameters.get_parameter_type(name)

    def get_parameter_types(self, names: list[str]) -> list[Any]:
        """Return the types of several parameters."""
        return self._parameters.get_parameter_types(names)

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        """Set parameters one by one; each result says whether it was accepted, and why not."""
        return self._parameters.set_parameters(parameter_list)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set all parameters, or none."""
        return self._parameters.set_parameters_atomically(parameter_list)

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """Names of parameters below prefixes, down to ``depth`` dots (0: all)."""
        return self._parameters.list_parameters(prefixes, depth)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return the descriptor of a parameter."""
        return self._parameters.describe_parameter(name)

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Return the descriptors of parameters."""
        return self._parameters.describe_parameters(names)

    def set_descriptor(
        self, name: str, descriptor: ParameterDescriptor, alternative_value: Any = None
    ) -> Any:
        """Replace a descriptor, and the value by ``alternative_value`` if it does not fit."""
        return self._parameters.set_descriptor(name, descriptor, alternative_value)

    def add_pre_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], list[Parameter]]
    ) -> None:
        """Have ``callback`` see, and change, the list of parameters before they are checked."""
        self._parameters.callbacks.before.insert(0, callback)

    def add_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Have ``callback`` accept or refuse new values."""
        self._parameters.callbacks.deciding.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: Callable[[list[Parameter]], None]) -> None:
        """Have ``callback`` told of parameters that were set."""
        self._parameters.callbacks.after.insert(0, callback)

    def remove_pre_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], list[Parameter]]
    ) -> None:
        """Undo :meth:`add_pre_set_parameters_callback`; ValueError when it was not added."""
        self._parameters.callbacks.before.remove(callback)

    def remove_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Undo :meth:`add_on_set_parameters_callback`; ValueError when it was not added."""
        self._parameters.callbacks.deciding.remove(callback)

    def remove_post_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], None]
    ) -> None:
        """Undo :meth:`add_post_set_parameters_callback`; ValueError when it was not added."""
        self._parameters.callbacks.after.remove(callback)

    # The graph

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[tuple[str, list[str]]]:
        """Return all topics with the names of their types."""
        return self.__graph.topic_names_and_types(no_demangle)

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all services with the names of their types."""
        return self.__graph.service_names_and_types()

    def get_node_names(self) -> list[str]:
        """Base names of all nodes."""
        return [name for name, _, _ in self.__graph.node_names()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Fully qualified names of all nodes."""
        return [
            names.fully_qualified_node_name(name, namespace)
            for name, namespace, _ in self.__graph.node_names()
        ]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Name and namespace of all nodes."""
        return [(name, namespace) for name, namespace, _ in self.__graph.node_names()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Name, namespace and security enclave of all nodes."""
        return self.__graph.node_names()

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> list[tuple[str, list[str]]]:
        """Topics that a node publishes; raises ``NodeNameNonExistentError``."""
        return self.__graph.by_node("publisher", node_name, node_namespace, no_demangle=no_demangle)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> list[tuple[str, list[str]]]:
        """Topics that a node subscribes to; raises ``NodeNameNonExistentError``."""
        return self.__graph.by_node(
            "subscription", node_name, node_namespace, no_demangle=no_demangle
        )

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Services that a node offers; raises ``NodeNameNonExistentError``."""
        return self.__graph.services_by_node("service", node_name, node_namespace)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Services that a node calls; raises ``NodeNameNonExistentError``."""
        return self.__graph.services_by_node("client", node_name, node_namespace)

    def count_publishers(self, topic_name: str) -> int:
        """Return the number of a topic's publishers; raise ValueError for an invalid name."""
        return self.__graph.count_topic("publisher", topic_name)

    def count_subscribers(self, topic_name: str) -> int:
        """Return the number of subscriptions of a topic."""
        return self.__graph.count_topic("subscription", topic_name)

    def count_clients(self, service_name: str) -> int:
        """Return the number of clients of a service."""
        return self.__graph.count_service("client", service_name)

    def count_services(self, service_name: str) -> int:
        """Return the number of servers of a service."""
        return self.__graph.count_service("service", service_name)

    def get_publishers_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return information about each publisher of a topic."""
        return self.__graph.endpoint_infos("publisher", topic_name, no_mangle=no_mangle)

    def get_subscriptions_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return information about each subscription of a topic."""
        return self.__graph.endpoint_infos("subscription", topic_name, no_mangle=no_mangle)

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Block until a node is there, at most ``timeout`` seconds (negative: no limit).

        Whether it is.
        """
        return self.__graph.wait_for_node(fully_qualified_node_name, timeout)


def _usable_context(context: Context | None) -> Context:
    if context is None:
        from .utilities import get_default_context

        context = get_default_context()
    if not context.ok():
        raise NotInitializedException("cannot create node")
    return context


def _arguments(
    context: Context, cli_args: list[str] | None, *, use_global_arguments: bool
) -> Arguments:
    """Return the node's own command line before the context's."""
    from .impl.arguments import Arguments

    component = component_arguments.get()
    if component is not None:  # a component's process was started for others
        component_arguments.set(None)
        return Arguments.parse_local(component)
    own = Arguments.parse_local(cli_args or [])
    return own.followed_by(context.arguments) if use_global_arguments else own


def _names(node_name: str, namespace: str, arguments: Arguments) -> tuple[str, str]:
    """Name and namespace after remapping.

    Raises:
        InvalidNodeNameException, InvalidNamespaceException: One breaks the rules.
    """
    if not namespace.startswith("/"):
        namespace = f"/{namespace}"
    _check_names(node_name, namespace)
    name = arguments.remap_node_name(node_name)
    namespace = arguments.remap_namespace(name, namespace)
    _check_names(name, namespace)
    return name, namespace


def _check_names(name: str, namespace: str) -> None:
    fault = names.validate_namespace(namespace)
    if fault is not None:
        raise InvalidNamespaceException(namespace, fault.message, fault.invalid_index)
    fault = names.validate_node_name(name)
    if fault is not None:
        raise InvalidNodeNameException(name, fault.message, fault.invalid_index)
