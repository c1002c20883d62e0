"""The transports of nodes on Fast DDS, announced and shared; tests/peers has real nodes."""

import os
import select
import socket
from contextlib import ExitStack, contextmanager

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.needs import needs_cyclone_dds

from turtlewire.doctor import examination, fast_dds_findings, fast_dds_search
from turtlewire.doctor import fast_dds_findings as fast_dds
from turtlewire.doctor.fast_dds_findings import command_of, sharing_processes
from turtlewire.doctor.fast_dds_search import (
    FastDdsSearch,
    Participant,
    Question,
    read_participants,
)
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.network import udp_ports
from turtlewire.wire import open_context
from turtlewire.wire.base import EndpointInfo, NodeInfo
from turtlewire.wire.cyclone.ports import unicast_ports_of
from turtlewire.wire.qos import QoS

DOMAIN = 61
LONG_S = 60.0
#: What real nodes announced that were started with FASTDDS_BUILTIN_TRANSPORTS=LARGE_DATA.
JAZZY = bytes.fromhex(
    "525450530202010f010f78fd3b2fa7c9000000000901080043fa096b67b9c12e1505940100001000000100c700"
    "0100c2000000000100000000030000150004000202000016000400010f000050001000010f78fd3b2fa7c90000"
    "0000000001c1078004000500000032001800040000001d978458000000000000000000000000c0000202310018"
    "0010000000855800005578fd0000000000000000000000000031001800040000001d9785580000000000000000"
    "00000000c0000202020008001400000000000000580004003f0c000062000800020000002f0000002c0010000b"
    "000000656e636c6176653d2f3b00005900c00004000000110000005041525449434950414e545f545950450000"
    "00000700000053494d504c4500001b000000666173746464732e706879736963616c5f646174612e686f737400"
    "0018000000766d3a3137313634313432323939323536333234303936001b000000666173746464732e70687973"
    "6963616c5f646174612e75736572000005000000726f6f74000000001e000000666173746464732e7068797369"
    "63616c5f646174612e70726f636573730000000600000031323039310000000100000080013800010000007a58"
    "0000000000000000000000000000efff000143fa096b3d19c32e0100000000000000f401000000000000000000"
    "0000000000"
)
KILTED = bytes.fromhex(
    "525450530202010f010f78fdc31e6fe200000000090108001afd096bae65ce5a1505dc0100001000000100c700"
    "0100c2000000000100000000030000150004000202000016000400010f000000800400030202000f0004003e00"
    "000050001000010f78fdc31e6fe200000000000001c10780040017000000038028002100000033643132313963"
    "37633463353430346161613166366432613438616466646134000000003200180004000000ddb17e5900000000"
    "0000000000000000c000020231001800130000007f5900005578fd000000000000000000000000003100180004"
    "000000ddb17f59000000000000000000000000c0000202020008001400000000000000580004003ffc00006200"
    "0800020000002f0000002c0010000b000000656e636c6176653d2f3b00005900cc000400000011000000504152"
    "5449434950414e545f54595045000000000700000053494d504c4500001b000000666173746464732e70687973"
    "6963616c5f646174612e686f737400002100000033643132313963376334633534303461616131663664326134"
    "38616466646134000000001b000000666173746464732e706879736963616c5f646174612e7573657200000500"
    "0000726f6f74000000001e000000666173746464732e706879736963616c5f646174612e70726f636573730000"
    "0005000000373837350000000001000000800138000100000074590000000000000000000000000000efff0001"
    "1dfd096b7b0775e80d000000000000000c1d0000000000000000000000000000"
)

TCP = bytes.fromhex("3100180004000000")
UDP = bytes.fromhex("3100180001000000")
QUESTION = Question(bytes(2) + b"ten bytes.", bytes([192, 0, 2, 7]), 7654)


@pytest.mark.parametrize(
    ("datagram", "prefix", "process"),
    [(JAZZY, "010f78fd3b2fa7c900000000", "12091"), (KILTED, "010f78fdc31e6fe200000000", "7875")],
)
def test_real_participants_with_large_data(datagram, prefix, process):
    expected = (bytes.fromhex(prefix), ("shared memory", "TCPv4"), process, "192.0.2.5")
    assert read_participants(datagram, "192.0.2.5") == [expected]


@pytest.mark.parametrize(
    ("kind", "transport"),
    [
        (1, "UDPv4"),
        (2, "UDPv6"),
        (8, "TCPv6"),
        (16, "shared memory"),
        (31, "shared memory"),
        (32, "transport 32"),
    ],
)
def test_kinds_of_transports(kind, transport):
    changed = JAZZY.replace(TCP, TCP[:4] + bytes([kind, 0, 0, 0]))
    (participant,) = read_participants(changed)
    assert participant.transports == tuple(dict.fromkeys(("shared memory", transport)))


