"""The 16 bytes in front of requests and responses, as a real rmw_cyclonedds writes them."""

import json
import threading

from tests.needs import needs_cyclone_dds
from tests.places import GOLDEN

from turtlewire.wire import open_context
from turtlewire.wire.base import RequestId, ServiceTypes, TypeId
from turtlewire.wire.cyclone.services import format_service_id
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import join_header, split_header

CALLS = json.loads((GOLDEN / "wire" / "service_calls.json").read_text())


def test_the_headers_of_a_real_ros_2_are_reproduced():
    checked = 0
    for call in CALLS:
        for part in (call["request"], call["response"]):
            payload = bytes.fromhex(part["bytes"])
            request_id = RequestId(
                int.from_bytes(bytes.fromhex(part["header_guid"]), "little"), part["header_seq"]
            )
            cdr = bytes.fromhex(part["encapsulation"] + part["payload"])
            assert split_header(payload) == (request_id, cdr)
            assert join_header(request_id, cdr) == payload
            checked += 1
    assert checked == 2 * len(CALLS) == 16


def test_a_payload_too_short_for_the_header_is_none():
    assert split_header(b"\x00\x01\x00\x00" + bytes(15)) is None


def test_a_payload_may_end_behind_the_header():
    cdr = b"\x00\x01\x00\x00"
    assert split_header(cdr + bytes(16)) == (RequestId(0, 0), cdr)


def test_service_ids_are_spelled_like_those_of_rmw_cyclonedds():
    participant = bytes.fromhex("0110a83ed762017dd5286bfb000001c1")
    assert format_service_id(participant, 1) == " 1.10.a8.3e.d7.62.1.7d.d5.28.6b.fb.0.0.0.1"


SWITCH = ServiceTypes(
    "std_srvs/srv/SetBool",
    TypeId("std_srvs/srv/SetBool_Request", "RIHS01_" + "1" * 64),
    TypeId("std_srvs/srv/SetBool_Response", "RIHS01_" + "2" * 64),
    lambda _: "RIHS01_" + "3" * 64,
)
LONG = 60_000_000_000


@needs_cyclone_dds
def test_replies_that_wait_for_a_client_end_with_their_service_in_silence(monkeypatch, capfd):
    context = open_context(middleware="rmw_cyclonedds_cpp")
    service = context.create_node("server").create_service("/switch", SWITCH, QoS())
    service._clients[1] = "a client"
    service.send_response(RequestId(1, 1), b"\x00\x01\x00\x00\x01\x00\x00\x00")
    assert len(service._waiting) == 1
    service.close()
    monkeypatch.setattr(service, "_can_reach", lambda client: True)
    service.send_waiting()
    assert service._waiting == []
    context.close()
    assert capfd.readouterr().err == ""


@needs_cyclone_dds
def test_each_client_gets_its_reply_while_the_reader_thread_is_busy():
    context = open_context(middleware="rmw_cyclonedds_cpp")
    node = context.create_node("server")
    service = node.create_service("/switch", SWITCH, QoS())
    is_busy, goes_on = threading.Event(), threading.Event()
    context.call_soon(lambda: (is_busy.set(), goes_on.wait()))
    assert is_busy.wait(60)
    try:
        for _ in range(3):  # the first one is not yet known, the others come after an answer
            assert answered(context, node.create_client("/switch", SWITCH, QoS()), service)
    finally:
        goes_on.set()
        context.close()


def answered(context, client, service):
    """Call once; True if the reply arrives although no other thread sends it."""
    cdr = b"\x00\x01\x00\x00\x01\x00\x00\x00"
    number = client.send_request(cdr)
    wait_set = context.create_wait_set()
    wait_set.attach(service)
    assert wait_set.wait(LONG) == [service]
    ((request_id, _),) = service.take()
    service.send_response(request_id, cdr)
    return service._waiting == [] and [each for each, _ in client.take()] == [number]
