"""The common base of all nodes: names, a clock, a logger, parameters, and a view of the graph."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

from rclpy._node.endpoints import OwnEndpoints
from rclpy._node.graph import NodeGraph, actions_among
from rclpy._node.parameters import NodeParameters
from rclpy._node.state import NodeState
from rclpy._node.views import NodeHandle
from rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    NotInitializedException,
)
from rclpy.impl.hints import with_hint
from rclpy.parameter_service import ParameterService
from rclpy.qos import (
    QoSProfile,
    qos_profile_parameter_events,
    qos_profile_rosout_default,
    qos_profile_services_default,
)
from rclpy.time_source import TimeSource
from rclpy.type_description_service import TypeDescriptionService
from turtlewire.wire import names

if TYPE_CHECKING:
    from rcl_interfaces.msg import ListParametersResult, ParameterDescriptor, SetParametersResult
    from rclpy.clock import BaseClock
    from rclpy.context import Context
    from rclpy.endpoint_info import ServiceEndpointInfo, TopicEndpointInfo
    from rclpy.impl.arguments import Arguments
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.parameter import Parameter
    from rclpy.publisher import BasePublisher, Publisher
    from rclpy.service import BaseService
    from rclpy.subscription import BaseSubscription
    from turtlewire.wire import base
    from turtlewire.wire.qos import QoS

#: Command line for the next node of this thread, whose class need not know that it is loaded as a
#: component.
component_arguments: ContextVar[list[str] | None] = ContextVar("component_arguments", default=None)


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


def _rosout_qos(profile: QoSProfile | int) -> QoS:
    return (QoSProfile(depth=profile) if isinstance(profile, int) else profile).to_wire()


class BaseNode:
    """The common base of :class:`rclpy.node.Node` and :class:`rclpy.experimental.AsyncNode`.

    :class:`rclpy.node.Node` describes the arguments. A derived class makes the clock.
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
        rosout_qos_profile: QoSProfile | int = qos_profile_rosout_default,
        start_parameter_services: bool = True,
        parameter_overrides: list[Parameter] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        self._context = _usable_context(context)
        arguments = _arguments(self._context, cli_args, use_global_arguments=use_global_arguments)
        name, namespace = _names(node_name, namespace or "/", arguments)
        self._rclpy_core = core = NodeState(
            self._context,
            name,
            namespace,
            arguments,
            rosout_qos=_rosout_qos(rosout_qos_profile) if enable_rosout else None,
        )
        self._logger = core.logger
        self._clock = clock = self._rclpy_make_clock()
        self._rclpy_endpoints = OwnEndpoints(core)
        self._rclpy_graph = NodeGraph(core)
        self._parameters = NodeParameters(
            node_fqn=core.full_name,
            overrides=arguments.parameter_overrides(core.full_name),
            constructor_overrides=parameter_overrides,
            allow_undeclared=allow_undeclared_parameters,
            now=clock.now,
            publish_event=self.__parameter_event_publisher().publish,
        )
        # Before the time source and the services, which declare only parameters that are missing.
        if automatically_declare_parameters_from_overrides:
            self._parameters.declare_overrides()
        owner: Any = self  # derived classes create the services and the subscription to `/clock`
        self._time_source = TimeSource(node=owner)
        self._time_source.attach_clock(clock)
        if start_parameter_services:
            self._parameter_service = ParameterService(owner)
        self._type_description_service = TypeDescriptionService(owner)
        if enable_logger_service:
            from rclpy.logging_service import LoggingService

            self.__logging_service = LoggingService(owner)
        self._rclpy_end_with_context()

    def __parameter_event_publisher(self) -> Publisher[Any]:
        from rcl_interfaces.msg import ParameterEvent

        return self._rclpy_endpoints.create_publisher(
            ParameterEvent, "/parameter_events", qos_profile_parameter_events
        )

    # What it is

    def get_name(self) -> str:
        """Return the base name, after remapping; raise InvalidHandle if it is destroyed."""
        return self._rclpy_core.checked().name

    def get_namespace(self) -> str:
        """Return the namespace, after remapping; raise InvalidHandle if it is destroyed."""
        return self._rclpy_core.checked().namespace

    def get_fully_qualified_name(self) -> str:
        """Return namespace and name, for example ``/robot1/camera``, as `get_name` does."""
        return self._rclpy_core.checked().full_name

    def get_logger(self) -> RcutilsLogger:
        """Return its logger, named like the node with dots for slashes."""
        return self._logger

    @property
    def context(self) -> Context:
        """The context of the node."""
        return self._context

    @property
    def _rclpy_wire(self) -> base.Node:
        """The middleware's side of it; raises ``InvalidHandle`` after :meth:`destroy_node`."""
        return self._rclpy_core.wire

    @property
    def handle(self) -> NodeHandle:
        """Stands for the C object that it has in ROS 2.

        Raises ``InvalidHandle`` after :meth:`destroy_node`.
        """
        return NodeHandle(self._rclpy_wire, self._rclpy_endpoints)

    # Names

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a topic, remapped unless ``only_expand``."""
        return self._rclpy_endpoints.names.resolve_topic(topic, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a service, remapped unless ``only_expand``."""
        return self._rclpy_endpoints.names.resolve_service(service, only_expand=only_expand)

    # Implemented by each kind of node

    def _rclpy_end_with_context(self) -> None:
        """Destroy the node when its context ends."""
        raise NotImplementedError

    def _rclpy_make_clock(self) -> BaseClock:
        """Return a new clock of ROS time."""
        raise NotImplementedError

    def get_clock(self) -> BaseClock:
        """Return its clock."""
        raise NotImplementedError

    def create_publisher(
        self, msg_type: Any, topic: str, qos_profile: QoSProfile | int
    ) -> BasePublisher[Any]:
        """Announce a publisher."""
        raise NotImplementedError

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Any, qos_profile: QoSProfile | int
    ) -> BaseSubscription[Any]:
        """Announce a subscription."""
        raise NotImplementedError

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Any,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
    ) -> BaseService[Any]:
        """Offer a service."""
        raise NotImplementedError

    def destroy_node(self) -> None:
        """Leave the graph and close all endpoints."""
        raise NotImplementedError

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
            InvalidParameterValueException: A callback or the descriptor rejects the value.
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
        """Return several parameters; raises as :meth:`get_parameter`."""
        return self._parameters.get_parameters(names)

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        """Return a parameter, or ``alternative_value`` when it is not declared or not set."""
        return self._parameters.get_parameter_or(name, alternative_value)

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, by their names without it."""
        return self._parameters.get_parameters_by_prefix(prefix)

    def get_parameter_type(self, name: str) -> Any:
        """Return the number of a parameter's type; raise `ParameterNotDeclaredException`."""
        return self._parameters.get_parameter_type(name)

    def get_parameter_types(self, names: list[str]) -> list[Any]:
        """Return the types of several parameters, as :meth:`get_parameter_type` does."""
        return self._parameters.get_parameter_types(names)

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        """Set parameters one by one; each result says whether it was accepted, and why not.

        Raises:
            ParameterNotDeclaredException: A parameter is not declared, and undeclared parameters
                are not allowed; the preceding parameters are set.
        """
        return self._parameters.set_parameters(parameter_list)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set all parameters, or none; raise `ParameterNotDeclaredException` for unknown ones."""
        return self._parameters.set_parameters_atomically(parameter_list)

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """Return the names of parameters below prefixes, down to ``depth`` dots (0: all)."""
        return self._parameters.list_parameters(prefixes, depth)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return a parameter's descriptor with its present type, empty if it is undeclared.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters
                are not allowed.
        """
        return self._parameters.describe_parameter(name)

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Return several descriptors; raises as :meth:`describe_parameter`."""
        return self._parameters.describe_parameters(names)

    def set_descriptor(
        self, name: str, descriptor: ParameterDescriptor, alternative_value: Any = None
    ) -> Any:
        """Replace a descriptor, and the value by ``alternative_value`` if it does not fit.

        Returns:
            The value that the parameter has now.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters
                are not allowed.
            ParameterImmutableException: The parameter is read-only.
            InvalidParameterValueException: Neither value agrees with the descriptor.
        """
        return self._parameters.set_descriptor(name, descriptor, alternative_value)

    def add_pre_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], list[Parameter]]
    ) -> None:
        """Let ``callback`` see and change the list of parameters before they are checked."""
        # As in ROS 2, the newest callback comes first.
        self._parameters.callbacks.before.insert(0, callback)

    def add_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Let ``callback`` accept or reject new values."""
        self._parameters.callbacks.deciding.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: Callable[[list[Parameter]], None]) -> None:
        """Call ``callback`` with parameters that were set."""
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
        return self._rclpy_graph.topic_names_and_types(no_demangle)

    def get_action_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all actions with the names of their types."""
        return actions_among(self.get_topic_names_and_types())

    def get_action_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the actions of which a node is a client; raise `NodeNameNonExistentError`."""
        return actions_among(self.get_subscriber_names_and_types_by_node(node_name, node_namespace))

    def get_action_server_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the actions that a node offers; raise `NodeNameNonExistentError`."""
        return actions_among(self.get_publisher_names_and_types_by_node(node_name, node_namespace))

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all services with the names of their types."""
        return self._rclpy_graph.service_names_and_types()

    def get_node_names(self) -> list[str]:
        """Return the base names of all nodes."""
        return [name for name, _, _ in self._rclpy_graph.node_names()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the fully qualified names of all nodes."""
        return [
            names.fully_qualified_node_name(name, namespace)
            for name, namespace, _ in self._rclpy_graph.node_names()
        ]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return name and namespace of all nodes."""
        return [(name, namespace) for name, namespace, _ in self._rclpy_graph.node_names()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return name, namespace and security enclave of all nodes."""
        return self._rclpy_graph.node_names()

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> list[tuple[str, list[str]]]:
        """Return the topics that a node publishes; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.by_node(
            "publisher", node_name, node_namespace, no_demangle=no_demangle
        )

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> list[tuple[str, list[str]]]:
        """Return the topics that a node subscribes to; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.by_node(
            "subscription", node_name, node_namespace, no_demangle=no_demangle
        )

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the services that a node offers; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.services_by_node("service", node_name, node_namespace)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the services that a node calls; raises ``NodeNameNonExistentError``."""
        return self._rclpy_graph.services_by_node("client", node_name, node_namespace)

    def count_publishers(self, topic_name: str) -> int:
        """Return the number of a topic's publishers; raise ValueError for an invalid name."""
        return self._rclpy_graph.count_topic("publisher", topic_name)

    def count_subscribers(self, topic_name: str) -> int:
        """Return the number of subscriptions of a topic."""
        return self._rclpy_graph.count_topic("subscription", topic_name)

    def count_clients(self, service_name: str) -> int:
        """Return the number of clients of a service."""
        return self._rclpy_graph.count_service("client", service_name)

    def count_services(self, service_name: str) -> int:
        """Return the number of servers of a service."""
        return self._rclpy_graph.count_service("service", service_name)

    def get_publishers_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return information about each publisher of a topic."""
        return self._rclpy_graph.endpoint_infos("publisher", topic_name, no_mangle=no_mangle)

    def get_subscriptions_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return information about each subscription of a topic."""
        return self._rclpy_graph.endpoint_infos("subscription", topic_name, no_mangle=no_mangle)

    def get_clients_info_by_service(
        self, service_name: str, no_mangle: bool = False
    ) -> list[ServiceEndpointInfo]:
        """Return information about each client of a service.

        Raises:
            ValueError: The name breaks the rules.
            RCLError: ``no_mangle`` is True.
        """
        from rclpy.endpoint_info import EndpointTypeEnum

        kind = EndpointTypeEnum.CLIENT
        return self._rclpy_graph.service_infos(kind, service_name, no_mangle=no_mangle)

    def get_servers_info_by_service(
        self, service_name: str, no_mangle: bool = False
    ) -> list[ServiceEndpointInfo]:
        """Return information about each server of a service.

        Raises:
            ValueError: The name breaks the rules.
            RCLError: ``no_mangle`` is True.
        """
        from rclpy.endpoint_info import EndpointTypeEnum

        kind = EndpointTypeEnum.SERVER
        return self._rclpy_graph.service_infos(kind, service_name, no_mangle=no_mangle)


def _usable_context(context: Context | None) -> Context:
    if context is None:
        from rclpy.utilities import get_default_context

        context = get_default_context()
    if not context.ok():
        raise NotInitializedException("cannot create node")
    return context


def _arguments(
    context: Context, cli_args: list[str] | None, *, use_global_arguments: bool
) -> Arguments:
    """Return the node's own command line before the context's."""
    from rclpy.impl.arguments import Arguments

    component = component_arguments.get()
    if component is not None:  # a component does not use the container's command line
        # Once, because a component may create further nodes.
        component_arguments.set(None)
        return Arguments.parse_local(component)
    own = Arguments.parse_local(cli_args or [])
    return own.followed_by(context.arguments) if use_global_arguments else own


def _names(node_name: str, namespace: str, arguments: Arguments) -> tuple[str, str]:
    """Return name and namespace after remapping.

    Raises:
        InvalidNodeNameException, InvalidNamespaceException: A name breaks the rules.
    """
    if not namespace.startswith("/"):
        namespace = f"/{namespace}"
    # As in ROS 2, an invalid name is rejected even if a rule would replace it.
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
