"""Services with Fast DDS, without a node on it; tests/peers has real ones."""

import ctypes
import socket
import struct

import pytest
from tests.needs import COMPILED_CORE

from turtlewire.errors import UncallableServiceError
from turtlewire.wire import report
from turtlewire.wire.base import MessageInfo
from turtlewire.wire.cyclone import fast_dds
from turtlewire.wire.cyclone import library as dds
from turtlewire.wire.cyclone.fast_dds import FAST_DDS, guid_of_client, split_identity
from turtlewire.wire.cyclone.native import NATIVE
from turtlewire.wire.cyclone.servers import MatchedEndpoint, foreign_middleware, refusal
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import RequestId, join_header

LONG = 60_000_000_000
CDR = b"\x00\x01\x00\x00\x07\x00\x00\x00"
FAST = "Fast DDS (rmw_fastrtps_cpp)"
GUID = bytes.fromhex("010f") + bytes(range(10)) + b"\x00\x00\x09\x04"
MARK = b"\xfaFastDDS"

compiled = pytest.mark.skipif(NATIVE is None, reason=COMPILED_CORE)


@pytest.fixture
def usable(monkeypatch):
    monkeypatch.setattr(FAST_DDS, "obstacle", "")


def marked(guid, number):
    return CDR[:4] + MARK + guid + struct.pack("<q", number) + CDR[4:]


def test_an_identity_is_taken_out_of_a_message():
    (client_id, number), cdr = split_identity(marked(GUID, 1 << 33))
    assert (guid_of_client(client_id), number, cdr) == (GUID, 1 << 33, CDR)


@pytest.mark.parametrize("payload", [CDR, join_header(RequestId(1, 2), CDR), marked(GUID, 1)[:35]])
def test_messages_without_an_identity(payload):
    assert split_identity(payload) is None


def test_a_client_of_cyclone_has_no_guid():
    assert guid_of_client((1 << 64) - 1) == b""


@pytest.mark.parametrize(
    ("platform", "version", "security", "reason"),
    [
        ("linux", "11.0", "", ""),
        ("linux", "0.10", "", ""),
        ("linux", "11.1", "", "they do not work with "),
        ("darwin", "11.0", "", "they need Linux"),
        ("linux", "11.0", "true", "ROS_SECURITY_ENABLE is true"),
    ],
)
@compiled
def test_services_with_fast_dds_need_linux_a_known_library_and_no_security(
    monkeypatch, platform, version, security, reason
):
    monkeypatch.setattr(fast_dds.sys, "platform", platform)
    monkeypatch.setattr(dds, "ABI", dds.ABI._replace(version=version))
    monkeypatch.setenv("ROS_SECURITY_ENABLE", security)
    found = fast_dds._find_obstacle()
    assert found.startswith(reason)
    assert bool(found) == bool(reason)


def test_without_the_compiled_core_they_do_not_work(monkeypatch):
    monkeypatch.setattr(fast_dds, "NATIVE", None)
    assert fast_dds._find_obstacle() == "they need the compiled core"


@compiled
def test_an_unexpected_layout_of_types_ends_them_with_one_line(
    context, types, monkeypatch, usable, capfd
):
    monkeypatch.setattr(report, "_said", set())
    monkeypatch.setattr(fast_dds, "sertype_of", lambda _: 4096)
    for number in range(2):
        context.create_node("ours").create_service(f"/clear{number}", types, QoS())
    assert FAST_DDS.obstacle == f"{dds.LIBRARY} has an unexpected layout of types"
    assert capfd.readouterr().err.count("no services with Fast DDS here: Cyclone DDS ") == 1
    assert foreign_middleware(GUID, {}) == FAST


def test_servers_on_two_middlewares_are_refused_and_both_named(usable):
    ours = MatchedEndpoint(bytes.fromhex("0110").ljust(16, b"\x07"), {"serviceid": " 1.10.0"})
    theirs = MatchedEndpoint(GUID, {})
    assert refusal("/echo", [theirs, theirs]) is None
    assert refusal("/echo", [ours]) is None
    assert str(refusal("/echo", [theirs, ours])) == (
        "service /echo is not called: it has servers on Cyclone DDS (rmw_cyclonedds_cpp) and "
        f"{FAST}, and a request that one understands would be misread by the other"
    )


def test_an_obstacle_brings_the_refusal_back(monkeypatch):
    monkeypatch.setattr(FAST_DDS, "obstacle", "they need Linux")
    error = refusal("/echo", [MatchedEndpoint(GUID, {})])
    assert isinstance(error, UncallableServiceError)
    assert f"its server runs on {FAST}, which would misread our requests" in str(error)


@pytest.fixture
def server(context, types, usable):
    return context.create_node("ours").create_service("/clear", types, QoS())


def test_a_request_with_an_identity_is_taken(monkeypatch, server):
    taken = [(marked(GUID, 5), MessageInfo(0, 0, GUID))]
    monkeypatch.setattr(server.requests, "take", lambda _limit: taken)
    assert server.take() == [(RequestId(int.from_bytes(GUID, "little"), 5), CDR)]


