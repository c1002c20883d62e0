"""``ros2 daemon stop``."""

from __future__ import annotations

import argparse

from ros2cli.verb.daemon import VerbExtension

_END_S = 10.0


def main(args: argparse.Namespace) -> None:
    """Stop the daemon, and wait for its end."""
    from ros2cli.node.daemon import shutdown_daemon

    stopped = shutdown_daemon(args, timeout=_END_S)
    print("The daemon has been stopped" if stopped else "The daemon is not running")


class StopVerb(VerbExtension, module=__name__):
    """Stop the daemon."""
