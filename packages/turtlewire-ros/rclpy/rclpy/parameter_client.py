"""Reads and sets the parameters of another node."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from .parameter import Parameter, parameter_dict_from_yaml_file
from .qos import QoSProfile, qos_profile_parameter_events, qos_profile_services_default

if TYPE_CHECKING:
    import rcl_interfaces.msg

    from .callback_groups import CallbackGroup
    from .client import Client
    from .event_handler import SubscriptionEventCallbacks
    from .node import Node
    from .qos_overriding_options import QoSOverridingOptions
    from .subscription import Subscription
    from .task import Future


class AsyncParameterClient:
    """Asks the parameter services of ``remote_node_name``.

    Each method returns a future of the service's response.

    Args:
        node: The node that asks; an executor has to spin it.
        remote_node_name: Name of the other node, relative to the namespace of ``node`` unless it
            starts with a slash.
        qos_profile: Of the service clients.
        callback_group: Of the service clients.
    """

    def __init__(
        self,
        node: Node,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        from rcl_interfaces import srv

        self.remote_node_name = remote_node_name
        self.node = node

        def client(service_type: Any, name: str) -> Client:
            service = f"{remote_node_name}/{name}"
            return node.create_client(
                service_type, service, qos_profile=qos_profile, callback_group=callback_group
            )

        self._get_parameter_client = client(srv.GetParameters, "get_parameters")
        self._list_parameter_client = client(srv.ListParameters, "list_parameters")
        self._set_parameter_client = client(srv.SetParameters, "set_parameters")
        self._get_parameter_types_client = client(srv.GetParameterTypes, "get_parameter_types")
        self._describe_parameters_client = client(srv.DescribeParameters, "describe_parameters")
        self._set_parameters_atomically_client = client(
            srv.SetParametersAtomically, "set_parameters_atomically"
        )

    def _clients(self) -> tuple[Client, ...]:
        return (
            self._list_parameter_client,
            self._set_parameter_client,
            self._get_parameter_client,
            self._get_parameter_types_client,
            self._describe_parameters_client,
            self._set_parameters_atomically_client,
        )

    def services_are_ready(self) -> bool:
        """Return True if all services of the other node are available."""
        return all(client.service_is_ready() for client in self._clients())

    def wait_for_services(self, timeout_sec: float | None = None) -> bool:
        """Wait until all services of the other node are available.

        Args:
            timeout_sec: For all of them together; None waits forever.
        """
        deadline = None if timeout_sec is None else time.monotonic() + timeout_sec
        return all(
            client.wait_for_service(
                None if deadline is None else max(0.0, deadline - time.monotonic())
            )
            for client in self._clients()
        )

    def list_parameters(
        self,
        prefixes: list[str] | None = None,
        depth: int | None = None,
        callback: Callable[[Future], None] | None = None,
    ) -> Future:
        """List parameters.

        Args:
            prefixes: Beginnings of names; all parameters if None.
            depth: How many levels below a prefix; None and 0 mean all.
            callback: Called with the future when it is done, as in the other methods.
        """
        from rcl_interfaces.srv import ListParameters

        return _ask(
            self._list_parameter_client,
            ListParameters.Request(prefixes=prefixes or [], depth=depth or 0),
            callback,
        )

    def get_parameters(
        self, names: list[str], callback: Callable[[Future], None] | None = None
    ) -> Future:
        """Get values."""
        from rcl_interfaces.srv import GetParameters

        return _ask(self._get_parameter_client, GetParameters.Request(names=names), callback)

    def set_parameters(
        self,
        parameters: Sequence[Parameter | rcl_interfaces.msg.Parameter],
        callback: Callable[[Future], None] | None = None,
    ) -> Future:
        """Set values, one after the other."""
        from rcl_interfaces.srv import SetParameters

        return _ask(
            self._set_parameter_client,
            SetParameters.Request(parameters=_messages(parameters)),
            callback,
        )

    def describe_parameters(
        self, names: list[str], callback: Callable[[Future], None] | None = None
    ) -> Future:
        """Get descriptors."""
        from rcl_interfaces.srv import DescribeParameters

        return _ask(
            self._describe_parameters_client, DescribeParameters.Request(names=names), callback
        )

    def get_parameter_types(
        self, names: list[str], callback: Callable[[Future], None] | None = None
    ) -> Future:
        """Get types."""
        from rcl_interfaces.srv import GetParameterTypes

        return _ask(
            self._get_parameter_types_client, GetParameterTypes.Request(names=names), callback
        )

    def set_parameters_atomically(
        self,
        parameters: Sequence[Parameter | rcl_interfaces.msg.Parameter],
        callback: Callable[[Future], None] | None = None,
    ) -> Future:
        """Set all values or none."""
        from rcl_interfaces.srv import SetParametersAtomically

        request = SetParametersAtomically.Request(parameters=_messages(parameters))
        return _ask(self._set_parameters_atomically_client, request, callback)

    def delete_parameters(
        self, names: list[str], callback: Callable[[Future], None] | None = None
    ) -> Future:
        """Undeclare parameters, which is possible if their types may change."""
        # A parameter that is set to NOT_SET is undeclared.
        return self.set_parameters([Parameter(name) for name in names], callback)

    def load_parameter_file(
        self,
        parameter_file: str,
        use_wildcard: bool = False,
        callback: Callable[[Future], None] | None = None,
    ) -> Future:
        """Set the parameters of a YAML file, one value after the other.

        See :func:`rclpy.parameter.parameter_dict_from_yaml_file`.
        """
        return self.set_parameters(
            list(parameter_dict_from_yaml_file(parameter_file, use_wildcard).values()), callback
        )

    def load_parameter_file_atomically(
        self,
        parameter_file: str,
        use_wildcard: bool = False,
        callback: Callable[[Future], None] | None = None,
    ) -> Future:
        """Set all of what a YAML file says or nothing."""
        return self.set_parameters_atomically(
            list(parameter_dict_from_yaml_file(parameter_file, use_wildcard).values()), callback
        )

    def on_parameter_event(
        self,
        callback: Callable[[rcl_interfaces.msg.ParameterEvent], None],
        qos_profile: QoSProfile | int = qos_profile_parameter_events,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription[rcl_interfaces.msg.ParameterEvent]:
        """Call ``callback`` with the parameter events of all nodes.

        Arguments and return value are as in :meth:`rclpy.node.Node.create_subscription`. Events of
        nodes other than ``remote_node_name`` are included.
        """
        from rcl_interfaces.msg import ParameterEvent

        return self.node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            callback,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )


def _ask(client: Client, request: Any, callback: Callable[[Future], None] | None) -> Future:
    future = client.call_async(request)
    if callback is not None:
        future.add_done_callback(callback)
    return future


def _messages(parameters: Sequence[Any]) -> list[rcl_interfaces.msg.Parameter]:
    return [
        parameter.to_parameter_msg() if isinstance(parameter, Parameter) else parameter
        for parameter in parameters
    ]
