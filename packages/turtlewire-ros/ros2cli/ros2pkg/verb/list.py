"""``ros2 pkg list``."""

from __future__ import annotations

import argparse

from ros2pkg.verb import VerbExtension


def main(_args: argparse.Namespace) -> None:
    """Print the names, sorted."""
    from turtlewire_ros.prefix import package_names

    for name in sorted(package_names()):
        print(name)


class ListVerb(VerbExtension, module=__name__):
    """List the installed packages."""
