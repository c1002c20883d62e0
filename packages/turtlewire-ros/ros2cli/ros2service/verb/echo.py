"""``ros2 service echo``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.completion import service_names, service_types
from ros2cli.message_text import DEFAULT_TRUNCATE_LENGTH, TEXT_ARGUMENTS, event_text
from ros2cli.qos import QOS_ARGUMENTS, with_options
from ros2service.verb import VerbExtension

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

__all__ = ["ARGUMENTS", "DEFAULT_TRUNCATE_LENGTH", "EchoVerb", "main"]

ARGUMENTS = (
    argument(
        "service_name", help="Name of the service, for example /spawn", completer=service_names
    ),
    argument(
        "service_type",
        nargs="?",
        help="Type of the service (default: the type of the existing service)",
        completer=service_types,
    ),
    *QOS_ARGUMENTS,
    *TEXT_ARGUMENTS,
)


def main(args: argparse.Namespace) -> str | None:
    """Print the events until Ctrl-C."""
    from ros2cli.node.direct import DirectNode

    if args.service_type is not None:
        # A wrong type is rejected before anything is started.
        _service_class(args.service_type, f"The service type '{args.service_type}' is invalid")
    with DirectNode(args) as direct:
        service = direct.node.resolve_service_name(args.service_name)
        kind = args.service_type or _type_of_service(direct.graph, service)
        if kind is None:
            return "Could not load the type for the passed service"
        srv_type = _service_class(kind, f"The service name '{args.service_name}' is invalid")
        topic = f"{service}/_service_event"
        qos = with_options(args, "services_default")
        subscription = direct.node.create_subscription(
            srv_type.Event, topic, lambda event: print(event_text(event, args)), qos
        )
        if subscription.get_publisher_count() < 1:
            print(
                f"No publishers on topic '{topic}'; "
                "is service introspection on the client or server enabled?"
            )
        direct.spin()
    return None


def _service_class(name: str, refusal: str) -> Any:
    from rosidl_runtime_py.utilities import get_service

    try:
        return get_service(name)
    except (AttributeError, ModuleNotFoundError, ValueError):
        from ros2cli.suggestion import source_meant

        raise RuntimeError(f"{refusal}{source_meant(name)}") from None


def _type_of_service(graph: Graph, service: str) -> str | None:
    from ros2cli.graph import services

    types = dict(services(graph, hidden=True)).get(service, [])
    if len(types) > 1:
        raise RuntimeError(
            f"Cannot echo service '{service}', as it contains more than one type: "
            f"[{', '.join(types)}]"
        )
    return types[0] if types else None


class EchoVerb(VerbExtension, module=__name__):
    """Print the requests and responses of a service that has introspection on."""
