"""A thread that serves WebSockets and stops promptly, whatever its clients do."""

from __future__ import annotations

import contextlib
import errno
import os
import socket
import threading
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    import asyncio
    import logging
    from contextlib import AbstractContextManager

    from websockets.asyncio.server import Server, ServerConnection
    from websockets.http11 import Request

    from turtlewire.web.loop_calls import LoopCalls

#: How long a client may take to answer the closing of its WebSocket [s].
_CLOSE_TIMEOUT = 0.5
#: System errors that pass when files or memory are freed; the server tries again each second.
_OUT_OF_RESOURCES = frozenset({errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM})


class ServerThread:
    """Serves WebSockets from the moment it is constructed until :meth:`close`.

    Args:
        listener: A listening socket; closed at the end.
        handle: Serves one WebSocket on the thread's loop.
        answer: Answers a plain HTTP request there, or returns None to let the WebSocket begin.
        name: Of the thread, and of the logger that reports defects.
        within: Entered on the thread before the first request, and left at the end. With it, the
            constructor waits until the server has started, and raises what keeps it from starting.
        options: For the ``serve`` of websockets.
    """

    def __init__(
        self,
        listener: socket.socket,
        handle: Callable[[ServerConnection], Coroutine[Any, Any, None]],
        answer: Callable[[ServerConnection, Request], Any],
        *,
        name: str,
        within: Callable[[LoopCalls], AbstractContextManager[None]] | None = None,
        **options: Any,
    ) -> None:
        self._listener = listener
        self._within = within
        self._options = {"handler": handle, "process_request": answer, **options}
        self._name = name
        self._calls: LoopCalls | None = None
        self._stopping: asyncio.Event | None = None
        self._started = threading.Event()
        self._failure: BaseException | None = None
        self._transports: set[asyncio.Transport] = set()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()
        if within is not None:
            self._started.wait()
            if self._failure is not None:
                self._thread.join()
                raise self._failure

    def soon(self, call: Callable[..., None], *arguments: Any) -> None:
        """Call a function on the thread, unless it ends or has not started. For any thread."""
        if self._calls is not None:
            self._calls.soon(call, *arguments)

    def close(self) -> None:
        """Close all WebSockets and end, within a second. Idempotent; not for the thread itself."""
        self._started.wait()  # earlier, there is no loop to stop
        if self._stopping is not None:
            self.soon(self._stopping.set)
        self._thread.join()

    def _run(self) -> None:
        import asyncio

        try:
            asyncio.run(self._serve())
        except BaseException as error:
            self._failure = error
            if self._within is None or self._started.is_set():
                raise  # the constructor does not wait, or no longer
        finally:
            self._listener.close()
            self._started.set()

    async def _serve(self) -> None:
        import asyncio
        import logging

        from websockets.asyncio.server import serve

        from turtlewire.web.loop_calls import LoopCalls

        logger = logging.getLogger(self._name)
        logger.addFilter(_is_ours)
        self._stopping = asyncio.Event()
        asyncio.get_running_loop().set_exception_handler(_ExceptionHandler(logger))
        calls = LoopCalls()
        with contextlib.ExitStack() as stack:
            if self._within is not None:
                stack.enter_context(self._within(calls))
            stack.callback(calls.close)
            server = await serve(
                **self._options,
                sock=self._listener,
                create_connection=self._connection_type(),
                compression=None,  # costs more than it saves on this machine's own loopback
                close_timeout=_CLOSE_TIMEOUT,
                logger=logger,
            )
            self._calls = calls
            self._started.set()
            await self._stopping.wait()
            await self._end(server)

    def _connection_type(self) -> type[ServerConnection]:
        """Return a class of connections that are listed while open, even without a request."""
        from websockets.asyncio.server import ServerConnection

        transports = self._transports

        class ListedConnection(ServerConnection):
            def connection_made(self, transport: asyncio.BaseTransport) -> None:
                transports.add(cast("asyncio.Transport", transport))
                super().connection_made(transport)

            def connection_lost(self, exc: Exception | None) -> None:
                super().connection_lost(exc)
                transports.discard(self.transport)

        return ListedConnection

    async def _end(self, server: Server) -> None:
        """Close the server, and abort the connections that stay open.

        A client that is suspended or unreachable never answers the closing handshake.
        """
        import asyncio

        server.close()
        closed = asyncio.ensure_future(server.wait_closed())
        await asyncio.wait([closed], timeout=2 * _CLOSE_TIMEOUT)
        for transport in self._transports:
            transport.abort()
        await closed


async def until_one_ends(*parts: Coroutine[Any, Any, None]) -> Exception | None:
    """Run coroutines until one ends, and cancel the others.

    Returns:
        An exception that was raised, except that the connection was closed.
    """
    import asyncio

    from websockets.exceptions import ConnectionClosed

    tasks = [asyncio.create_task(part) for part in parts]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        results = await asyncio.gather(*tasks, return_exceptions=True)
    errors = (result for result in results if isinstance(result, Exception))
    return next((each for each in errors if not isinstance(each, ConnectionClosed)), None)


def listening_socket(address: str, port: int) -> socket.socket:
    """Return a socket that listens at an address of this machine.

    Raises:
        OSError: The address is not one of this machine, or the port may not be used.
    """
    family, kind, protocol, _, place = socket.getaddrinfo(
        address, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
    )[0]
    listener = socket.socket(family, kind, protocol)
    try:
        if os.name == "posix":  # on Windows the option would let two servers share a port
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(place)
        listener.listen()
    except BaseException:
        listener.close()
        raise
    return listener


class _ExceptionHandler:
    """Reports once that no connection can be accepted; asyncio would report each attempt."""

    def __init__(self, logger: logging.Logger) -> None:
        self._logger = logger
        self._reported = False

    def __call__(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        error = context.get("exception")
        if not isinstance(error, OSError) or error.errno not in _OUT_OF_RESOURCES:
            loop.default_exception_handler(context)
        elif not self._reported:
            self._reported = True
            self._logger.warning(
                "No more browsers can connect: %s. "
                "Close pages or other programs, or raise the limit (ulimit -n).",
                error.strerror,
            )


def _is_ours(record: logging.LogRecord) -> bool:
    """Leave out reports of clients that do not speak HTTP; they got a status."""
    return record.msg != "opening handshake failed"
