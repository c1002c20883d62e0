"""Parameters of other nodes, completions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.node.direct import DirectNode

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from rclpy.parameter_client import AsyncParameterClient

__all__ = [
    "ParameterNameCompleter",
    "call_describe_parameters",
    "call_get_parameters",
    "call_list_parameters",
    "call_set_parameters",
    "get_parameter_type_string",
    "get_value",
    "load_parameter_file",
]

_TIMEOUT_S = 5.0


def call_get_parameters(*, node: Any, node_name: str, parameter_names: Sequence[str]) -> Any:
    """Get values: a response of ``rcl_interfaces/srv/GetParameters``.

    Raises:
        RuntimeError: The node has no parameter services, or would misread requests.
    """
    client = _client(node, node_name)
    return DirectNode.around(node).result(client.get_parameters(list(parameter_names)))


def call_set_parameters(*, node: Any, node_name: str, parameters: Sequence[Any]) -> Any:
    """Set values: a response of ``rcl_interfaces/srv/SetParameters``.

    Raises:
        RuntimeError: The node has no parameter services, or would misread requests.
    """
    client = _client(node, node_name)
    return DirectNode.around(node).result(client.set_parameters(list(parameters)))


def call_list_parameters(
    *, node: Any, node_name: str, prefixes: Sequence[str] | None = None
) -> Any:
    """List names: a response of ``rcl_interfaces/srv/ListParameters``.

    Returns:
        The response; None if the node has no parameter services.
    """
    try:
        client = _client(node, node_name)
    except RuntimeError:
        return None
    found = client.list_parameters(prefixes=None if prefixes is None else list(prefixes))
    return DirectNode.around(node).result(found)


def call_describe_parameters(
    *, node: Any, node_name: str, parameter_names: Sequence[str] | None = None
) -> Any:
    """Get descriptors: a response of ``rcl_interfaces/srv/DescribeParameters``.

    Raises:
        RuntimeError: The node has no parameter services, or would misread requests.
    """
    client = _client(node, node_name)
    return DirectNode.around(node).result(client.describe_parameters(list(parameter_names or ())))


def load_parameter_file(
    *, node: Any, node_name: str, parameter_file: str, use_wildcard: bool
) -> None:
    """Set what a file says of a node, and print the results.

    Args:
        node: The node that asks.
        node_name: Full name of the other node.
        parameter_file: Path of the YAML file.
        use_wildcard: Whether what the file says of all nodes (``/**``) counts.

    Raises:
        RuntimeError: The node has no parameter services or would misread requests, or the file is
            wrong.
    """
    from rclpy.parameter import parameter_dict_from_yaml_file
    from ros2cli.output import print_set_results

    parameters = list(parameter_dict_from_yaml_file(parameter_file, use_wildcard).values())
    answer = call_set_parameters(node=node, node_name=node_name, parameters=parameters)
    print_set_results(parameters, answer.results)


def get_value(*, parameter_value: Any) -> Any:
    """Return the Python value of ``rcl_interfaces/msg/ParameterValue``; None if it is not set."""
    from rclpy.parameter import parameter_value_to_python

    return parameter_value_to_python(parameter_value)


def get_parameter_type_string(parameter_type: int) -> str:
    """Name of a number of ``rcl_interfaces/msg/ParameterType``, for example ``double array``."""
    from ros2param.parameters import TYPE_NAMES

    return TYPE_NAMES[parameter_type]


class ParameterNameCompleter:
    """Offers names of the parameters of the node on the command line to the shell."""

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Names of the parameters there are now."""
        with DirectNode(parsed_args) as node:
            found = call_list_parameters(node=node, node_name=parsed_args.node_name)
        return [] if found is None else sorted(found.result.names)


def _client(node: Any, node_name: str) -> AsyncParameterClient:
    from rclpy.parameter_client import AsyncParameterClient

    direct = DirectNode.around(node)
    client = AsyncParameterClient(direct.node, node_name)
    service = direct.node.resolve_service_name(f"{node_name}/list_parameters")
    if not direct.wait_for_server(service, client.services_are_ready, _TIMEOUT_S):
        raise RuntimeError("Wait for service timed out")
    return client
