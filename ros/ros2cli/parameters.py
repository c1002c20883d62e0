"""Talking to the parameter services of a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.completion import node_names, parameter_names
from ros2cli.discovery import add_strategy_arguments

if TYPE_CHECKING:
    import argparse

    from ros2cli.direct_node import DirectNode

__all__ = [
    "TYPE_NAMES",
    "RemoteParameters",
    "add_name_argument",
    "add_node_arguments",
    "full_node_name",
]

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

_TIMEOUT_S = 5.0


def add_node_arguments(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """Define what all verbs share."""
    add_strategy_arguments(parser)
    node = parser.add_argument(
        "node_name",
        nargs="?" if optional else None,
        help="Full name of the node, for example /turtlesim",
    )
    node.completer = node_names  # type: ignore[attr-defined]
    parser.add_argument(
        "--include-hidden-nodes",
        action="store_true",
        help="Also nodes whose name begins with an underscore",
    )
    parser.add_argument(
        "--timeout",
        metavar="N",
        type=float,
        default=_TIMEOUT_S,
        help="Wait at most N seconds for the node's answer",
    )


def add_name_argument(parser: argparse.ArgumentParser) -> None:
    """Define the name of one parameter."""
    name = parser.add_argument("parameter_name", help="Name of the parameter")
    name.completer = parameter_names  # type: ignore[attr-defined]


def full_node_name(name: str) -> str:
    """The name with a slash in front."""
    return name if name.startswith("/") else f"/{name}"


class RemoteParameters:
    """The parameters of one node.

    Args:
        direct: The node that asks.
        args: The command line.
        node_name: Full name of the node that is asked; by default that of the command line.

    Raises:
        RuntimeError: There is no such node.
    """

    def __init__(
        self, direct: DirectNode, args: argparse.Namespace, node_name: str | None = None
    ) -> None:
        from rclpy.parameter_client import AsyncParameterClient
        from ros2cli.graph import node_exists

        name = full_node_name(args.node_name) if node_name is None else node_name
        if not node_exists(direct.graph, name):
            from ros2cli.graph import node_names as known
            from ros2cli.suggestion import did_you_mean

            raise RuntimeError(f"Node not found{did_you_mean(name, known(direct.graph))}")
        self.node_name = name
        self._direct = direct
        self._timeout: float = args.timeout
        self._client = AsyncParameterClient(direct.node, name)

    def _ask(self, method: str, *args: Any) -> Any:
        if not self._client.wait_for_services(self._timeout):
            raise RuntimeError(
                f"Wait for service timed out: the node '{self.node_name}' has no parameter services"
            )
        try:
            return self._direct.result(getattr(self._client, method)(*args), self._timeout)
        except TimeoutError as error:
            raise RuntimeError(
                f"The node '{self.node_name}' did not answer within {self._timeout} s"
            ) from error

    def meant(self, name: str) -> str:
        """A line with the nearest parameters, to be put behind a message; empty when there is one of this name, or none is near."""
        from ros2cli.suggestion import did_you_mean

        known = self.names([])
        return "" if name in known else did_you_mean(name, known)

    def names(self, prefixes: list[str]) -> list[str]:
        """Names of all parameters below the prefixes, sorted."""
        return sorted(self._ask("list_parameters", prefixes).result.names)

    def types(self, names: list[str]) -> list[int]:
        """Numbers of the types."""
        return list(self._ask("get_parameter_types", names).types)

    def values(self, names: list[str]) -> list[Any]:
        """``rcl_interfaces/msg/ParameterValue`` messages."""
        return list(self._ask("get_parameters", names).values)

    def descriptors(self, names: list[str]) -> list[Any]:
        """``rcl_interfaces/msg/ParameterDescriptor`` messages."""
        return list(self._ask("describe_parameters", names).descriptors)

    def set(self, parameters: list[Any]) -> list[Any]:
        """Set ``rcl_interfaces/msg/Parameter`` messages; the results."""
        return list(self._ask("set_parameters", parameters).results)

    def delete(self, names: list[str]) -> list[Any]:
        """Delete parameters; the results."""
        return list(self._ask("delete_parameters", names).results)
