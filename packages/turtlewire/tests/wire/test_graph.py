"""The bytes of ``ros_discovery_info`` and of user data, and who is asked for them again."""

from __future__ import annotations

import contextlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests import places
from turtlewire.errors import CdrError
from turtlewire.wire.cyclone.silent_peers import SilentPeers
from turtlewire.wire.graph import (
    NodeEndpoints,
    format_user_data,
    pack_discovery_info,
    parse_user_data,
    unpack_discovery_info,
)

CYCLONE = b"\x01\x10" + bytes(14)
FAST = [b"\x01\x0f" + bytes([number]) + bytes(9) + b"\x00\x00\x01\xc1" for number in range(3)]
GOLDEN = places.GOLDEN / "wire"
SAMPLES = json.loads((GOLDEN / "discovery_info.json").read_text())

gid = st.binary(min_size=16, max_size=16)
gids = st.lists(gid, max_size=3).map(tuple)
text = st.text(st.characters(blacklist_characters="\x00", blacklist_categories=["Cs"]), max_size=9)
nodes = st.lists(st.builds(NodeEndpoints, text, text, gids, gids), max_size=3)


def of_golden(sample: dict) -> tuple[bytes, list[NodeEndpoints]]:
    return bytes.fromhex(sample["participant"]), [
        NodeEndpoints(
            node["namespace"],
            node["name"],
            tuple(bytes.fromhex(reader) for reader in node["readers"]),
            tuple(bytes.fromhex(writer) for writer in node["writers"]),
        )
        for node in sample["nodes"]
    ]


def test_the_samples_of_a_real_ros_2_are_reproduced():
    for sample in SAMPLES:
        cdr = bytes.fromhex(sample["bytes"])
        participant, expected = of_golden(sample)
        assert unpack_discovery_info(cdr) == (participant, expected)
        packed = pack_discovery_info(participant, expected)
        assert packed + b"\x00" * (-len(packed) % 4) == cdr
    assert len(SAMPLES) == 24


@given(gid, nodes)
def test_packing_round_trip(participant: bytes, expected: list[NodeEndpoints]):
    assert unpack_discovery_info(pack_discovery_info(participant, expected)) == (
        participant,
        expected,
    )


@given(gid, nodes, st.sampled_from([b"", b"\x00", b"\x00\x00\x00"]))
def test_samples_of_humble_have_longer_gids(participant, expected, padding):
    """As in the definition of its `rmw_dds_common/msg/Gid`: `char[24] data`."""
    longer = [
        node._replace(
            readers=tuple(each + bytes(8) for each in node.readers),
            writers=tuple(each + bytes(8) for each in node.writers),
        )
        for node in expected
    ]
    cdr = pack_discovery_info(participant + bytes(8), longer) + padding
    assert unpack_discovery_info(cdr) == (participant, expected)


@given(st.sampled_from(SAMPLES), st.data())
def test_broken_samples_are_refused_or_read(sample: dict, data: st.DataObject):
    cdr = bytearray(bytes.fromhex(sample["bytes"]))
    for _ in range(data.draw(st.integers(1, 4))):
        cdr[data.draw(st.integers(0, len(cdr) - 1))] = data.draw(st.integers(0, 255))
    with contextlib.suppress(CdrError):  # anything else would end the reader thread
        unpack_discovery_info(bytes(cdr[: data.draw(st.integers(0, len(cdr)))]))


def test_a_broken_sample_says_what_is_wrong():
    cdr = bytes.fromhex(SAMPLES[2]["bytes"])
    with pytest.raises(CdrError, match="expected little endian"):
        unpack_discovery_info(b"\x00\x00" + cdr[2:])
    with pytest.raises(CdrError, match="items announced"):
        unpack_discovery_info(cdr[:20] + b"\xff\xff\xff\xff" + cdr[24:])
    with pytest.raises(CdrError, match="ends after 10 bytes"):
        unpack_discovery_info(cdr[:10])


def test_user_data():
    assert format_user_data(enclave="/") == b"enclave=/;"
    assert (
        format_user_data(clientid=" 1.2", typehash="RIHS01_ab")
        == b"clientid= 1.2;typehash=RIHS01_ab;"
    )
    assert parse_user_data(b"enclave=/;\x00") == {"enclave": "/"}
    assert parse_user_data(b"serviceid= 1.10.b5;typehash=RIHS01_ab;") == {
        "serviceid": " 1.10.b5",
        "typehash": "RIHS01_ab",
    }
    assert parse_user_data(b"\xff\x00 nonsense") == {}


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
