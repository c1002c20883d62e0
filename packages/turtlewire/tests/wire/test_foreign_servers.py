"""Servers that would misread our requests get none; tests/peers has real ones."""

import pytest

from turtlewire.errors import UncallableServiceError
from turtlewire.wire import open_context, report
from turtlewire.wire.base import ForeignServer, MessageInfo, NodeInfo
from turtlewire.wire.cyclone.fast_dds import FAST_DDS
from turtlewire.wire.cyclone.servers import foreign_middleware
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import RequestId, join_header, not_callable, require_callable

LONG = 60_000_000_000
EMPTY = "std_srvs/srv/Empty"
CDR = b"\x00\x01\x00\x00\x00\x00\x00\x00"
NO_ID = "a middleware that announces no serviceid"


@pytest.mark.parametrize(
    ("vendor", "ids", "middleware"),
    [
        ("0110", {"serviceid": " 1.10.0"}, ""),
        ("0110", {"typehash": "RIHS01_0"}, NO_ID),
        ("010f", {"typehash": "RIHS01_0"}, "Fast DDS (rmw_fastrtps_cpp)"),
        ("010f", {"serviceid": " 1.f.0"}, "Fast DDS (rmw_fastrtps_cpp)"),
        ("0101", {}, "Connext DDS (rmw_connextdds)"),
        ("0112", {}, "RustDDS"),
        ("0199", {}, "a DDS of vendor 01.99"),
    ],
)
def test_servers_that_understand_our_requests(monkeypatch, vendor, ids, middleware):
    monkeypatch.setattr(FAST_DDS, "obstacle", "they need Linux")  # test_fast_dds: without one
    assert foreign_middleware(bytes.fromhex(vendor).ljust(16, b"\x07"), ids) == middleware


def test_a_server_without_serviceid_gets_nothing(context, types, foreign_server):
    reader = foreign_server("/clear", EMPTY)
    client = context.create_node("ours").create_client("/clear", types, QoS())
    graph = context.graph
    assert graph.wait_for(lambda: client.requests.subscription_count() == 1, LONG)
    assert not client.is_ready()
    with pytest.raises(UncallableServiceError) as caught:
        client.send_request(CDR)
    assert str(caught.value) == str(not_callable("/clear", NO_ID))
    assert caught.value.hint.startswith("Start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_c")
    assert graph.wait_for(lambda: graph.foreign_servers() != [], LONG)
    stranger = NodeInfo("stranger", "/", "/")
    assert graph.wait_for(
        lambda: graph.foreign_servers() == [ForeignServer("/clear", stranger, NO_ID)], LONG
    )
    with pytest.raises(UncallableServiceError):
        require_callable(graph, "/clear")
    require_callable(graph, "/other")
    assert reader.take() == []


def test_a_client_sends_no_request_while_a_foreign_server_exists(context, types, foreign_server):
    node = context.create_node("ours")
    client, server = (
        make("/clear", types, QoS()) for make in (node.create_client, node.create_service)
    )
    graph = context.graph
    assert graph.wait_for(client.is_ready, LONG)
    for _ in range(2):  # what was found out about the first must not count for the second
        stranger = foreign_server("/clear", EMPTY)
        assert graph.wait_for(lambda: not client.is_ready(), LONG)
        with pytest.raises(UncallableServiceError):
            client.send_request(CDR)
        stranger.close()
        assert graph.wait_for(client.is_ready, LONG)
    client.send_request(CDR)
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    assert wait_set.wait(LONG) == [server]
    assert [cdr for _, cdr in server.take()] == [CDR]


def test_a_request_in_another_layout_is_dropped_with_one_line(context, types, monkeypatch, capfd):
    monkeypatch.setattr(report, "_said", set())
    server = context.create_node("ours").create_service("/clear", types, QoS())
    ours, theirs = (
        MessageInfo(0, 0, bytes.fromhex(vendor) + bytes(14)) for vendor in ("0110", "010f")
    )
    payload = join_header(RequestId(1, 2), CDR)
    taken = [(payload, theirs), (payload, ours), (CDR, theirs)]
    monkeypatch.setattr(server.requests, "take", lambda _limit: taken)
    assert server.take() == [(RequestId(1, 2), CDR)]
    said = capfd.readouterr().err
    assert said.count("dropped a request of service /clear: its client ") == 1
    assert "Start the client with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp" in said


def test_request_of_a_departed_client_is_dropped_with_the_reason(
    context, types, monkeypatch, capfd
):
    monkeypatch.setattr(report, "_said", set())
    server = context.create_node("ours").create_service("/clear", types, QoS())
    server.requests.on_matched.remove(server.requests.learn_publishers)  # as if it came too late
    other = open_context(middleware="rmw_cyclonedds_cpp")
    client = other.create_node("theirs").create_client("/clear", types, QoS())
    assert other.graph.wait_for(client.is_ready, LONG)
    client.send_request(CDR)
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    assert wait_set.wait(LONG) == [server]
    other.close()
    assert context.graph.wait_for(lambda: server.requests.publisher_count() == 0, LONG)
    assert server.take() == []
    assert capfd.readouterr().err.endswith(
        "dropped a request of service /clear: its client has left, before it was known on which "
        "middleware it runs\n"
    )


def test_a_request_of_a_client_that_has_left_is_taken(context, types):
    server = context.create_node("ours").create_service("/clear", types, QoS())
    graph = context.graph
    other = open_context(middleware="rmw_cyclonedds_cpp")
    client = other.create_node("theirs").create_client("/clear", types, QoS())
    assert other.graph.wait_for(client.is_ready, LONG)
    assert graph.wait_for(lambda: len(server.requests._gids) == 1, LONG)
    client.send_request(CDR)
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    assert wait_set.wait(LONG) == [server]
    other.close()
    assert graph.wait_for(lambda: server.requests.publisher_count() == 0, LONG)
    assert [cdr for _, cdr in server.take()] == [CDR]
