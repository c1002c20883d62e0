"""``ros2 multicast send``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.multicast import MulticastSocket, add_group_arguments
from ros2cli.values import unsigned_int

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_group_arguments(parser)
    parser.add_argument("--ttl", type=unsigned_int, help="How many routers the datagram may pass")


def main(args: argparse.Namespace) -> None:
    """Send a greeting to the group."""
    print("Sending one UDP multicast datagram...")
    with MulticastSocket(args.group, args.port, args.ttl) as group:
        group.send(b"Hello World!")
