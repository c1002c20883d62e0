"""``ros2 interface package``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.completion import interface_packages
from ros2interface.verb import VerbExtension

ARGUMENTS = (
    argument("package_name", help="Name of the package", completer=interface_packages),
    argument("-m", "--only-msgs", action="store_true", help="Only messages"),
    argument("-s", "--only-srvs", action="store_true", help="Only services"),
    argument("-a", "--only-actions", action="store_true", help="Only actions"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the full names."""
    from ros2cli.suggestion import did_you_mean, source_meant
    from turtlewire import msg

    packages = msg.interfaces()
    if args.package_name not in packages:
        name = args.package_name
        return f"Unknown package '{name}'{source_meant(name) or did_you_mean(name, packages)}"
    wanted = {"msg": args.only_msgs, "srv": args.only_srvs, "action": args.only_actions}
    for kind, is_wanted in wanted.items():
        if is_wanted or not any(wanted.values()):
            for name in packages[args.package_name][kind]:
                print(f"{args.package_name}/{kind}/{name}")
    return None


class PackageVerb(VerbExtension, module=__name__):
    """List the interfaces of a package."""
