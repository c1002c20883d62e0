"""Asks peers of other vendors to repeat what Cyclone did not receive.

A peer immediately sends its endpoints to each new participant, and its messages for late joiners to
each new reader. Fast DDS does so before Cyclone has registered the peer, so Cyclone drops the data.
Fast DDS then repeats its endpoints after one second and its messages after three, because it
ignores the form in which Cyclone requests data that it never received (an ACKNACK whose count is
0).

A new participant, or a new reader, makes Fast DDS send again at once. By then, Cyclone has
registered the peer, and requests all of the data in a form that Fast DDS accepts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

from . import library as dds
from .ports import is_cyclone, process_of

if TYPE_CHECKING:
    from .participant import Participant

#: So long a peer may take before it is asked. Less than the 10 ms after which Cyclone asks by
#: itself, because then it would ask again only after a second.
PATIENCE_NS = 2_000_000


class Questions(NamedTuple):
    """Gids of participants to ask, by what to ask for."""

    endpoints: set[bytes]
    nodes: set[bytes]


class SilentPeers:
    """Asks each participant of another vendor once for its endpoints and once for its nodes.

    Args:
        participant: Ours.
        renew_reader: Replaces the reader of ``ros_discovery_info`` by a new one.
    """

    def __init__(self, participant: Participant, renew_reader: Callable[[], None]) -> None:
        self._participant = participant
        self._renew_reader = renew_reader
        self._second = 0
        self._asked = Questions(set(), set())

    def to_ask(self, silent: Iterable[bytes], announcers: Iterable[bytes]) -> Questions:
        """Return the questions to silent participants.

        Args:
            silent: Gids of the ROS participants whose nodes are not known.
            announcers: Gids of the known writers of ``ros_discovery_info``.
        """
        foreign = {gid for gid in silent if not is_cyclone(gid)}
        announcing = {process_of(gid) for gid in announcers}
        heard = {gid for gid in foreign if process_of(gid) in announcing}
        return Questions(foreign - heard - self._asked.endpoints, heard - self._asked.nodes)

    def ask(self, questions: Questions) -> None:
        """Ask them."""
        if questions.endpoints:
            self._asked.endpoints.update(questions.endpoints)
            self._open_second()
        if questions.nodes:
            self._asked.nodes.update(questions.nodes)
            self._renew_reader()

    def gone(self, gid: bytes) -> None:
        """Forget a participant that has left."""
        self._asked.endpoints.discard(gid)
        self._asked.nodes.discard(gid)

    def _open_second(self) -> None:
        self.close()
        created = dds.create_participant(self._participant.domain_id, None, None)
        self._second = dds.check(created, "ask for endpoints")

    def close(self) -> None:
        """Delete the second participant."""
        if self._second:
            dds.delete(self._second)
            self._second = 0
