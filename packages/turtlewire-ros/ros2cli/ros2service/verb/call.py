"""``ros2 service call``."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, exclusive
from ros2cli.builtin import verb_of_module
from ros2cli.completion import request_values, service_names, service_types
from ros2cli.node import NODE_NAME_PREFIX
from ros2cli.values import positive_float, read_values, shortened
from ros2service.verb import VerbExtension

if TYPE_CHECKING:
    from ros2cli.node.direct import DirectNode

__all__ = ["ARGUMENTS", "NODE_NAME_PREFIX", "CallVerb", "main", "requester"]


ARGUMENTS = (
    argument(
        "service_name", help="Name of the service, for example /spawn", completer=service_names
    ),
    argument(
        "service_type",
        help="Type of the service, for example turtlesim/srv/Spawn",
        completer=service_types,
    ),
    exclusive(
        argument(
            "values",
            nargs="?",
            default="{}",
            help="Values of the request as YAML, for example '{x: 1.0}'",
            completer=request_values,
        ),
        argument("--stdin", action="store_true", help="Read the values from stdin"),
    ),
    argument(
        "-r",
        "--rate",
        metavar="N",
        type=positive_float,
        help="Repeat the call N times per second",
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Call, and print the response."""
    from ros2cli.suggestion import field_meant
    from rosidl_runtime_py import set_message_fields

    values = read_values(sys.stdin.read() if args.stdin else args.values)
    service_class = _service_class(args.service_type)
    request = service_class.Request()
    try:
        set_message_fields(request, values)
    except Exception as error:  # noqa: BLE001  any value may be wrong in any way
        return f"Failed to populate field: {shortened(error)}{field_meant(error)}"
    from ros2cli.graph import services
    from ros2cli.node.direct import DirectNode
    from ros2cli.suggestion import say_why_to_wait
    from turtlewire.wire.services import require_callable

    with DirectNode(args) as direct:
        known = services(direct.graph)  # our own client is not among them
        client = direct.node.create_client(service_class, args.service_name)
        service = direct.node.resolve_service_name(args.service_name)
        require_callable(direct.graph, service)
        if not client.service_is_ready():
            print("waiting for service to become available...")
            if not direct.node.count_services(service):  # else the client itself tells why
                say_why_to_wait("service", service, service_class, known)
            if not direct.wait_for_server(service, client.service_is_ready):
                raise KeyboardInterrupt
        while True:
            _call(direct, client, request)
            if args.rate is None:
                return None
            direct.pause(1.0 / args.rate)


def _service_class(name: str) -> Any:
    from rclpy.type_support import check_is_valid_srv_type
    from ros2cli.suggestion import interface_meant
    from rosidl_runtime_py.utilities import get_interface, get_service

    try:
        return get_service(name)
    except (AttributeError, ModuleNotFoundError, ValueError):
        with suppress(AttributeError, ModuleNotFoundError, ValueError):
            check_is_valid_srv_type(get_interface(name))
        meant = interface_meant(name, "srv")
        raise RuntimeError(f"The passed service type is invalid{meant}") from None


def _call(direct: DirectNode, client: Any, request: Any) -> None:
    print(f"requester: making request: {request!r}\n")
    server = f"service '{client.srv_name}'"
    response = direct.answer(client.call_async(request), server, client.service_is_ready)
    print(f"response:\n{response!r}\n")


def requester(service_type: str, service_name: str, values: str, period: float | None) -> Any:
    """Call a service, and print the response.

    Args:
        service_type: Its type, for example ``turtlesim/srv/Spawn``.
        service_name: Its name.
        values: Values of the request as YAML.
        period: Seconds between calls; None calls once.

    Returns:
        The text of an error, or None.
    """
    rate = None if period is None else 1.0 / period
    return main(
        argparse.Namespace(
            service_type=service_type,
            service_name=service_name,
            values=values,
            stdin=False,
            rate=rate,
        )
    )


@verb_of_module
class CallVerb(VerbExtension):
    """Call a service."""
