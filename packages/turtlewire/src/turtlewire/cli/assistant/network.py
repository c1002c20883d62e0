"""The connection of the tools to the network."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from types import TracebackType
from typing import TYPE_CHECKING

import anyio

from turtlewire import wire
from turtlewire.cli.assistant.permissions import RefusedCallError, full_name
from turtlewire.net.connection import Connection
from turtlewire.terminal.printable import printable
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wake_up import LoopWakeUp

if TYPE_CHECKING:
    from typing_extensions import Self

#: How long a call waits until the nodes of this computer are known [s].
_DISCOVERY_S = 2.0


class Network:
    """A participant with one node, ``/turtlewire_mcp``; a context manager.

    Attributes:
        connection: Publishes and subscribes.
        context: Its participant.
        node: Its node, for what a connection does not make.
        graph: The nodes, topics and services.

    Raises:
        WireError: The domain cannot be joined.
    """

    def __init__(self) -> None:
        self.context = wire.open_context()
        self.connection = Connection(self.context, "turtlewire_mcp", "/")
        self.node = self.connection._node
        self.graph = self.context.graph
        self.graph.hurry()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.connection.close()

    async def until(self, predicate: Callable[[], bool], limit_s: float) -> bool:
        """Wait until the graph fulfils a condition; False if the time is over before."""
        changed = LoopWakeUp(asyncio.get_running_loop())
        stop = self.graph.add_listener(changed.set)
        try:
            with anyio.move_on_after(limit_s):
                while not predicate():
                    await changed.wait()
        finally:
            stop()
        return predicate()

    async def topics(self) -> dict[str, list[str]]:
        """Return the topics with their types, once all of this computer are known."""
        await self.until(self.graph.is_complete, _DISCOVERY_S)
        return self.connection.topics()

    async def services(self) -> dict[str, list[str]]:
        """Return the services with their types, likewise."""
        await self.until(self.graph.is_complete, _DISCOVERY_S)
        return self.graph.service_names_and_types()

    async def type_of_topic(self, name: str) -> tuple[str, str]:
        """Return the full name and the type of a topic.

        Raises:
            RefusedCallError: The name does not exist, or has several types.
        """
        return _only_type("topic", name, await self.topics())

    async def type_of_service(self, name: str) -> tuple[str, str]:
        """Return the full name and the type of a service.

        Raises:
            RefusedCallError: The name does not exist, or has several types.
        """
        return _only_type("service", name, await self.services())


def unknown(kind: str, name: str, known: Iterable[str]) -> RefusedCallError:
    """Return the error for a name that does not exist, with those that are near.

    Args:
        kind: ``topic`` or ``service``.
        name: What was asked for.
        known: What exists.
    """
    near = did_you_mean(name, known)
    advice = f"{near}. " if near else ""
    text = f"There is no {kind} {name}. {advice}The tool list_{kind}s shows all."
    return RefusedCallError(printable(text))


def _only_type(kind: str, name: str, known: dict[str, list[str]]) -> tuple[str, str]:
    full = full_name(name)
    if full not in known:
        raise unknown(kind, full, known)
    types = known[full]
    if len(types) > 1:
        text = f"The {kind} {full} is used with several types: {', '.join(types)}"
        raise RefusedCallError(printable(text))
    return full, types[0]
