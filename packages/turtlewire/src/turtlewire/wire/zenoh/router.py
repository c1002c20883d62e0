"""A router: a Zenoh session with the configuration of rmw_zenohd."""

from __future__ import annotations

import signal
import sys
import time
from contextlib import suppress
from typing import TextIO

import zenoh

from turtlewire.errors import WireError

from .configuration import router_configuration
from .diagnosis import warn_of_faults
from .library import reason_of
from .router_log import explained_log

__all__ = ["route"]

_ENDING = {signal.SIGINT, signal.SIGTERM}
_DAY_S = 86_400.0


def route() -> None:
    """Route until SIGINT or SIGTERM comes; on the main thread.

    Raises:
        WireError: The configuration is wrong, or its address is taken.
    """
    if sys.platform != "win32":
        # Zenoh's threads inherit it, so that none of them takes the signal.
        signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)
    with explained_log() as output:
        _route(output)


def _route(output: TextIO) -> None:
    configuration = router_configuration()
    try:
        session = zenoh.open(configuration)
    except zenoh.ZError as error:
        failed = WireError(f"cannot start a Zenoh router: {reason_of(error)}")
        raise failed.with_hint(
            "If its port is in use, a router may already be running; for another address, set "
            "ZENOH_CONFIG_OVERRIDE='listen/endpoints=[\"tcp/127.0.0.1:7448\"]'"
        ) from error
    output.write(f"Started Zenoh router with id {session.zid()}\n")
    output.flush()
    warn_of_faults(configuration)
    _wait_for_end()
    session.close()  # type: ignore[no-untyped-call]


def _wait_for_end() -> None:
    if sys.platform == "win32":
        with suppress(KeyboardInterrupt):
            while True:
                time.sleep(_DAY_S)  # which Ctrl-C ends there, unlike a wait for an event
    else:
        signal.sigwait(_ENDING)
