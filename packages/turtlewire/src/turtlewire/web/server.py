"""One thread that serves a page and talks to every browser that shows it."""

from __future__ import annotations

import errno
import os
import socket
import threading
from typing import TYPE_CHECKING, Any, Protocol

from turtlewire.web.connections import Connections
from turtlewire.web.encoding import Encoder, has_tag, takes_gzip
from turtlewire.web.files import Content, find_files, headers, policy
from turtlewire.web.lan import new_token, path_below
from turtlewire.web.origin import refusal

if TYPE_CHECKING:
    import asyncio
    import logging
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

__all__ = ["LIVE_PATH", "PageSession", "Server"]

#: Where pages open their WebSocket.
LIVE_PATH = "/live"
#: Longest message that a page may send [bytes].
_MAX_MESSAGE = 65536
#: System errors that pass when files or memory are freed; the server tries again each second.
_OUT_OF_RESOURCES = frozenset({errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM})
#: How long a browser may take to answer the closing of its WebSocket [s].
_CLOSE_TIMEOUT = 0.5
#: The response to requests without it.
_UNINVITED = "The token that the program printed is missing from the address."


class PageSession(Protocol):
    """One browser's connection. The server's thread calls all methods, so they must be short."""

    def outgoing(self) -> list[str | bytes]:
        """Return the messages that this browser does not have yet.

        Called after :meth:`Server.notify`, and only when the browser has taken the last messages:
        values that became outdated in between are never sent, so a slow browser sees fewer frames,
        not old ones.
        """
        ...

    def receive(self, message: str | bytes) -> None:
        """Take a message of the browser; the session answers a wrong one itself."""
        ...

    def closed(self) -> None:
        """The browser is gone."""
        ...


