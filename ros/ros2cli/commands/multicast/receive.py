"""``ros2 multicast receive``."""

from __future__ import annotations

import socket
from typing import TYPE_CHECKING

from ros2cli.commands.multicast import add_group_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    add_group_arguments(parser)


def main(args: argparse.Namespace) -> None:
    """Print the first datagram that arrives."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as receiver:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind(("", args.port))
        every_interface = socket.inet_aton("0.0.0.0")  # noqa: S104  multicast comes from the network
        receiver.setsockopt(
            socket.IPPROTO_IP,
            socket.IP_ADD_MEMBERSHIP,
            socket.inet_aton(args.group) + every_interface,
        )
        print("Waiting for UDP multicast datagram...")
        data, (host, port) = receiver.recvfrom(4096)
    print(f"Received from {host}:{port}: '{data.decode('utf-8', 'backslashreplace')}'")
