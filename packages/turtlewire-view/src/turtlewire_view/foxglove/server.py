"""The server: it accepts clients, and hands each one's frames to a session.

A browser lets every page open a WebSocket to this machine and says in ``Origin`` which page it is.
Without a check any page that the user visits could read the robot's topics, and drive it.
"""

from __future__ import annotations

import asyncio
import contextlib
import errno
import re
import time
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, cast

from turtlewire.terminal.printable import printable
from turtlewire.web import origin as web_origin
from turtlewire.web.server_thread import ServerThread, listening_socket, until_one_ends
from turtlewire_view.foxglove.assets import share_folder
from turtlewire_view.foxglove.bridge import Bridge
from turtlewire_view.foxglove.outbox import Outbox
from turtlewire_view.foxglove.protocol import SUBPROTOCOLS
from turtlewire_view.foxglove.session import FoxgloveSession

if TYPE_CHECKING:
    import socket

    from websockets.asyncio.server import ServerConnection
    from websockets.datastructures import Headers
    from websockets.http11 import Request, Response

    from turtlewire.web.loop_calls import LoopCalls
    from turtlewire.wire.base import Context, Node
    from turtlewire_view.foxglove.bridge import Log
    from turtlewire_view.foxglove.options import BridgeOptions

__all__ = [
    "FOXGLOVE",
    "FoxgloveServer",
    "refusal",
]

#: The pages of the Foxglove app.
FOXGLOVE = ("https://app.foxglove.dev", "https://studio.foxglove.dev")
_LOOPBACK = re.compile(r"https?://(?:localhost|127\.0\.0\.1|\[::1\])(?::\d+)?")


def refusal(origins: list[str], allowed: Iterable[str]) -> str | None:
    """Return why a connection is refused, as one sentence, or None if it is allowed.

    Args:
        origins: All ``Origin`` headers. Programs other than browsers send none.
        allowed: Origins that may connect, besides Foxglove's and this machine's. ``*``
            stands for all.
    """
    known = {*FOXGLOVE, *(origin.lower().rstrip("/") for origin in allowed)}
    if not origins or "*" in known:
        return None
    if len(origins) == 1:
        origin = origins[0].lower()
        if origin.rstrip("/") in known or _LOOPBACK.fullmatch(origin):
            return None
    shown = ", ".join(repr(origin) for origin in origins)
    return f"pages of {shown} may not connect"


#: Longest message that a client may send [bytes].
_LARGEST_MESSAGE = 64 << 20
#: How long a client may be silent [s]; a slow one answers only after all that was sent before.
_PING_TIMEOUT = 120
#: Number of frames to send to one client before the next client's turn.
_TURN = 64
#: Messages within this time are sent together: a wake-up costs more than a frame [s].
_REST = 0.004
#: Origins and hosts that are warned of; further ones are refused in silence.
_MOST_WARNINGS = 20

_NO_PROTOCOL = "Missing expected sec-websocket-protocol header\n"


