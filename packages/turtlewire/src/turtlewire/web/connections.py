"""The sockets of a WebSocket server, so that it ends in time whatever its clients do."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    import asyncio

    from websockets.asyncio.server import Server, ServerConnection

__all__ = ["Connections"]


class Connections:
    """All sockets of a server, also those without a request. For the thread of its loop only."""

    def __init__(self) -> None:
        self._transports: set[asyncio.Transport] = set()

    def connection_type(self) -> type[ServerConnection]:
        """The class of connections to give to the library; they are listed here while open."""
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

    async def close(self, server: Server, timeout_s: float) -> None:
        """Close a server; what is still open after ``timeout_s`` is cut off.

        A client that is suspended or unreachable never answers the closing handshake.
        """
        import asyncio

        server.close()
        closed = asyncio.ensure_future(server.wait_closed())
        await asyncio.wait([closed], timeout=timeout_s)
        for transport in self._transports:
            transport.abort()
        await closed
