"""The wait for a router that ``ZENOH_ROUTER_CHECK_ATTEMPTS`` asks for.

rmw_zenoh looks for a router even when the variable is unset. Sessions here find each other without
one, so an unset variable means no check.
"""

from __future__ import annotations

import os
import threading
from typing import TYPE_CHECKING

from zenoh import SampleKind, WhatAmI
from zenoh.handlers import Callback

from turtlewire.wire.report import warn, warn_once

if TYPE_CHECKING:
    import zenoh

__all__ = ["wait_for_router"]

_VARIABLE = "ZENOH_ROUTER_CHECK_ATTEMPTS"
_NO_ROUTER = (
    "Unable to connect to a Zenoh router. "
    "Have you started a router with `ros2 run rmw_zenoh_cpp rmw_zenohd`?"
)
_GIVEN_UP = (
    "Unable to connect to a Zenoh router after {} attempt(s) (ZENOH_ROUTER_CHECK_ATTEMPTS). Going "
    "on without one: only nodes that multicast or static peers reach are found."
)


def wait_for_router(session: zenoh.Session) -> None:
    """Wait for a router as long as ``ZENOH_ROUTER_CHECK_ATTEMPTS`` says.

    A positive number is that many seconds (rmw_zenoh's attempts are a second apart), 0 means no
    limit, a negative number no check. The session continues without a router, after a warning.
    """
    attempts = _attempts()
    if attempts < 0:
        return
    connected = threading.Event()

    def on_transport(event: zenoh.TransportEvent) -> None:
        if event.kind == SampleKind.PUT and event.transport.whatami == WhatAmI.ROUTER:
            connected.set()

    listener = session.info.declare_transport_events_listener(
        Callback(on_transport, indirect=False), history=True
    )
    try:
        if session.info.routers_zid():
            return
        warn(_NO_ROUTER)
        if not connected.wait(attempts or None):
            warn(_GIVEN_UP.format(attempts))
    finally:
        listener.undeclare()  # type: ignore[no-untyped-call]


def _attempts() -> int:
    text = os.environ.get(_VARIABLE, "").strip()
    if not text:
        return -1
    try:
        return int(text)
    except ValueError:
        warn_once(
            _VARIABLE,
            f"{_VARIABLE} is not an integer, so the session does not wait for a router: {text}",
        )
        return -1
