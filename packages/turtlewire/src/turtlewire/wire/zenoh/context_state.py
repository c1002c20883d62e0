"""The state that a context shares with its nodes and endpoints."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Protocol

import zenoh

from turtlewire.errors import WireError

from .callback_threads import CallbackThreads, Calls
from .library import reason_of

if TYPE_CHECKING:
    import threading

    from turtlewire.wire.base import Entity
    from turtlewire.wire.reader_thread import ReaderThread

    from .configuration import SharedMemory
    from .graph import ZenohGraph
    from .protocol import Token


class Owner(Protocol):
    """The node of an endpoint, as the endpoint knows it.

    Attributes:
        token: How the graph shows it.
    """

    token: Token

    def adopt(self, endpoint: Entity) -> None:
        """Own an endpoint until it closes."""

    def forget(self, endpoint: Entity) -> None:
        """An endpoint was closed."""


class ZenohContextState:
    """A session, and what belongs to it.

    Attributes:
        session: The Zenoh session.
        session_id: Its id as tokens spell it.
        domain_id: The domain of all keys.
        lock: Guards queues, matches and the graph. It is never held while Zenoh is called, because
            Zenoh's threads take it.
        reader: Calls callbacks.
        graph: Nodes and endpoints.
        memory: Where large messages are written, if it is enabled.
        calls: Who is in Zenoh's library.
        threads: Those on which Zenoh's callbacks run.
        closing: Whether the context is being closed, or is closed.
        process: The process that opened it.
    """

    def __init__(
        self,
        session: zenoh.Session,
        domain_id: int,
        reader: ReaderThread,
        graph: ZenohGraph,
        memory: SharedMemory,
    ) -> None:
        self.session = session
        self.session_id = str(session.zid())
        self.domain_id = domain_id
        self.lock: threading.RLock = graph.lock
        self.reader = reader
        self.graph = graph
        self.memory = memory
        self.calls = Calls()
        self.threads = CallbackThreads()
        self.closing = False
        self.process = os.getpid()
        self._numbers = itertools.count()

    def next_number(self) -> str:
        """Return a number for a new node or endpoint."""
        return str(next(self._numbers))

    def require_open(self, what: str) -> None:
        """Refuse what a closed context cannot do.

        Raises:
            WireError: The context is closed.
        """
        if self.closing:
            raise WireError(f"{what}: the context is closed")

    @contextmanager
    def declaring(self, what: str) -> Iterator[None]:
        """Let the block declare something in Zenoh's session.

        Raises:
            WireError: The session is closed, or Zenoh refuses it.
        """
        self.require_open(what)
        try:
            yield
        except zenoh.ZError as error:
            raise WireError(f"{what}: {reason_of(error)}") from error
