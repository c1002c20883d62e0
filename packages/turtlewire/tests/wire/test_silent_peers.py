"""Choosing the participants that are asked for data that Cyclone could not receive yet."""

from __future__ import annotations

from turtlewire.wire.cyclone.silent_peers import SilentPeers

CYCLONE = b"\x01\x10" + bytes(14)
FAST = [b"\x01\x0f" + bytes([number]) + bytes(9) + b"\x00\x00\x01\xc1" for number in range(3)]


def writer_of(participant: bytes) -> bytes:
    return participant[:12] + b"\x00\x00\x04\x03"


class Asked(SilentPeers):
    """Creates no participant."""

    def __init__(self) -> None:
        self.renewed = 0
        super().__init__(None, self._renewed)
        self.opened = 0

    def _renewed(self) -> None:
        self.renewed += 1

    def _open_second(self) -> None:
        self.opened += 1


def test_cyclone_is_never_asked():
    assert Asked().to_ask([CYCLONE], []) == (set(), set())


def test_unknown_endpoints_and_nodes_are_queried():
    questions = Asked().to_ask(
        [FAST[0], FAST[1], CYCLONE], [writer_of(FAST[1]), writer_of(FAST[2])]
    )
    assert questions == ({FAST[0]}, {FAST[1]})


def test_each_is_asked_once_for_each():
    peers = Asked()
    for announcers in ([], [writer_of(FAST[0])]):
        questions = peers.to_ask(FAST[:1], announcers)
        assert any(questions)
        peers.ask(questions)
        assert not any(peers.to_ask(FAST[:1], announcers))
    assert (peers.opened, peers.renewed) == (1, 1)


def test_nothing_is_kept_of_participants_that_have_left():
    peers = Asked()
    for gid in FAST:
        peers.ask(peers.to_ask([gid], []))
        peers.ask(peers.to_ask([gid], [writer_of(gid)]))
        peers.gone(gid)
    assert peers._asked == (set(), set())


def test_several_are_asked_at_once():
    peers = Asked()
    peers.ask(peers.to_ask(FAST, []))
    peers.ask(peers.to_ask(FAST, map(writer_of, FAST)))
    assert (peers.opened, peers.renewed) == (1, 1)
