"""``ros2 daemon start``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2cli.verb.daemon import VerbExtension

_START_S = 10.0


ARGUMENTS = (
    argument("-d", "--debug", action="store_true", help="Show on stderr what the daemon is asked"),
)


def main(args: argparse.Namespace) -> str | None:
    """Start the daemon; return the text of an error if that is not possible."""
    from ros2cli.daemon import get_port
    from ros2cli.node.daemon import is_daemon_running, spawn_daemon

    started = spawn_daemon(args, timeout=_START_S, debug=args.debug)
    if not started and not is_daemon_running(args):
        return (
            f"Port {get_port()}, which is the daemon's in this domain, is in use by another "
            "program: stop it, or choose another ROS_DOMAIN_ID"
        )
    print("The daemon has been started" if started else "The daemon is already running")
    return None


class StartVerb(VerbExtension, module=__name__):
    """Start the daemon, which answers programs; the verbs need none."""
