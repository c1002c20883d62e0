"""``ros2 run rmw_zenoh_cpp rmw_zenohd``: a Zenoh router, which connects several hosts.

It listens at 127.0.0.1:7447, unless the file in ``ZENOH_ROUTER_CONFIG_URI``, or
``ZENOH_CONFIG_OVERRIDE``, configures it otherwise. Processes on one host find each other without
it.
"""

from __future__ import annotations

import sys

from turtlewire.errors import WireError
from turtlewire.wire.zenoh.library import require_zenoh


def main() -> int:
    """Route until Ctrl-C; returns the exit status."""
    try:
        require_zenoh()
        from turtlewire.wire.zenoh.router import route

        route()
    except WireError as error:
        sys.stderr.write(f"{error}\n{error.hint}\n")
        return 1
    return 0
