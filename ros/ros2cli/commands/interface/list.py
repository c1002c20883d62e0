"""``ros2 interface list``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]

_KINDS = (("msg", "Messages"), ("srv", "Services"), ("action", "Actions"))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    parser.add_argument("-m", "--only-msgs", action="store_true", help="Only messages")
    parser.add_argument("-s", "--only-srvs", action="store_true", help="Only services")
    parser.add_argument("-a", "--only-actions", action="store_true", help="Only actions")


def main(args: argparse.Namespace) -> None:
    """Print the names below a headline for each kind."""
    from turtlewire import msg

    wanted = {"msg": args.only_msgs, "srv": args.only_srvs, "action": args.only_actions}
    packages = sorted(msg.interface_names().items())
    for kind, title in _KINDS:
        if wanted[kind] or not any(wanted.values()):
            print(f"{title}:")
            for package, names in packages:
                for name in sorted(names[kind]):
                    print(f"    {package}/{kind}/{name}")
