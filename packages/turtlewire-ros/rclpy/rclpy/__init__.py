"""ROS 2's client library for Python.

::

    import rclpy
    from rclpy.node import Node

    with rclpy.init():
        rclpy.spin(Node("talker"))

The modules load when they are first used: ``rclpy.time``, ``rclpy.qos`` and all others are
attributes of the package after ``import rclpy``.

==========================================  ========================================================
module                                      contents
==========================================  ========================================================
`node`                                      `Node`; its parts are in `_node`
`executors`                                 `Executor`; its parts are in `_execution`
`_node`, `_execution`, `_qos`               private parts of nodes, executors and QoS
`context`, `utilities`                      `Context`; the default context, `ok`, `try_shutdown`
`publisher`, `subscription`                 endpoints of topics
`client`, `service`                         endpoints of services
`timer`, `guard_condition`                  timers; wake-ups by hand
`waitable`, `destroyable`                   entities that programs define
`action`, `lifecycle`                       action clients and servers; lifecycle nodes
`callback_groups`, `task`                   which callbacks may run together; futures and coroutines
`clock`, `clock_type`, `time`, `duration`   clocks, times and durations
`time_source`                               ``use_sim_time``: ROS time from ``/clock``
`parameter`                                 values of parameters, and their YAML files
`parameter_client`                          parameters of another node
`parameter_service`                         the services of a node's parameters
`parameter_event_handler`                   callbacks for changed parameters
`qos`                                       `QoSProfile`, its policies and presets; parts in `_qos`
`qos_overriding_options`                    QoS set by parameters
`event_handler`                             events: incompatible QoS, deadlines, matches
`qos_event`                                 the former name of `event_handler`
`endpoint_info`, `type_hash`                information about an endpoint in the graph
`topic_endpoint_info`                       the same, under Jazzy's names
`logging`                                   loggers
`impl`                                      outputs and formats of logs; ROS arguments; hints
`logging_service`                           the services of a node's log levels
`service_introspection`                     events of requests and responses
`type_description_service`                  the service ``~/get_type_description``
`signals`                                   Ctrl-C and SIGTERM
`exceptions`                                rclpy's errors
`serialization`, `type_support`             messages as bytes; checks of types
`wait_for_message`                          `wait_for_message`
`subscription_content_filter_options`       filters by content
`expand_topic_name`                         full names of topics
`topic_or_service_is_hidden`                names with a leading underscore
`validate_topic_name`                       checks of topic names
`validate_full_topic_name`                  checks of full topic names
`validate_namespace`, `validate_node_name`  checks of names of nodes
`validate_parameter_name`                   checks of names of parameters
`constants`, `experimental`                 further names and modules of ROS 2
`_typing`                                   type variables of `Publisher`, `Client` and others
`_rclpy_pybind11`                           the few names of ROS 2's extension that programs use
==========================================  ========================================================
"""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

# First, so that an early Ctrl-C also ends without a traceback.
from .impl import excepthooks as _excepthooks  # noqa: F401
from .signals import SignalHandlerOptions, install_signal_handlers, uninstall_signal_handlers
from .utilities import get_default_context, get_rmw_implementation_identifier, ok
from .utilities import shutdown as _shutdown
from .utilities import try_shutdown as _try_shutdown

if TYPE_CHECKING:
    from .context import Context
    from .executors import Executor
    from .node import Node
    from .parameter import Parameter
    from .qos import QoSProfile, qos_profile_rosout_default
    from .task import Future

__all__ = [
    "Context",
    "Future",
    "InitContextManager",
    "Parameter",
    "QoSProfile",
    "SignalHandlerOptions",
    "create_node",
    "get_default_context",
    "get_global_executor",
    "get_rmw_implementation_identifier",
    "init",
    "install_signal_handlers",
    "ok",
    "qos_profile_rosout_default",
    "shutdown",
    "spin",
    "spin_once",
    "spin_until_future_complete",
    "try_shutdown",
    "uninstall_signal_handlers",
]

_global_executor: Executor | None = None


class InitContextManager:
    """The context manager that :func:`init` returns.

    ``with rclpy.init(): …`` shuts the context down at the end of the block.
    """

    def __init__(
        self,
        args: list[str] | None,
        context: Context | None,
        domain_id: int | None,
        signal_handler_options: SignalHandlerOptions | None,
    ) -> None:
        is_default = context is None or context is get_default_context()
        self.context = get_default_context() if context is None else context
        # As in ROS 2, a library with its own context leaves the signals to the program.
        if signal_handler_options is None:
            signal_handler_options = (
                SignalHandlerOptions.ALL if is_default else SignalHandlerOptions.NO
            )
        self.context.init(args, domain_id=domain_id)
        # Last: if the domain cannot be joined, the program keeps its own handlers.
        install_signal_handlers(signal_handler_options)

    def __enter__(self) -> Context:
        return self.context

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        # The signal handlers serve every context: only the default one takes them along.
        if self.context is get_default_context():
            try_shutdown()
            uninstall_signal_handlers()
        else:
            self.context.try_shutdown()


