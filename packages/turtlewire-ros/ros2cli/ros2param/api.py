"""Parameters of other nodes, completions."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.node.direct import DirectNode

if TYPE_CHECKING:
    from rclpy.parameter_client import AsyncParameterClient

# ROS 2's time.
_TIMEOUT_S = 5.0


def call_get_parameters(
    *, node: Any, node_name: str, parameter_names: Sequence[str], timeout: float | None = None
) -> Any:
    """Get values; returns a response of ``rcl_interfaces/srv/GetParameters``.

    This function and those below take the time to wait for the answer, in seconds; None waits
    without a limit.

    Raises:
        RuntimeError: The node has no parameter services, would misread requests, or did not answer
            in time.
    """
    client = _client(node, node_name)
    future = client.get_parameters(list(parameter_names))
    return _answer(node, future, "get_parameters", node_name, timeout)


def call_set_parameters(
    *, node: Any, node_name: str, parameters: Sequence[Any], timeout: float | None = None
) -> Any:
    """Set values; returns a response of ``rcl_interfaces/srv/SetParameters``.

    Raises:
        RuntimeError: As in `call_get_parameters`.
    """
    client = _client(node, node_name)
    future = client.set_parameters(list(parameters))
    return _answer(node, future, "set_parameters", node_name, timeout)


def call_set_parameters_atomically(
    *, node: Any, node_name: str, parameters: Sequence[Any], timeout: float | None = None
) -> Any:
    """Set all values or none; returns a response of ``rcl_interfaces/srv/SetParametersAtomically``.

    Raises:
        RuntimeError: As in `call_get_parameters`.
    """
    client = _client(node, node_name)
    future = client.set_parameters_atomically(list(parameters))
    return _answer(node, future, "set_parameters_atomically", node_name, timeout)


def call_list_parameters(
    *,
    node: Any,
    node_name: str,
    prefixes: Sequence[str] | None = None,
    timeout: float | None = None,
) -> Any:
    """List names; returns a response of ``rcl_interfaces/srv/ListParameters``.

    Returns:
        The response; None if the node has no parameter services.

    Raises:
        RuntimeError: The node did not answer in time.
    """
    try:
        client = _client(node, node_name)
    except RuntimeError:
        return None
    future = client.list_parameters(prefixes=None if prefixes is None else list(prefixes))
    return _answer(node, future, "list_parameters", node_name, timeout)


def call_describe_parameters(
    *,
    node: Any,
    node_name: str,
    parameter_names: Sequence[str] | None = None,
    timeout: float | None = None,
) -> Any:
    """Get descriptors; returns a response of ``rcl_interfaces/srv/DescribeParameters``.

    Raises:
        RuntimeError: As in `call_get_parameters`.
    """
    client = _client(node, node_name)
    future = client.describe_parameters(list(parameter_names or ()))
    return _answer(node, future, "describe_parameters", node_name, timeout)


def load_parameter_file(
    *,
    node: Any,
    node_name: str,
    parameter_file: str,
    use_wildcard: bool,
    timeout: float | None = None,
) -> None:
    """Set what a file says of a node, and print the results.

    Args:
        node: The node that asks.
        node_name: Full name of the other node.
        parameter_file: Path of the YAML file.
        use_wildcard: Whether what the file says of all nodes (``/**``) counts.
        timeout: Seconds to wait for the answer; None waits without a limit.

    Raises:
        RuntimeError: As in `call_get_parameters`, or the file is wrong.
    """
    from rclpy.parameter import parameter_dict_from_yaml_file
    from ros2cli.output import print_set_results

    parameters = list(parameter_dict_from_yaml_file(parameter_file, use_wildcard).values())
    answer = call_set_parameters(
        node=node, node_name=node_name, parameters=parameters, timeout=timeout
    )
    print_set_results(parameters, answer.results)


def get_value(*, parameter_value: Any) -> Any:
    """Return the Python value of ``rcl_interfaces/msg/ParameterValue``; None if it is not set."""
    from rclpy.parameter import parameter_value_to_python

    return parameter_value_to_python(parameter_value)


def get_parameter_value(string_value: str) -> Any:
    """Return the ``rcl_interfaces/msg/ParameterValue`` of a value in YAML."""
    from rclpy import parameter

    return parameter.get_parameter_value(string_value)


def get_parameter_type_string(parameter_type: int) -> str:
    """Return the name of a number of ``ParameterType``, for example ``double array``."""
    from ros2param.parameters import TYPE_NAMES

    return TYPE_NAMES[parameter_type]


class ParameterNameCompleter:
    """Offers names of the parameters of the node on the command line to the shell."""

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the names of the parameters there are now."""
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


def _answer(node: Any, future: Any, service: str, node_name: str, timeout: float | None) -> Any:
    from ros2param.parameters import timed_out

    try:
        return DirectNode.around(node).result(future, timeout)
    except TimeoutError as error:
        raise timed_out(service, node_name, timeout) from error
