"""``ros2 interface packages``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    parser.add_argument(
        "-m", "--only-msgs", action="store_true", help="Only packages with messages"
    )
    parser.add_argument(
        "-s", "--only-srvs", action="store_true", help="Only packages with services"
    )
    parser.add_argument(
        "-a", "--only-actions", action="store_true", help="Only packages with actions"
    )


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    from turtlewire import msg

    wanted = {"msg": args.only_msgs, "srv": args.only_srvs, "action": args.only_actions}
    kinds = [kind for kind in wanted if wanted[kind]] or list(wanted)
    for package, names in sorted(msg.interface_names().items()):
        if any(names[kind] for kind in kinds):
            print(package)