def test_parameters_may_be_big_endian():
    header = JAZZY[:20] + bytes.fromhex("15040000") + JAZZY[36:56] + bytes.fromhex("00020000")
    locator = bytes.fromhex("0031001800000004") + bytes(20)
    assert read_participants(header + locator + bytes.fromhex("00010000")) == [
        Participant(JAZZY[8:20], ("TCPv4",), "", "")
    ]


def test_a_question_is_an_announcement_over_udp():
    assert read_participants(QUESTION.packet()) == [
        Participant(QUESTION.prefix, ("UDPv4",), "", "")
    ]
    assert read_participants(QUESTION.withdrawal()) == []


@pytest.mark.parametrize("datagram", [JAZZY, KILTED, QUESTION.packet(), QUESTION.withdrawal()])
def test_a_datagram_may_end_anywhere(datagram):
    for size in range(len(datagram)):
        assert len(read_participants(datagram[:size])) <= 1


@given(st.data())
def test_no_datagram_raises(data):
    valid = data.draw(st.sampled_from([JAZZY, KILTED]))
    datagram = bytearray(valid)
    for at, byte in data.draw(
        st.dictionaries(st.integers(0, len(valid) - 1), st.binary(min_size=1, max_size=1))
    ).items():
        datagram[at : at + 1] = byte
    read_participants(bytes(datagram))


@given(st.binary(), st.binary())
@example(b"", b"")
def test_no_announcement_raises(body, payload):
    read_participants(body)
    read_participants(JAZZY[:36] + body)
    read_participants(JAZZY[:60] + payload)


