"""The common base of all endpoints."""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import Entity, EventKind
from turtlewire.wire.events import EventSource

from .protocol import adapted, format_qos

if TYPE_CHECKING:
    from typing import Protocol

    from turtlewire.wire.base import Event, TypeId
    from turtlewire.wire.qos import QoS

    from .context_state import Owner, ZenohContextState
    from .protocol import Token

    class Declared(Protocol):
        """An object that Zenoh returns for a publisher, a subscriber and the like."""

        def undeclare(self) -> None:
            """Take it back."""


class ZenohEndpoint(EventSource, Entity):
    """An endpoint with its token. The context's lock guards its state.

    Attributes:
        token: How the graph shows it.
        gid: 16 bytes, which its messages carry.
        qos: Its policies, without system defaults.
        partners: The endpoints that it matches, by the text of their tokens.
    """

    #: The kind of its token, and the events that can be asked for.
    KIND = ""
    # As in rmw_zenoh_cpp, the incompatible ones never happen, because everything matches.
    EVENTS = frozenset({EventKind.MATCHED, EventKind.INCOMPATIBLE_QOS, EventKind.INCOMPATIBLE_TYPE})

    def __init__(
        self, core: ZenohContextState, node: Owner, name: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(core.lock)
        self.topic = name
        self.qos = adapted(qos)
        self.partners: dict[str, Token] = {}
        self.token = node.token._replace(
            entity_id=core.next_number(),
            kind=self.KIND,
            name=name,
            dds_type=names.type_to_dds(type_id.name),
            type_hash=type_id.type_hash,
            qos=format_qos(self.qos),
        )
        self.gid: bytes = self.token.gid
        self._core = core
        self._node = node
        # Held while something is sent: Zenoh does not take back what another thread uses. A signal
        # handler or finalizer of the sending thread may send, too.
        self._sending = threading.RLock()
        self._closed = False
        self._declared: list[Declared] = []

    def announce(self, declared: Declared) -> None:
        """Keep what was declared for its data, and show it in the graph."""
        self._declared.append(declared)
        try:
            with self._core.calls:
                token = self._core.session.liveliness().declare_token(self.token.text)
        except BaseException:
            self.close()
            raise
        self._declared.append(token)
        self._core.graph.watch(self)
        self._core.graph.add(self.token)
        self._node.adopt(self)

    def create_event(self, kind: EventKind) -> Event:
        if kind not in self.EVENTS:
            raise WireError(
                f"{type(self).__name__} of {self.topic} has no event '{kind.value}': deadline and "
                "liveliness events are not yet implemented in rmw_zenoh_cpp"
            )
        return self._event(kind)

    def meet(self, partner: Token) -> None:
        if partner.text not in self.partners:
            self.partners[partner.text] = partner
            self._report_matched(1, len(self.partners))

    def part(self, partner: Token) -> None:
        if self.partners.pop(partner.text, None) is not None:
            self._report_matched(-1, len(self.partners))

    def close(self) -> None:
        if self._core.process == os.getpid():  # see `Entity.close`
            self._close()

    def _close(self) -> None:
        with self._lock:
            if self._closed:
                return
            self._closed = True
        self._core.graph.unwatch(self)
        if not self._core.closing:  # closing the session takes everything back at once
            with suppress(WireError), self._core.calls, self._sending:
                for declared in reversed(self._declared):
                    declared.undeclare()
        self._core.graph.remove(self.token)
        with self._lock:
            self.partners.clear()
            self._close_events()
        self._node.forget(self)
