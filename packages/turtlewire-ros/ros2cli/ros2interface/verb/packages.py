"""``ros2 interface packages``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]


ARGUMENTS = (
    argument("-m", "--only-msgs", action="store_true", help="Only packages with messages"),
    argument("-s", "--only-srvs", action="store_true", help="Only packages with services"),
    argument("-a", "--only-actions", action="store_true", help="Only packages with actions"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    from turtlewire import msg

    wanted = {"msg": args.only_msgs, "srv": args.only_srvs, "action": args.only_actions}
    kinds = [kind for kind in wanted if wanted[kind]] or list(wanted)
    for package, names in sorted(msg.interface_names().items()):
        if any(names[kind] for kind in kinds):
            print(package)
