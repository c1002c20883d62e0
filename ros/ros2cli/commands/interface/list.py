"""``ros2 interface list``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument

if TYPE_CHECKING:
    import argparse

__all__ = ["ARGUMENTS", "main"]

_KINDS = (("msg", "Messages"), ("srv", "Services"), ("action", "Actions"))


ARGUMENTS = (
    argument("-m", "--only-msgs", action="store_true", help="Only messages"),
    argument("-s", "--only-srvs", action="store_true", help="Only services"),
    argument("-a", "--only-actions", action="store_true", help="Only actions"),
)


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