def init(
    *,
    args: list[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: SignalHandlerOptions | None = None,
) -> InitContextManager:
    """Join a domain; everything else needs this first.

    Args:
        args: Command line whose ``--ros-args`` apply; None uses ``sys.argv``.
        context: What to initialize; None uses the default context.
        domain_id: None uses ``ROS_DOMAIN_ID``, else 0.
        signal_handler_options: Which signals shut down; None: both for the default context, none
            for others.

    Returns:
        A context manager that shuts down at its end; it can be ignored.

    Raises:
        RuntimeError: The context was initialized before.
        UnknownROSArgsError, RCLInvalidROSArgsError: The command line is wrong.
        WireError: The middleware is not available, or the domain cannot be joined.
    """
    return InitContextManager(args, context, domain_id, signal_handler_options)


def get_global_executor() -> Executor:
    """Return the default executor.

    It lives until the default context is shut down.
    """
    global _global_executor  # noqa: PLW0603 - there is one for the process
    executor = _global_executor
    if executor is None:
        from .executors import SingleThreadedExecutor

        executor = _global_executor = SingleThreadedExecutor()
        get_default_context().on_shutdown(_forget_global_executor)
    return executor


def _forget_global_executor() -> None:
    global _global_executor
    executor, _global_executor = _global_executor, None
    if executor is not None and not executor.context.ended_by_signal:
        executor.shutdown(timeout_sec=0)


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Leave the domain.

    Args:
        context: None uses the default context.
        uninstall_handlers: Whether signals get their former handlers back; None: when the default
            context is shut down.

    Raises:
        RuntimeError: The context was never initialized, or was already shut down by a call (after a
            signal, one call is fine).
    """
    is_default = context is None or context is get_default_context()
    _shutdown(context=context)
    if uninstall_handlers or (uninstall_handlers is None and is_default):
        uninstall_signal_handlers()


def try_shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Leave the domain unless that has happened; see :func:`shutdown`.

    Only with ``uninstall_handlers`` signals get their former handlers back.
    """
    _try_shutdown(context=context)
    if uninstall_handlers:
        uninstall_signal_handlers()


def create_node(
    node_name: str,
    *,
    context: Context | None = None,
    cli_args: list[str] | None = None,
    namespace: str | None = None,
    use_global_arguments: bool = True,
    enable_rosout: bool = True,
    rosout_qos_profile: QoSProfile | int | None = None,
    start_parameter_services: bool = True,
    parameter_overrides: list[Parameter] | None = None,
    allow_undeclared_parameters: bool = False,
    automatically_declare_parameters_from_overrides: bool = False,
    enable_logger_service: bool = False,
) -> Node:
    """Make a node; see :class:`rclpy.node.Node` for the arguments.

    ``rosout_qos_profile`` None uses ROS 2's default.
    """
    from .node import Node
    from .qos import qos_profile_rosout_default

    return Node(
        node_name,
        context=context,
        cli_args=cli_args,
        namespace=namespace,
        use_global_arguments=use_global_arguments,
        enable_rosout=enable_rosout,
        rosout_qos_profile=qos_profile_rosout_default
        if rosout_qos_profile is None
        else rosout_qos_profile,
        start_parameter_services=start_parameter_services,
        parameter_overrides=parameter_overrides,
        allow_undeclared_parameters=allow_undeclared_parameters,
        automatically_declare_parameters_from_overrides=automatically_declare_parameters_from_overrides,
        enable_logger_service=enable_logger_service,
    )


def spin_once(
    node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Wait for one callback of ``node`` and run it.

    Args:
        node: The node to spin; if it has no executor, it is in this one during the call.
        executor: None uses the global one.
        timeout_sec: How long to wait; None or negative: without limit, 0: not at all.
    """
    executor = get_global_executor() if executor is None else executor
    # False for a node that is in the executor already: it stays there afterwards.
    added = executor.add_node(node)
    try:
        executor.spin_once(timeout_sec=timeout_sec)
    finally:
        if added:
            executor.remove_node(node)


def spin(node: Node, executor: Executor | None = None) -> None:
    """Run the callbacks of ``node`` until its context is shut down.

    Args:
        node: The node to spin; if it has no executor, it is in this one during the call.
        executor: None uses the global one.

    Raises:
        KeyboardInterrupt: Ctrl-C, in the main thread.
        ExternalShutdownException: SIGTERM, or another thread shut the context of a given executor
            down.
        Exception: A callback raised it.
    """
    executor = get_global_executor() if executor is None else executor
    added = executor.add_node(node)
    try:
        executor.spin()
    finally:
        if added:
            executor.remove_node(node)


def spin_until_future_complete(
    node: Node, future: Future, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Run the callbacks of ``node`` until ``future`` is done or the timeout has passed.

    It also ends when the context is shut down.

    Args:
        node: The node to spin; if it has no executor, it is in this one during the call.
        future: The future to wait for.
        executor: None uses the global one.
        timeout_sec: None or negative: without limit.
    """
    executor = get_global_executor() if executor is None else executor
    added = executor.add_node(node)
    try:
        executor.spin_until_future_complete(future, timeout_sec)
    finally:
        if added:
            executor.remove_node(node)


#: Names that ROS 2's package has because it imports them; programs use ``rclpy.Parameter`` and the
#: like.
_ALSO_HERE = {
    "Context": "context",
    "Future": "task",
    "Parameter": "parameter",
    "QoSProfile": "qos",
    "qos_profile_rosout_default": "qos",
}


def __getattr__(name: str) -> ModuleType | Any:
    """Load a module of the package at its first use as an attribute."""
    import importlib
    import importlib.util

    if name in _ALSO_HERE:
        return getattr(importlib.import_module(f"{__name__}.{_ALSO_HERE[name]}"), name)
    # Tools probe for names such as `__path__` and `__wrapped__`. A module is searched first instead
    # of catching ImportError: an import that fails within an existing module has to show.
    if name.startswith("__") or importlib.util.find_spec(f"{__name__}.{name}") is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return importlib.import_module(f"{__name__}.{name}")
