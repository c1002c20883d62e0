"""The parameters of other nodes: the options of verbs, and calls to the services of nodes."""

from __future__ import annotations

import argparse
import time
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import Argument, argument
from ros2cli.completion import node_names
from ros2cli.discovery import STRATEGY_ARGUMENTS
from ros2cli.listing import HIDDEN_NODES
from ros2cli.output import tell, tell_failed_call

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode

_TIMEOUT_S = 5.0
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


def node_arguments(*, nargs: str | None = None) -> tuple[Argument, ...]:
    """Return the arguments that all verbs of ``ros2 param`` have."""
    return (
        *STRATEGY_ARGUMENTS,
        argument(
            "node_name",
            nargs=nargs,
            help="Full name of the node, for example /turtlesim",
            completer=node_names,
        ),
        argument(
            "--include-hidden-nodes",
            action="store_true",
            help=HIDDEN_NODES,
        ),
        argument(
            "--timeout",
            "--service-timeout",
            metavar="N",
            type=float,
            default=_TIMEOUT_S,
            help="Wait at most N seconds for the node's answer",
        ),
    )


def parameter_names(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the names of the parameters of the node on the command line."""
    from ros2cli.node.direct import DirectNode

    with DirectNode(parsed_args) as direct:
        return RemoteParameters(direct, parsed_args).names()


NAME_ARGUMENT = argument("parameter_name", help="Name of the parameter", completer=parameter_names)


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


def ask_all(
    direct: DirectNode,
    fields: Mapping[str, Mapping[str, Any]],
    service: str,
    timeout: float,
    *,
    raises: bool = False,
) -> tuple[dict[str, Any], set[str]]:
    """Call a service of all nodes, and print which failed.

    Args:
        direct: The node that asks.
        fields: The fields of the requests, by the names of the nodes that are asked.
        service: Name of the service, for example ``list_parameters``.
        timeout: Seconds to wait for the services, and again for their answers.
        raises: Whether a failure is raised instead of printed.

    Returns:
        The answers, and the nodes that could not be asked or did not answer. A node without the
        service is in neither.

    Raises:
        RuntimeError: A call failed, and ``raises`` is true.
    """
    serving = _serving(direct, fields, service, timeout)
    questions: dict[str, ParameterCall] = {
        name: ParameterCall(direct, name, service, timeout, **request)
        for name, request in fields.items()
        if name in serving
    }
    answers: dict[str, Any] = {}
    failed: set[str] = set()
    # All requests first, so that the nodes answer at the same time.
    for step in ("send", "answer"):
        for name, question in list(questions.items()):
            try:
                answers[name] = getattr(question, step)()
            except RuntimeError as error:  # noqa: PERF203  each node may fail on its own
                if raises:
                    raise
                failed.add(name)
                del questions[name]
                answers.pop(name, None)
                if isinstance(error.__cause__, TimeoutError):
                    tell(str(error))
                else:
                    tell_failed_call(name, error, service)
    return answers, failed


def _serving(direct: DirectNode, nodes: Collection[str], service: str, timeout: float) -> set[str]:
    """Return the nodes that have a service."""
    from ros2cli.graph import services

    def found() -> set[str]:
        known = {name for name, _ in services(direct.graph, hidden=True)}
        return {name for name in nodes if f"{name}/{service}" in known}

    # As in ROS 2, nodes without it are waited for: a node that has just started may be known before
    # its services are.
    direct.graph.wait_for(lambda: len(found()) == len(nodes), int(timeout * 1e9))
    return found()
