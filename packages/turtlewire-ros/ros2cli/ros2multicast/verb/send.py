"""``ros2 multicast send``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument, unsigned_int
from ros2multicast.api import GROUP_ARGUMENTS, MulticastSocket
from ros2multicast.verb import VerbExtension

ARGUMENTS = (
    *GROUP_ARGUMENTS,
    argument(
        "--ttl", type=unsigned_int, help="Maximum number of routers that the datagram may pass"
    ),
)


def main(args: argparse.Namespace) -> None:
    """Send a greeting to the group."""
    print("Sending one UDP multicast datagram...")
    with MulticastSocket(args.group, args.port, args.ttl) as group:
        group.send(b"Hello World!")


class SendVerb(VerbExtension, module=__name__):
    """Send one datagram."""
