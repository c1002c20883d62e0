"""``ros2 multicast``."""

from __future__ import annotations

import ipaddress
from argparse import ArgumentTypeError
from typing import TYPE_CHECKING

from ros2cli.values import unsigned_int

if TYPE_CHECKING:
    import argparse

__all__ = ["VERBS", "add_group_arguments"]

VERBS = {
    "receive": "Wait for one datagram",
    "send": "Send one datagram",
}


def add_group_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the options that sender and receiver have to agree on."""
    parser.add_argument(
        "--group", type=_group, default="225.0.0.1", help="Multicast group (default: 225.0.0.1)"
    )
    parser.add_argument("--port", type=_port, default=49150, help="UDP port (default: 49150)")


def _group(text: str) -> str:
    try:
        is_group = ipaddress.IPv4Address(text).is_multicast
    except ValueError:
        is_group = False
    if not is_group:
        raise ArgumentTypeError(
            f"'{text}' is no IPv4 multicast group; those are 224.0.0.0 to 239.255.255.255"
        )
    return text


def _port(text: str) -> int:
    port = unsigned_int(text)
    if not 0 < port < 1 << 16:
        raise ArgumentTypeError(f"'{text}' is no UDP port; those are 1 to 65535")
    return port