@pytest.fixture
def fake(monkeypatch):
    """A socket of a participant in the domain; its first port that is free."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        for port in unicast_ports_of(DOMAIN):
            try:
                opened.bind(("127.0.0.1", port))
            except OSError:
                continue
            break
        opened.settimeout(LONG_S)
        monkeypatch.setattr(fast_dds_search, "udp_ports", lambda: {port, 9})
        yield opened


def test_answers_are_collected_and_the_question_is_taken_back(fake):
    with FastDdsSearch(DOMAIN, wide=False) as search:
        question, asker = fake.recvfrom(1000)
        assert [found.transports for found in read_participants(question)] == [("UDPv4",)]
        for answer in (b"nonsense", KILTED, JAZZY, JAZZY, JAZZY.replace(b"\x01\x0f", b"\x01\x10")):
            fake.sendto(answer, asker)
        found = search.answers()
    assert [(each.process, each.address) for each in found] == [("12091", ""), ("7875", "")]
    withdrawal = fake.recv(1000)
    assert withdrawal[:20] == question[:20]
    assert read_participants(withdrawal) == []


@needs_cyclone_dds
def test_cyclone_dds_answers_only_without_the_tag():
    opened = open_context(middleware="rmw_cyclonedds_cpp")
    ports = udp_ports().intersection(unicast_ports_of(opened.domain_id))
    try:
        with sockets() as (tagged, plain):
            for asking in (tagged, plain):
                own = Question(
                    os.urandom(12), socket.inet_aton("127.0.0.1"), asking.getsockname()[1]
                )
                packet = own.packet()
                if asking is plain:
                    packet = packet.replace(
                        b"\x14\x40", b"\x14\x80"
                    )  # a parameter that nobody knows
                for port in ports:
                    asking.sendto(packet, ("127.0.0.1", port))
            assert plain.recv(1000)[6:8] == b"\x01\x10"
            assert not select.select([tagged], [], [], 0)[0]
    finally:
        opened.close()


@contextmanager
def sockets():
    with ExitStack() as stack:
        opened = [
            stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) for _ in range(2)
        ]
        for each in opened:
            each.bind(("127.0.0.1", 0))
            each.settimeout(LONG_S)
        yield opened


@pytest.fixture
def host(monkeypatch, tmp_path):
    """Adds processes with the segments that they map, and their UDP ports."""
    monkeypatch.setattr(fast_dds_findings, "_SEGMENTS", tmp_path / "shm")
    monkeypatch.setattr(fast_dds_findings, "_PROCESSES", tmp_path / "proc")
    (tmp_path / "shm").mkdir()

    def add(process, segment, *ports, command=b"talker\0--loud\0"):
        (tmp_path / "shm" / segment).touch()
        folder = tmp_path / "proc" / str(process)
        for name in ("fd", "net"):
            (folder / name).mkdir(parents=True)
        (folder / "cmdline").write_bytes(command)
        (folder / "maps").write_text(f"7f-80 rw-s 00000000 00:1a 42 /dev/shm/{segment}\n")
        rows = ["  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid"]
        for number, port in enumerate(ports):
            (folder / "fd" / str(number)).symlink_to(f"socket:[{number}]")
            rows.append(f" 1: 00000000:{port:04X} 00000000:0000 07 0:0 0:0 0 0 0 {number} 2 0")
        rows.append(" 2: 00000000:588B 00000000:0000 07 0:0 0:0 0 0 0 99 2 0")  # another process's
        (folder / "net" / "udp").write_text("\n".join(rows))

    return add


def test_processes_that_share_memory_and_have_no_port(host):
    host(4, "fastrtps_port22660")
    host(5, "fastdds_port22661_el", 7000, 22661)
    host(6, "fastdds_port22900", 22900)  # of the next domain
    host(7, "fastrtps_fa5debf0d5dd6173")
    host(8, "fastrtps_port22660", 7000)
    assert sharing_processes(DOMAIN) == {4: False, 5: True, 8: False}


def test_without_segments_no_process_is_examined(host, tmp_path):
    assert sharing_processes(DOMAIN) == {}
    host(4, "fastrtps_port22660")
    (tmp_path / "shm" / "fastrtps_port22660").unlink()
    assert sharing_processes(DOMAIN) == {}


def test_command_lines_are_shortened(host):
    host(4, "fastrtps_port22660")
    host(5, "fastrtps_port22660", command=b"x" * 61)
    host(6, "fastrtps_port22660", command=b"\xff\0" + b"x" * 58)
    assert command_of(4) == "talker --loud"
    assert command_of(5) == "x" * 57 + "..."
    assert command_of(6) == "\ufffd " + "x" * 58
    assert command_of(7) == ""


class Known:
    """A graph with one endpoint of the node /camera."""

    def endpoints(self):
        gid = b"\x01\x0f".ljust(16, b"c")
        return [
            EndpointInfo("publisher", "/x", "a/msg/B", "", NodeInfo("camera", "/", "/"), gid, QoS())
        ]


def participant(letter, *transports, process="3", address=""):
    return Participant(b"\x01\x0f".ljust(12, letter), transports, process, address)


def test_participants_that_are_reached_are_no_finding():
    participants = [
        participant(b"a", "UDPv4"),
        participant(b"b", "TCPv4", "UDPv4"),
        participant(b"c"),
    ]
    assert fast_dds.out_of_reach(Known(), participants, {3: True}) == []
    assert fast_dds.out_of_reach(Known(), participants, {3: False}) == []


@pytest.mark.parametrize(
    ("participants", "sharing", "owners"),
    [
        ([participant(b"c", "shared memory", "TCPv4")], {}, "/camera (shared memory and TCPv4)"),
        ([participant(b"a", "TCPv4", process="")], {}, f"participant 01.0f{'.61' * 10} (TCPv4)"),
        (
            [participant(b"a", "TCPv4", address="192.0.2.7")],
            {3: True},
            "process 3 on 192.0.2.7 (TCPv4)",
        ),
        ([participant(b"a", "TCPv4")], {3: True}, "process 3 'talker --loud' (TCPv4)"),
        ([participant(b"a", "TCPv4")], {4: True}, "process 3 (TCPv4)"),
        (
            [],
            {5: False, 3: False},
            "process 3 'talker --loud' (shared memory), process 5 (shared memory)",
        ),
        ([participant(b"c", "TCPv4")] * 5, {}, ", ".join(["/camera (TCPv4)"] * 5)),
        ([participant(b"c", "TCPv4")] * 7, {}, ", ".join(["/camera (TCPv4)"] * 5) + ", 2 others"),
    ],
)
def test_participants_out_of_reach_are_named(host, participants, sharing, owners):
    host(3, "fastrtps_port22660")
    (finding,) = fast_dds.out_of_reach(Known(), participants, sharing)
    assert finding.is_problem
    assert finding.text == (
        "Topics of participants on Fast DDS stay silent, because they do not receive over UDPv4: "
        f"{owners}."
    )
    assert "export FASTDDS_BUILTIN_TRANSPORTS=DEFAULT" in finding.remedy


def test_an_empty_graph_is_explained_once(local_context):
    assert graph_findings(local_context.graph, explained=True) == []
    assert len(graph_findings(local_context.graph)) == 1


@pytest.mark.parametrize(
    ("middleware", "range_", "asks"),
    [
        ("rmw_cyclonedds_cpp", "LOCALHOST", [False]),
        ("rmw_cyclonedds_cpp", "SUBNET", [True]),
        ("rmw_cyclonedds_cpp", "OFF", []),
        ("local", "SUBNET", []),
    ],
)
def test_only_who_is_on_cyclone_dds_asks(monkeypatch, middleware, range_, asks):
    asked = []
    monkeypatch.setattr(examination, "FastDdsSearch", lambda _, *, wide: asked.append(wide))
    monkeypatch.setattr(examination, "middleware_name", lambda: middleware)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", range_)
    examination._fast_dds_search(DOMAIN)
    assert asked == asks


@pytest.fixture
def local_context():
    opened = open_context(middleware="local")
    yield opened
    opened.close()
