"""The services through which other nodes read and set a node's parameters."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

from .exceptions import ParameterNotDeclaredException, ParameterUninitializedException
from .parameter import Parameter
from .qos import qos_profile_parameters
from .validate_topic_name import TOPIC_SEPARATOR_STRING

if TYPE_CHECKING:
    import rcl_interfaces.msg
    from rcl_interfaces.msg import SetParametersResult

    from ._node.views import ParameterOwner

__all__ = ["TOPIC_SEPARATOR_STRING", "ParameterService"]


class ParameterService:
    """Serves the parameters of ``node``, which it does not keep alive."""

    def __init__(self, node: ParameterOwner) -> None:
        from rcl_interfaces import srv

        self._node_weak_ref = weakref.ref(node)
        for service_type, name, callback in (
            (srv.DescribeParameters, "describe_parameters", self._describe_parameters),
            (srv.GetParameters, "get_parameters", self._get_parameters),
            (srv.GetParameterTypes, "get_parameter_types", self._get_parameter_types),
            (srv.ListParameters, "list_parameters", self._list_parameters),
            (srv.SetParameters, "set_parameters", self._set_parameters),
            (
                srv.SetParametersAtomically,
                "set_parameters_atomically",
                self._set_parameters_atomically,
            ),
        ):
            node.create_service(
                service_type,
                TOPIC_SEPARATOR_STRING.join((node.get_name(), name)),
                callback,
                qos_profile=qos_profile_parameters,
            )

    def _node(self) -> ParameterOwner:
        node = self._node_weak_ref()
        if node is None:
            raise ReferenceError("Expected valid node weak reference")
        return node

    def _describe_parameters(self, request: Any, response: Any) -> Any:
        node = self._node()
        try:
            response.descriptors = [node.describe_parameter(name) for name in request.names]
        except ParameterNotDeclaredException:
            response.descriptors = []  # ROS 2 gives no descriptor at all when one is missing
        return response

    def _get_parameters(self, request: Any, response: Any) -> Any:
        node = self._node()
        try:
            response.values = [
                node.get_parameter(name).get_parameter_value() for name in request.names
            ]
        except (ParameterNotDeclaredException, ParameterUninitializedException):
            response.values = []  # ROS 2 gives no value at all when one is missing
        return response

    def _get_parameter_types(self, request: Any, response: Any) -> Any:
        node = self._node()
        try:
            response.types = [node.get_parameter_type(name) for name in request.names]
        except ParameterNotDeclaredException:
            response.types = []
        return response

    def _list_parameters(self, request: Any, response: Any) -> Any:
        response.result = self._node().list_parameters(list(request.prefixes), int(request.depth))
        return response

    def _set_parameters(self, request: Any, response: Any) -> Any:
        response.results = [self._set([message]) for message in request.parameters]
        return response

    def _set_parameters_atomically(self, request: Any, response: Any) -> Any:
        response.result = self._set(request.parameters)
        return response

    def _set(self, messages: list[rcl_interfaces.msg.Parameter]) -> SetParametersResult:
        from rcl_interfaces.msg import SetParametersResult

        try:
            return self._node().set_parameters_atomically(
                [Parameter.from_parameter_msg(message) for message in messages]
            )
        except (ParameterNotDeclaredException, ValueError) as error:
            return SetParametersResult(successful=False, reason=str(error))
