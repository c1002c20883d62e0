"""``ros2 service call``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, exclusive, positive_float, read_values, shortened
from ros2cli.completion import request_values, service_names, service_types
from ros2cli.json_lines import JSON_ARGUMENT, print_json, remark_printer
from ros2cli.node import NODE_NAME_PREFIX
from ros2cli.qos import QOS_ARGUMENTS, asked_for, with_options
from ros2service.verb import VerbExtension

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
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
    argument(
        "--timeout",
        metavar="N",
        type=positive_float,
        help="Wait at most N seconds for each response; the wait for the service has no limit",
    ),
    *QOS_ARGUMENTS,
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> str | None:
    """Call, and print the response."""
    return requester(
        args.service_type,
        args.service_name,
        sys.stdin.read() if args.stdin else args.values,
        None if args.rate is None else 1.0 / args.rate,
        with_options(args, "services_default") if asked_for(args) else None,
        args.timeout,
        as_json=args.json,
    )


def requester(
    service_type: str,
    service_name: str,
    values: str,
    period: float | None,
    qos_profile: QoSProfile | None = None,
    timeout: float | None = None,
    *,
    as_json: bool = False,
) -> str | None:
    """Call a service, and print the response.

    Args:
        service_type: Its type, for example ``turtlesim/srv/Spawn``.
        service_name: Its name.
        values: Values of the request as YAML. The value ``now`` of a stamp, and ``auto`` of a
            header, stand for the time of each call.
        period: Seconds between calls; None calls once.
        qos_profile: QoS of the client; by default that of services.
        timeout: Seconds to wait for each response; None waits while the service exists.
        as_json: Print request and response of each call as a JSON object in one line.

    Returns:
        The text of an error, or None.

    Raises:
        RuntimeError: The type is wrong, or no response came in time.
    """
    from ros2cli.suggestion import field_meant
    from rosidl_runtime_py import set_message_fields

    fields = read_values(values)
    service_class = _service_class(service_type)
    request = service_class.Request()
    try:
        stamps = set_message_fields(request, fields, expand_header_auto=True, expand_time_now=True)
    except Exception as error:  # noqa: BLE001  any value may be wrong in any way
        return f"Failed to populate field: {shortened(error)}{field_meant(error)}"
    from ros2cli.node.direct import DirectNode

    with DirectNode(None) as direct:
        remark = remark_printer(as_json=as_json)
        client = _client(direct, service_class, service_name, qos_profile, remark)
        while True:
            now = direct.node.get_clock().now().to_msg()
            for stamp in stamps:
                stamp.sec, stamp.nanosec = now.sec, now.nanosec
            _call(direct, client, request, timeout, as_json=as_json)
            if period is None:
                return None
            direct.pause(period)


def _client(
    direct: DirectNode,
    service_class: Any,
    service_name: str,
    qos: QoSProfile | None,
    remark: Callable[[str], None],
) -> Any:
    """Return a client whose service is available; ``remark`` prints that it waits."""
    from rclpy.qos import qos_profile_services_default
    from ros2cli.graph import services
    from ros2cli.suggestion import say_why_to_wait
    from turtlewire.wire.services import require_callable

    known = services(direct.graph)  # our own client is not among them
    profile = qos or qos_profile_services_default
    client = direct.node.create_client(service_class, service_name, qos_profile=profile)
    service = direct.node.resolve_service_name(service_name)
    require_callable(direct.graph, service)
    if not client.service_is_ready():
        remark("waiting for service to become available...")
        if not direct.node.count_services(service):  # otherwise the client says why
            say_why_to_wait("service", service, service_class, known)
        if not direct.wait_for_server(service, client.service_is_ready):
            raise KeyboardInterrupt
    return client


def _service_class(name: str) -> Any:
    from rclpy.type_support import check_is_valid_srv_type
    from ros2cli.suggestion import interface_meant
    from rosidl_runtime_py.utilities import get_interface, get_service

    try:
        return get_service(name)
    except (AttributeError, ModuleNotFoundError, ValueError):
        # A message or action has ROS 2's error for that; other names have ours.
        with suppress(AttributeError, ModuleNotFoundError, ValueError):
            check_is_valid_srv_type(get_interface(name))
        meant = interface_meant(name, "srv")
        raise RuntimeError(f"The passed service type is invalid{meant}") from None


def _call(
    direct: DirectNode, client: Any, request: Any, timeout: float | None, *, as_json: bool
) -> None:
    if not as_json:
        print(f"requester: making request: {request!r}\n")
    server, future = f"service '{client.srv_name}'", client.call_async(request)
    try:
        response = direct.answer(future, server, client.service_is_ready, timeout)
    except TimeoutError:
        raise RuntimeError(
            f"Timed out waiting for response from service {client.srv_name} (timeout: {timeout}s)"
        ) from None
    if as_json:
        print_json({"service": client.service_name, "request": request, "response": response})
    else:
        print(f"response:\n{response!r}\n")


class CallVerb(VerbExtension, module=__name__):
    """Call a service."""
