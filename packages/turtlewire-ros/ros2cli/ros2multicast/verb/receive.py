"""``ros2 multicast receive``."""

from __future__ import annotations

import argparse

from ros2multicast.api import GROUP_ARGUMENTS, MulticastSocket
from ros2multicast.verb import VerbExtension

ARGUMENTS = (*GROUP_ARGUMENTS,)


def main(args: argparse.Namespace) -> None:
    """Print the first datagram that arrives."""
    with MulticastSocket(args.group, args.port) as group:
        print("Waiting for UDP multicast datagram...")
        data, (host, port) = group.receive()
    print(f"Received from {host}:{port}: '{data.decode('utf-8', 'backslashreplace')}'")


class ReceiveVerb(VerbExtension, module=__name__):
    """Wait for one datagram."""
