"""``ros2 multicast send``."""

from __future__ import annotations

import socket
from typing import TYPE_CHECKING

from ros2cli.commands.multicast import add_group_arguments
from ros2cli.values import unsigned_int

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_group_arguments(parser)
    parser.add_argument(
        "--ttl", type=unsigned_int, help="Over how many routers the datagram may pass"
    )


def main(args: argparse.Namespace) -> None:
    """Send a greeting to the group."""
    print("Sending one UDP multicast datagram...")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as sender:
        if args.ttl is not None:
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, args.ttl)
        sender.sendto(b"Hello World!", (args.group, args.port))
