"""The server of a page: its files, and a WebSocket for every browser that shows it."""

from __future__ import annotations

import errno
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from turtlewire.web.files import (
    Encoder,
    WebContent,
    find_files,
    has_tag,
    headers,
    policy,
    takes_gzip,
)
from turtlewire.web.lan import new_token, path_below
from turtlewire.web.origin import proxied_refusal, refusal
from turtlewire.web.server_thread import ServerThread, listening_socket, until_one_ends

if TYPE_CHECKING:
    import asyncio
    import socket

    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

    from turtlewire.web.commands import PageSession

#: Where pages open their WebSocket.
LIVE_PATH = "/live"
#: Longest message that a page may send [bytes].
_MAX_MESSAGE = 65536
#: Files that all pages share, served below ``/kit/``.
_KIT = Path(__file__).parent / "kit"
_NAME = "turtlewire.web"
#: The response to requests without it.
_UNINVITED = "The token that the program printed is missing from the address."


class Server:
    """Serves the files below a folder, the kit at ``kit/`` and a WebSocket at ``live``.

    It answers from the moment it is constructed until :meth:`close`. Requests under a foreign name
    and WebSockets of foreign pages get status 403 (see :mod:`turtlewire.web.origin`). Pages name
    everything relative to their own address, which may have a path.

    Attributes:
        url: The page's address on this computer.
    """

    def __init__(
        self,
        root: Path,
        connect: Callable[[], PageSession],
        *,
        port: int = 0,
        lan: bool = False,
        proxied: bool = False,
        answer: Callable[[str], WebContent | None] | None = None,
        sources: Mapping[str, str] | None = None,
        immutable: str | None = None,
    ) -> None:
        """Start serving.

        Args:
            root: Folder of the page's files.
            connect: Called on the server's thread for each browser that opens the WebSocket.
            port: Preferred TCP port. A free one is taken if it is in use.
            lan: Whether to serve all devices of the network. Every request must then begin with a
                random token, which is part of ``url`` (see :mod:`turtlewire.web.lan`).
            proxied: Whether a proxy on this computer passes requests on, under any name. Every
                request must then begin with the token, as with ``lan``.
            answer: Called, on any thread, for a path that is not a file, with its escapes decoded:
                ``/mesh/x.stl``. Returning None gives status 404.
            sources: What the page may load besides, by directive of the Content-Security-Policy.
                Import maps in the page need no entry.
            immutable: Beginning of the paths of files that never change, as ``/three-0.180/``;
                browsers keep them.

        Raises:
            OSError: No socket can be opened, or the port may not be used.
        """
        self._files = {**find_files(root), **find_files(_KIT, "/kit/")}
        self._encoder = Encoder()
        self._policy = policy(self._files, sources or {})
        self._immutable = immutable
        self._connect = connect
        self._computed = answer
        self._token = new_token() if lan or proxied else None
        self._proxied = proxied
        self._wake_ups: set[asyncio.Event] = set()
        listener = _listen("0.0.0.0" if lan else "127.0.0.1", port)  # noqa: S104
        home = "/" if self._token is None else f"/{self._token}/"
        self.url = f"http://127.0.0.1:{listener.getsockname()[1]}{home}"
        self._thread = ServerThread(
            listener,
            self._handle,
            self._answer,
            name=_NAME,
            max_size=_MAX_MESSAGE,
        )

    @property
    def watched(self) -> bool:
        """True if any browser has its WebSocket open."""
        return bool(self._wake_ups)

    def notify(self) -> None:
        """Tell every session that there is something new. Returns at once; for any thread."""
        if self._wake_ups:  # the simulator calls this at each tick, mostly without a browser
            self._thread.soon(self._wake_sessions)

    def close(self) -> None:
        """Close all WebSockets and stop serving, within a second. Not for the server's thread."""
        self._thread.close()

    def _wake_sessions(self) -> None:
        for wake_up in self._wake_ups:
            wake_up.set()

    async def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Answer a plain HTTP request; None lets the WebSocket begin."""
        from http import HTTPStatus

        path = self._asked(request.path.partition("?")[0])
        reason = self._refusal(request)
        if reason is not None or path is None:
            text = f"Refused: {reason or _UNINVITED}\n"
            return connection.respond(HTTPStatus.FORBIDDEN, text)
        # Older releases of the library have no such attribute and refuse other methods themselves.
        if getattr(request, "method", "GET") != "GET":
            return connection.respond(HTTPStatus.METHOD_NOT_ALLOWED, "Only GET is answered here.\n")
        if path == LIVE_PATH:
            return None
        if not path:  # names in the page are relative to its address, which ends with a slash
            response = connection.respond(HTTPStatus.PERMANENT_REDIRECT, "The page is at a /.\n")
            response.headers["Location"] = f"{self._token}/"  # a proxy serves it below a path
            return response
        found = await self._found(path, request, request.headers["Host"])
        return found or connection.respond(HTTPStatus.NOT_FOUND, f"There is no {path} here.\n")

    def _refusal(self, request: Request) -> str | None:
        """Return why the headers of a request are refused, or None if they are allowed."""
        hosts, origins, forwarded = map(
            request.headers.get_all, ("Host", "Origin", "X-Forwarded-Host")
        )
        if self._proxied:
            return proxied_refusal(hosts, forwarded, origins)
        return refusal(hosts, origins, lan=self._token is not None)

    def _asked(self, path: str) -> str | None:
        """The path that is asked for, without the token; None if a token is needed and missing."""
        return path if self._token is None else path_below(self._token, path)

    async def _found(self, path: str, request: Request, host: str) -> Response | None:
        """Return the answer with what is at a path, or None if nothing is."""
        if path in self._files:
            return await self._respond_with_file(path, request, host)
        content = await self._compute(path)
        return None if content is None else _response(200, "OK", self._headers(path, host), content)

    async def _respond_with_file(self, path: str, request: Request, host: str) -> Response:
        """Answer with a file of the page, or with status 304 if the browser has it already."""
        import asyncio

        file = self._files[path]
        gzipped = takes_gzip(request.headers.get_all("Accept-Encoding"))
        # In another thread, so that slow compression does not delay the streams.
        encoded = await asyncio.to_thread(self._encoder.read, file, gzipped=gzipped)
        fields = {**self._headers(path, host), **encoded.caching}
        if has_tag(request.headers.get_all("If-None-Match"), encoded.caching["ETag"]):
            return _response(304, "Not Modified", fields)
        content = WebContent(encoded.body, file.media_type)
        return _response(200, "OK", {**fields, **encoded.coding}, content)

    async def _compute(self, path: str) -> WebContent | None:
        """Return what ``answer`` has at a path, or None if it has nothing."""
        import asyncio
        import logging
        from urllib.parse import unquote

        if self._computed is None:
            return None
        try:  # in another thread, so that reading large files does not delay the streams
            return await asyncio.to_thread(self._computed, unquote(path))
        except Exception:
            logging.getLogger(_NAME).exception("Internal error while serving %s", path)
            raise  # the browser gets status 500

    def _headers(self, path: str, host: str) -> dict[str, str]:
        immutable = self._immutable is not None and path.startswith(self._immutable)
        return headers(self._policy.format(host=host), immutable=immutable)

    async def _handle(self, connection: ServerConnection) -> None:
        """Serve one WebSocket until either side ends it."""
        import asyncio

        session = self._connect()
        wake_up = asyncio.Event()
        wake_up.set()  # a new browser needs the whole picture, though nothing has changed
        self._wake_ups.add(wake_up)
        try:
            error = await until_one_ends(
                _send(connection, session, wake_up), _receive(connection, session, wake_up)
            )
        finally:
            self._wake_ups.discard(wake_up)
            session.closed()
        if error is not None:
            raise error


def _response(
    status: int, reason: str, fields: Mapping[str, str], content: WebContent | None = None
) -> Response:
    from websockets.datastructures import Headers
    from websockets.http11 import Response

    if content is None:
        return Response(status, reason, Headers(fields), b"")
    described = {"Content-Type": content.media_type, "Content-Length": str(len(content.body))}
    return Response(status, reason, Headers({**described, **fields}), content.body)


async def _send(connection: ServerConnection, session: PageSession, wake_up: asyncio.Event) -> None:
    while True:
        await wake_up.wait()
        wake_up.clear()
        for message in session.outgoing():
            await connection.send(message)


async def _receive(
    connection: ServerConnection, session: PageSession, wake_up: asyncio.Event
) -> None:
    async for message in connection:
        session.receive(message)
        wake_up.set()


def _listen(address: str, port: int) -> socket.socket:
    """Return a socket at a port, or at a free one if it is in use."""
    try:
        return listening_socket(address, port)
    except OSError as error:
        if error.errno != errno.EADDRINUSE:
            raise
        return listening_socket(address, 0)