class FoxgloveServer:
    """Serves Foxglove's protocol from the moment it is constructed until :meth:`close`.

    Args:
        context: The participant.
        node: Whose endpoints are used.
        options: What is served, where and to whom.
        log: Where lines for the server's user go.
        find_share: Returns the share folder of a package, for its files.

    Attributes:
        url: Where clients connect.

    Raises:
        OSError: The address is not one of this machine, or the port is in use; the text says so.
        WireError: The wire refuses the subscription of ``/clock``.
    """

    def __init__(
        self,
        context: Context,
        node: Node,
        options: BridgeOptions,
        log: Log,
        find_share: Callable[[str], str | None] = share_folder,
    ) -> None:
        self._options = options
        self._log = log
        self._bridged = (context, node, options, log, find_share)
        self._session_id = str(time.time_ns())
        self._warned: set[str] = set()
        listener = _listening(options)
        host, port = listener.getsockname()[:2]
        self.url = f"ws://[{host}]:{port}" if ":" in host else f"ws://{host}:{port}"
        self._thread = ServerThread(
            listener,
            self._handle,
            self._answer,
            name="turtlewire_view.foxglove",
            within=self._bridging,
            subprotocols=cast("Any", SUBPROTOCOLS),
            select_subprotocol=_subprotocol,
            ping_timeout=_PING_TIMEOUT,
            max_size=_LARGEST_MESSAGE,
        )

    def close(self) -> None:
        """Close all connections and leave the wire, within a second or two. Idempotent."""
        self._thread.close()

    @contextlib.contextmanager
    def _bridging(self, calls: LoopCalls) -> Iterator[None]:
        self._soon = calls.soon
        self._bridge = Bridge(*self._bridged, calls=calls)
        try:
            yield
        finally:
            self._bridge.close()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Refuse foreign pages and other protocols; None lets the WebSocket begin."""
        from http import HTTPStatus

        reason = self._refusal(request.headers)
        if reason is not None:
            return connection.respond(HTTPStatus.FORBIDDEN, f"Refused: {reason}.\n")
        if not request.headers.get_all("Upgrade"):
            return connection.respond(
                HTTPStatus.UPGRADE_REQUIRED,
                f"Foxglove and Lichtblick connect here: open a connection to {self.url} there.\n",
            )
        offered = ",".join(request.headers.get_all("Sec-WebSocket-Protocol"))
        if not {*SUBPROTOCOLS} & {name.strip() for name in offered.split(",")}:
            return connection.respond(HTTPStatus.BAD_REQUEST, _NO_PROTOCOL)
        return None

    def _refusal(self, headers: Headers) -> str | None:
        """Return why a request is refused, and log a warning; None if it is allowed.

        Other computers' names are checked on loopback only: elsewhere, anyone who can reach the
        server is served, and under whatever name it has there.
        """
        pages, hosts = headers.get_all("Origin"), headers.get_all("Host")
        allowed = self._options.origins
        reason = refusal(pages, allowed)
        if reason is not None:
            key = ",".join(pages)
            self._warn_of(key, reason, f"--origin {key} (parameter origins) lets them")
        elif self._options.is_local and "*" not in allowed:
            foreign = web_origin.refusal(hosts, [])
            if foreign is not None:
                reason = foreign.rstrip(".")
                self._warn_of(",".join(hosts), reason, "--address 0.0.0.0 serves the network")
        return reason

    def _warn_of(self, key: str, reason: str, way: str) -> None:
        if key not in self._warned and len(self._warned) < _MOST_WARNINGS:
            self._warned.add(key)
            self._log.warning(printable(f"refused a connection: {reason}; {way}"))

    async def _handle(self, connection: ServerConnection) -> None:
        """Serve one client until either side ends it."""
        host, port = connection.remote_address[:2]
        name = f"{host}:{port}"
        wake = asyncio.Event()
        soon = self._soon
        session: FoxgloveSession | None = None

        def tell_loss(subscription_id: int) -> None:
            if session is not None:
                soon(session.tell_loss, subscription_id)

        outbox = Outbox(
            self._options.send_buffer_limit,
            lambda: soon(wake.set),
            tell_loss,
            lambda: soon(connection.transport.abort),
        )
        session = FoxgloveSession(self._bridge, outbox, name, self._session_id)
        self._log.info(f"client {name} connected ({connection.subprotocol})")
        try:
            error = await until_one_ends(
                _send(connection, session, wake), _receive(connection, session)
            )
        finally:
            session.close()
        self._log.info(f"client {name} disconnected")
        if error is not None:
            self._log.warning(f"client {name}: {error!r}")


async def _send(
    connection: ServerConnection, session: FoxgloveSession, wake: asyncio.Event
) -> None:
    clock = asyncio.get_running_loop().time
    woken = 0.0
    while True:
        await wake.wait()
        wake.clear()
        is_dense, woken = clock() - woken < _REST, clock()
        sent = 0
        while (frame := session.outbox.take()) is not None:
            session.frame_taken()
            await connection.send(frame)
            sent += 1
            if is_dense and session.outbox.is_empty:
                await asyncio.sleep(_REST)
            elif sent % _TURN == 0:
                await asyncio.sleep(0)  # sending does not wait as long as the socket takes it


async def _receive(connection: ServerConnection, session: FoxgloveSession) -> None:
    async for message in connection:
        session.receive(message)
        await session.room()


def _subprotocol(_connection: ServerConnection, offered: list[str]) -> str | None:
    """Return the first of the client's protocols that is ours, as browsers demand exactly one."""
    return next((name for name in offered if name in SUBPROTOCOLS), None)


def _listening(options: BridgeOptions) -> socket.socket:
    """Return a socket that listens, or an error with a sentence for the user."""
    try:
        return listening_socket(options.address, options.port)
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            place = f"port {options.port} of {options.address}"
            text = f"{place} is in use, perhaps by another Foxglove server"
        else:
            place = f"{printable(options.address)}, port {options.port}"
            text = f"cannot listen on {place}: {error.strerror}"
        raise OSError(text) from error