@compiled
def test_a_reply_waits_for_the_reader_that_the_request_named(monkeypatch, server):
    sent = []
    monkeypatch.setattr(server.replies, "publish_identified", lambda *reply: sent.append(reply))
    writer = GUID[:-1] + b"\x03"
    for guid, number in ((GUID, 1), (writer, 2)):
        server.send_response(RequestId(int.from_bytes(guid, "little"), number), CDR)
    assert sent == [(CDR, writer, 2)]  # who named a writer is not waited for
    monkeypatch.setattr(server, "_can_reach", lambda client: client == GUID)
    server.send_waiting()
    assert sent[1:] == [(CDR, GUID, 1)]


@compiled
def test_identities_are_forgotten_with_their_samples(context, types, usable):
    from turtlewire._native import tagged_samples

    node = context.create_node("ours")
    client, server = (
        make("/clear", types, QoS()) for make in (node.create_client, node.create_service)
    )
    assert context.graph.wait_for(client.is_ready, LONG)
    for number in range(100):
        server.replies.publish_identified(CDR, GUID, number)
    assert FAST_DDS.obstacle == ""  # nobody on Fast DDS was there
    assert client.take(1000) == []
    assert tagged_samples() == 0


@compiled
def test_a_crowd_of_services_of_one_type_is_no_trouble(context, types, usable):
    node = context.create_node("ours")
    for _ in range(3):
        servers = [node.create_service(f"/clear{number}", types, QoS()) for number in range(200)]
        assert [shared.users for shared in FAST_DDS._types.values()] == [200, 200]
        for server in servers:
            server.close()
        assert not FAST_DDS._types
    assert FAST_DDS.obstacle == ""


@compiled
@pytest.mark.parametrize("closed", ["node", "context"])
def test_a_writer_of_requests_is_closed_with_its_node(
    context, types, usable, monkeypatch, capfd, closed
):
    count_children = ctypes.CDLL(dds.LIBRARY.path).dds_get_children
    participant = context._core.participant.handle
    before = count_children(participant, None, 0)
    node = context.create_node("ours")
    client = node.create_client("/clear", types, QoS())
    open_requests = client._open_requests

    def close_and_open():  # as if another thread closed it at this moment
        (node if closed == "node" else context).close()
        return open_requests()

    monkeypatch.setattr(client, "_open_requests", close_and_open)
    monkeypatch.setattr(client._servers, "now", lambda: [MatchedEndpoint(GUID, {})])
    client._servers_changed()
    assert client._identified is None
    assert capfd.readouterr().err == ""
    if closed == "node":
        assert count_children(participant, None, 0) == before


def test_services_on_cyclone_work_beside(context, types, usable):
    node = context.create_node("ours")
    client, server = (
        make("/clear", types, QoS()) for make in (node.create_client, node.create_service)
    )
    assert context.graph.wait_for(client.is_ready, LONG)
    number = client.send_request(CDR)
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    assert wait_set.wait(LONG) == [server]
    ((request_id, cdr),) = server.take()
    assert (request_id.sequence_number, cdr) == (number, CDR)
    server.send_response(request_id, CDR)
    wait_set.detach(server)
    wait_set.attach(client)
    assert wait_set.wait(LONG) == [client]
    assert client.take() == [(number, CDR)]


@compiled
def test_clients_on_fast_dds_are_asked_for_their_first_request():
    from turtlewire._native import CycloneFirstRequests

    reader = bytes.fromhex("0110") + bytes(10) + b"\x00\x00\x05\x04"
    writers = {1: GUID[:-1] + b"\x03", 2: reader}  # by their instance handles
    endpoints = {handle: ctypes.create_string_buffer(guid) for handle, guid in writers.items()}
    freed = []

    @ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_int32, ctypes.c_uint64)
    def endpoint_of(_, handle):
        return ctypes.addressof(endpoints[handle]) if handle in endpoints else None

    free = ctypes.CFUNCTYPE(None, ctypes.c_void_p)(freed.append)
    functions = [ctypes.cast(each, ctypes.c_void_p).value for each in (endpoint_of, free)]
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(LONG / 1e9)
        port = receiver.getsockname()[1]
        requests = CycloneFirstRequests(functions, reader, [(0x7F000001, port)])
        callback, argument = requests.listener()
        signature = ctypes.CFUNCTYPE(None, ctypes.c_int32, dds.MatchedStatus, ctypes.c_void_p)
        for handle in (3, 2, 1):  # one that has left, one on Cyclone, one on Fast DDS
            status = dds.MatchedStatus(last_handle=handle)
            signature(callback)(0, status, argument)
        heartbeats = {receiver.recv(1000) for _ in range(4)}
        requests.close()
        signature(callback)(0, dds.MatchedStatus(last_handle=1), argument)
        receiver.sendto(b"the last", ("127.0.0.1", port))
        assert receiver.recv(1000) == b"the last"
    assert len(freed) == 3
    (repeated,) = heartbeats
    assert repeated[:4] + repeated[6:20] == b"RTPS" + b"\x01\x0f" + writers[1][:12]
    assert [struct.unpack_from("<4s4siIiIi", repeated, at) for at in (24, 56)] == [
        (reader[12:], writers[1][12:], 0, 1, 0, last, last) for last in (0, 1)
    ]
