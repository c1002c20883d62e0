"""The common base of all nodes: names, a clock, a logger, and what each kind of node defines."""

from __future__ import annotations

from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

from rclpy._node.endpoints import OwnEndpoints
from rclpy._node.graph import NodeGraph
from rclpy._node.graph_methods import GraphMethods
from rclpy._node.parameter_methods import ParameterMethods
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
    from rclpy.clock import BaseClock
    from rclpy.context import Context
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


class BaseNode(ParameterMethods, GraphMethods):
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