class Server:
    """Serves the files below a folder on 127.0.0.1, and a WebSocket at ``live``.

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
        answer: Callable[[str], Content | None] | None = None,
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
            answer: Called, on any thread, for a path that is not a file, with its escapes decoded:
                ``/mesh/x.stl``. Returning None gives status 404.
            sources: What the page may load besides, by directive of the Content-Security-Policy.
                Import maps in the page need no entry.
            immutable: Beginning of the paths of files that never change, as ``/three-0.180/``;
                browsers keep them.

        Raises:
            OSError: No socket can be opened, or the port may not be used.
        """
        self._files = find_files(root)
        self._encoder = Encoder()
        self._policy = policy(self._files, sources or {})
        self._immutable = immutable
        self._connect = connect
        self._computed = answer
        self._token = new_token() if lan else None
        self._socket = _listen("0.0.0.0" if lan else "127.0.0.1", port)  # noqa: S104
        self._home = f"/{self._token}/" if lan else "/"
        self.url = f"http://127.0.0.1:{self._socket.getsockname()[1]}{self._home}"
        self._lock = threading.Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._stopping: asyncio.Event | None = None
        self._started = threading.Event()
        self._wake_ups: set[asyncio.Event] = set()
        self._connections = Connections()
        self._thread = threading.Thread(target=self._run, name="turtlewire-web", daemon=True)
        self._thread.start()

    @property
    def watched(self) -> bool:
        """True if any browser has its WebSocket open."""
        return bool(self._wake_ups)

    def notify(self) -> None:
        """Tell every session that there is something new. Returns at once; for any thread."""
        if not self._wake_ups:  # the simulator calls this at each tick, mostly without a browser
            return
        with self._lock:
            if self._loop is not None:
                self._loop.call_soon_threadsafe(self._wake_sessions)

    def close(self) -> None:
        """Close all WebSockets and stop serving, within a second. Not for the server's thread."""
        self._started.wait()  # before that there is no loop that could be stopped
        with self._lock:
            if self._loop is not None and self._stopping is not None:
                self._loop.call_soon_threadsafe(self._stopping.set)
        self._thread.join()

    def _run(self) -> None:
        import asyncio

        try:
            asyncio.run(self._serve())
        finally:
            self._socket.close()
            self._started.set()

    async def _serve(self) -> None:
        import asyncio

        from websockets.asyncio.server import serve

        self._stopping = asyncio.Event()
        asyncio.get_running_loop().set_exception_handler(_ExceptionHandler())
        server = await serve(
            self._handle,
            sock=self._socket,
            create_connection=self._connections.connection_type(),
            process_request=self._answer,
            compression=None,  # costs more than it saves on this machine's own loopback
            close_timeout=_CLOSE_TIMEOUT,
            max_size=_MAX_MESSAGE,
            logger=_logger(),
        )
        with self._lock:
            self._loop = asyncio.get_running_loop()
        self._started.set()
        await self._stopping.wait()
        # From here on `notify` does nothing: the loop may be closed at any moment.
        with self._lock:
            self._loop = None
        await self._connections.close(server, 2 * _CLOSE_TIMEOUT)

    def _wake_sessions(self) -> None:
        for wake_up in self._wake_ups:
            wake_up.set()

    async def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Answer a plain HTTP request; None lets the WebSocket begin."""
        from http import HTTPStatus

        hosts = request.headers.get_all("Host")
        path = self._asked(request.path.partition("?")[0])
        reason = refusal(hosts, request.headers.get_all("Origin"), lan=self._token is not None)
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
            response.headers["Location"] = self._home
            return response
        found = await self._found(path, request, hosts[0])
        return found or connection.respond(HTTPStatus.NOT_FOUND, f"There is no {path} here.\n")

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
        # In another thread: compressing takes its time, and the streams go on.
        encoded = await asyncio.to_thread(self._encoder.read, file, gzipped=gzipped)
        fields = {**self._headers(path, host), **encoded.caching}
        if has_tag(request.headers.get_all("If-None-Match"), encoded.caching["ETag"]):
            return _response(304, "Not Modified", fields)
        content = Content(encoded.body, file.media_type)
        return _response(200, "OK", {**fields, **encoded.coding}, content)

    async def _compute(self, path: str) -> Content | None:
        """Return what ``answer`` has at a path, or None if it has nothing."""
        import asyncio
        from urllib.parse import unquote

        if self._computed is None:
            return None
        try:  # in another thread: it may read long files, and the streams go on
            return await asyncio.to_thread(self._computed, unquote(path))
        except Exception:
            _logger().exception("Internal error while serving %s", path)
            raise  # the browser gets status 500

    def _headers(self, path: str, host: str) -> dict[str, str]:
        immutable = self._immutable is not None and path.startswith(self._immutable)
        return headers(self._policy.format(host=host), immutable=immutable)

    async def _handle(self, connection: ServerConnection) -> None:
        """Serve one WebSocket until either side ends it."""
        import asyncio

        from websockets.exceptions import ConnectionClosed

        session = self._connect()
        wake_up = asyncio.Event()
        wake_up.set()  # a new browser needs the whole picture, though nothing has changed
        self._wake_ups.add(wake_up)
        tasks = [
            asyncio.create_task(_send(connection, session, wake_up)),
            asyncio.create_task(_receive(connection, session, wake_up)),
        ]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._wake_ups.discard(wake_up)
            for task in tasks:
                task.cancel()
            results = await asyncio.gather(*tasks, return_exceptions=True)
            session.closed()
        for result in results:
            if isinstance(result, Exception) and not isinstance(result, ConnectionClosed):
                raise result


def _response(
    status: int, reason: str, fields: Mapping[str, str], content: Content | None = None
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


class _ExceptionHandler:
    """Reports once that no connection can be accepted; asyncio would report each attempt."""

    def __init__(self) -> None:
        self._reported = False

    def __call__(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        error = context.get("exception")
        if not isinstance(error, OSError) or error.errno not in _OUT_OF_RESOURCES:
            loop.default_exception_handler(context)
        elif not self._reported:
            self._reported = True
            _logger().warning(
                "No more browsers can connect: %s. "
                "Close pages or other programs, or raise the limit (ulimit -n).",
                error.strerror,
            )


def _listen(host: str, port: int) -> socket.socket:
    try:
        return _bound(host, port)
    except OSError as error:
        if error.errno != errno.EADDRINUSE:
            raise
        return _bound(host, 0)


def _bound(host: str, port: int) -> socket.socket:
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        if os.name == "posix":  # on Windows the option would let two servers share a port
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen()
    except BaseException:
        listener.close()
        raise
    return listener


def _logger() -> logging.Logger:
    """The library's log without reports of clients that do not speak HTTP, which got a status."""
    import logging

    logger = logging.getLogger("turtlewire.web")
    logger.addFilter(_is_ours)
    return logger


def _is_ours(record: logging.LogRecord) -> bool:
    return record.msg != "opening handshake failed"
