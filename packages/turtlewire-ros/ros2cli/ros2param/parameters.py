"""Calls to the parameter services of a node."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

    from ros2cli.node.direct import DirectNode

__all__ = ["TYPE_NAMES", "ParameterCall", "RemoteParameters", "timed_out"]

#: By the numbers of ``rcl_interfaces/msg/ParameterType``.
TYPE_NAMES = {
    0: "not set",
    1: "boolean",
    2: "integer",
    3: "double",
    4: "string",
    5: "byte array",
    6: "boolean array",
    7: "integer array",
    8: "double array",
    9: "string array",
}


class ParameterCall:
    """A call of one of a node's parameter services.

    The client is made at once and :meth:`send` waits for its service, so that the services of
    many nodes are discovered side by side.

    Args:
        direct: The node that asks.
        node_name: Full name of the node that is asked.
        service: Name of the service, for example ``list_parameters``.
        timeout: Seconds to wait for the service, and again for its answer.
        **fields: The fields of the request.
    """

    def __init__(
        self, direct: DirectNode, node_name: str, service: str, timeout: float, **fields: Any
    ) -> None:
        from rcl_interfaces import srv

        service_class = getattr(srv, service.title().replace("_", ""))
        self._node_name = node_name
        self._service = service
        self._direct = direct
        self._timeout = timeout
        self._request = service_class.Request(**fields)
        self._client = direct.node.create_client(service_class, f"{node_name}/{service}")
        self._answer: Any = None
        self._deadline = 0.0

    def send(self) -> ParameterCall:
        """Send the request as soon as the service is available.

        Raises:
            RuntimeError: The node does not appear, or would misread the request.
        """
        ready = self._client.service_is_ready
        if not self._direct.wait_for_server(self._client.service_name, ready, self._timeout):
            raise RuntimeError(
                f"Wait for service timed out: the node '{self._node_name}' has no"
                " parameter services"
            )
        self._answer = self._client.call_async(self._request)
        self._deadline = time.monotonic() + self._timeout
        return self

    def answer(self) -> Any:
        """Wait for the response.

        Raises:
            RuntimeError: The node does not answer, or it has left.
        """
        server, rest = f"service '{self._client.srv_name}'", self._deadline - time.monotonic()
        try:
            return self._direct.answer(
                self._answer, server, self._client.service_is_ready, max(rest, 0.0)
            )
        except TimeoutError as error:
            raise timed_out(self._service, self._node_name, self._timeout) from error
        finally:
            self._direct.node.destroy_client(self._client)


def timed_out(service: str, node_name: str, timeout: float | None) -> RuntimeError:
    """Return ROS 2's error for a node that did not answer in time."""
    return RuntimeError(
        f"Timed out waiting for {service} response from node {node_name} (timeout: {timeout}s)"
    )


class RemoteParameters:
    """The parameters of one node.

    Args:
        direct: The node that asks.
        args: The command line.

    Raises:
        RuntimeError: The node does not exist.
    """

    def __init__(self, direct: DirectNode, args: argparse.Namespace) -> None:
        from ros2cli.graph import require_node

        self.node_name = require_node(direct.graph, args.node_name)
        self._direct = direct
        self._timeout: float = args.timeout

    def _ask(self, service: str, **fields: Any) -> Any:
        return (
            ParameterCall(self._direct, self.node_name, service, self._timeout, **fields)
            .send()
            .answer()
        )

    def meant(self, name: str) -> str:
        """Return a line with similar parameters; empty if the name exists or no name is similar."""
        from ros2cli.suggestion import did_you_mean

        known = self.names()
        return "" if name in known else did_you_mean(name, known)

    def names(self) -> list[str]:
        """Return the names of all parameters, sorted."""
        return sorted(self._ask("list_parameters").result.names)

    def values(self, names: list[str]) -> list[Any]:
        """Return ``rcl_interfaces/msg/ParameterValue`` messages."""
        return list(self._ask("get_parameters", names=names).values)

    def descriptors(self, names: list[str]) -> list[Any]:
        """Return ``rcl_interfaces/msg/ParameterDescriptor`` messages."""
        return list(self._ask("describe_parameters", names=names).descriptors)

    def set(self, parameters: list[Any]) -> list[Any]:
        """Set ``rcl_interfaces/msg/Parameter`` messages; return the results."""
        return list(self._ask("set_parameters", parameters=parameters).results)

    def set_atomically(self, parameters: list[Any]) -> Any:
        """Set all ``rcl_interfaces/msg/Parameter`` messages or none; return the result."""
        return self._ask("set_parameters_atomically", parameters=parameters).result

    def delete(self, names: list[str]) -> list[Any]:
        """Delete parameters, by values without a type; return the results."""
        from rcl_interfaces.msg import Parameter

        return self.set([Parameter(name=name) for name in names])
