"""A router: a Zenoh session with the configuration of rmw_zenohd."""

from __future__ import annotations

import signal
from typing import TextIO

import zenoh

from turtlewire.errors import WireError

from .configuration import router_configuration
from .diagnosis import warn_of_faults
from .library import reason_of
from .router_log import explained_log

__all__ = ["route"]


def route() -> None:
    """Route until SIGINT or SIGTERM comes; on the main thread.

    Raises:
        WireError: The configuration is wrong, or its address is taken.
    """
    ending = {signal.SIGINT, signal.SIGTERM}
    # Zenoh's threads inherit it, so that none of them takes the signal.
    signal.pthread_sigmask(signal.SIG_BLOCK, ending)
    with explained_log() as output:
        _route_until(ending, output)


def _route_until(ending: set[signal.Signals], output: TextIO) -> None:
    configuration = router_configuration()
    try:
        session = zenoh.open(configuration)
    except zenoh.ZError as error:
        failed = WireError(f"cannot start a Zenoh router: {reason_of(error)}")
        raise failed.with_hint(
            "If its port is taken, a router may be running already; another address: "
            "ZENOH_CONFIG_OVERRIDE='listen/endpoints=[\"tcp/127.0.0.1:7448\"]'"
        ) from error
    output.write(f"Started Zenoh router with id {session.zid()}\n")
    output.flush()
    warn_of_faults(configuration)
    signal.sigwait(ending)
    session.close()  # type: ignore[no-untyped-call]
