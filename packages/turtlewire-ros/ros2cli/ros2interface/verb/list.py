"""``ros2 interface list``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2interface.verb import VerbExtension

TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}


ARGUMENTS = (
    argument("-m", "--only-msgs", action="store_true", help="Only messages"),
    argument("-s", "--only-srvs", action="store_true", help="Only services"),
    argument("-a", "--only-actions", action="store_true", help="Only actions"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names below a headline for each kind."""
    wanted = {"msg": args.only_msgs, "srv": args.only_srvs, "action": args.only_actions}
    for kind in TITLES:
        if wanted[kind] or not any(wanted.values()):
            print_kind(kind)


def print_kind(kind: str) -> None:
    """Print the names of the messages (``msg``), services (``srv``) or actions (``action``)."""
    from turtlewire import msg

    print(f"{TITLES[kind]}:")
    for package, names in sorted(msg.interfaces().items()):
        for name in sorted(names[kind]):
            print(f"    {package}/{kind}/{name}")


def print_messages() -> None:
    """Print the names of all messages."""
    print_kind("msg")


def print_services() -> None:
    """Print the names of all services."""
    print_kind("srv")


def print_actions() -> None:
    """Print the names of all actions."""
    print_kind("action")


class ListVerb(VerbExtension, module=__name__):
    """List all interfaces."""
