"""The state that a context shares with its nodes."""

from __future__ import annotations

import itertools
from contextlib import ExitStack
from functools import cached_property
from typing import TYPE_CHECKING

from .announcer import Announcer
from .fast_dds import receiving_addresses
from .participant import Participant
from .reader import CycloneReaderThread

if TYPE_CHECKING:
    from .graph import CycloneGraph


class CycloneContextState:
    """The participant of a context, its reader thread and its announcements.

    Attributes:
        graph: None until the context is first asked for it: a program that never looks at the
            graph does not read what peers announce.
        closing: Whether the context is being closed.
    """

    def __init__(self, domain_id: int, enclave: str) -> None:
        self.participant = Participant(domain_id, enclave)
        with ExitStack() as if_it_fails:
            if_it_fails.callback(self.participant.close)
            self.reader = CycloneReaderThread(self.participant.handle)
            if_it_fails.callback(self.reader.close)
            self.announcer = Announcer(self.participant, self.reader)
            if_it_fails.pop_all()
        self.graph: CycloneGraph | None = None
        self.closing = False
        self._service_numbers = itertools.count(1)

    @cached_property
    def receiving_addresses(self) -> list[tuple[int, int]]:
        """The IPv4 addresses, as numbers, and ports at which this process receives."""
        return receiving_addresses(self.participant.domain_id)

    def graph_changed(self) -> None:
        """Notify the graph's listeners; called when a predicate on the graph may have changed."""
        if self.graph is not None:
            self.graph.notify_changed()

    def next_service_number(self) -> int:
        """Numbers the clients and services of this participant."""
        return next(self._service_numbers)
