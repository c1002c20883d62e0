"""``ros2 interface packages``."""

from __future__ import annotations

import argparse
from collections.abc import Iterable

from ros2cli.arguments import argument
from ros2interface.verb import VerbExtension

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
    found = sorted(msg.interfaces().items())
    print_packages(package for package, names in found if any(names[kind] for kind in kinds))


def print_packages(packs: Iterable[str]) -> None:
    """Print names, one on each line."""
    for name in packs:
        print(name)


class PackagesVerb(VerbExtension, module=__name__):
    """List the packages that have interfaces."""
