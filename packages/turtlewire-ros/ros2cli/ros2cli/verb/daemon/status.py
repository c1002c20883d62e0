"""``ros2 daemon status``."""

from __future__ import annotations

import argparse

from ros2cli.verb.daemon import VerbExtension


def main(args: argparse.Namespace) -> None:
    """Say if the daemon runs."""
    from ros2cli.node.daemon import is_daemon_running

    print(f"The daemon is {'' if is_daemon_running(args) else 'not '}running")


class StatusVerb(VerbExtension, module=__name__):
    """Show if the daemon is running."""
