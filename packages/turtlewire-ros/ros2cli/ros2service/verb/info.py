"""``ros2 service info``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument
from ros2cli.completion import service_names
from ros2cli.discovery import STRATEGY_ARGUMENTS, discovered_graph
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2service.verb import VerbExtension

ARGUMENTS = (
    *STRATEGY_ARGUMENTS,
    argument(
        "service_name", help="Name of the service, for example /spawn", completer=service_names
    ),
    argument(
        "-v", "--verbose", action="store_true", help="Show each client and server: node, QoS, gids"
    ),
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> str | None:
    """Print type and counts; in detail each client and server."""
    from rclpy.endpoint_info import EndpointTypeEnum, service_infos
    from ros2cli.graph import services
    from ros2cli.json_lines import service_endpoint_data
    from ros2cli.suggestion import did_you_mean

    with discovered_graph(args.spin_time) as graph:
        known = dict(services(graph, hidden=True))
        if args.service_name not in known:
            return f"Unknown service '{args.service_name}'{did_you_mean(args.service_name, known)}"
        types = known[args.service_name]
        clients = service_infos(graph, args.service_name, EndpointTypeEnum.CLIENT)
        servers = service_infos(graph, args.service_name, EndpointTypeEnum.SERVER)
    if args.json:
        data: dict[str, Any] = {"service": args.service_name, "types": types}
        data |= {"client_count": len(clients), "server_count": len(servers)}
        if args.verbose:
            data["clients"] = [service_endpoint_data(info) for info in clients]
            data["servers"] = [service_endpoint_data(info) for info in servers]
        print_json(data)
        return None
    print(f"Type: {types[0] if len(types) == 1 else types}")
    for title, infos in (("Clients", clients), ("Services", servers)):
        print(f"{title} count: {len(infos)}")
        if args.verbose:
            for info in infos:
                print(f"{info}\n")
    return None


class InfoVerb(VerbExtension, module=__name__):
    """Show how many offer and may call a service."""
